// A light is a direction, a point on a sphere; the course is the chain of chords between its lights:
//
//         1 ----- 2        the nearest place is that of the chord that comes nearest, at the foot of the
//        /    |    \       perpendicular, or at an end of it
//       0     x     3

#include <duskline/geometry/invalid_input.h>
#include <duskline/light/light_course.h>

#include <algorithm>
#include <limits>

namespace duskline {

namespace {

// How far from `from` to `to` the foot of a perpendicular lies, 0 to 1.
double foot_on_chord(Vector3 from, Vector3 to, Vector3 point)
{
    const Vector3 chord = to - from;
    const double square = dot(chord, chord);
    return square > 0.0 ? std::clamp(dot(point - from, chord) / square, 0.0, 1.0) : 0.0;
}

} // namespace

PlaceOnCourse nearest_place(const LightCourse& course, const DirectionalLight& light)
{
    const std::size_t count = course.lights.size();
    if (count == 0)
        throw InvalidInput("a course needs lights");
    const Vector3 point = direction_towards(light);
    PlaceOnCourse nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = i + 1 < count ? i + 1 : course.closed ? 0 : i;
        const Vector3 from = direction_towards(course.lights[i]);
        const Vector3 to = direction_towards(course.lights[next]);
        const double share = foot_on_chord(from, to, point);
        const double distance = length(from + (to - from) * share - point);
        if (distance < least) {
            least = distance;
            nearest = share == 1.0   ? PlaceOnCourse{next, next, 0.0}
                      : share == 0.0 ? PlaceOnCourse{i, i, 0.0}
                                     : PlaceOnCourse{i, next, share};
        }
    }
    return nearest;
}

} // namespace duskline
