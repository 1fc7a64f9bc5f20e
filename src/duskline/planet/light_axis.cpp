#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/light_axis.h>

#include <cmath>
#include <numbers>
#include <string>

namespace duskline {

LightAxis light_axis(const Vector3& to_sun, Angle raised)
{
    const double metres = length(to_sun);
    if (!(metres > 0.0 && std::isfinite(metres)))
        throw InvalidInput("the direction to the sun must be finite and longer than 0, got ("
                           + std::to_string(to_sun.x) + ", " + std::to_string(to_sun.y) + ", "
                           + std::to_string(to_sun.z) + ")");
    if (!(std::abs(raised.degrees()) < 5.0))
        throw InvalidInput("an edge of the sun's disc must be less than 5 degrees from its middle, got "
                           + std::to_string(raised.degrees()));
    const Vector3 sun = to_sun * (1.0 / metres);
    // Any direction across will do; the coordinate that the sun is farthest from loses the fewest digits.
    const double x = std::abs(sun.x);
    const double y = std::abs(sun.y);
    const double z = std::abs(sun.z);
    const Vector3 far = z <= x && z <= y ? Vector3{0.0, 0.0, 1.0}
                        : y <= x         ? Vector3{0.0, 1.0, 0.0}
                                         : Vector3{1.0, 0.0, 0.0};
    const Vector3 across = normalized(cross(far, sun));
    const auto [sine, cosine] = sine_cosine(raised);
    return {sun, across, cross(sun, across), sine, cosine};
}

Vector3 outward_at(const LightAxis& axis, double turn)
{
    const double angle = 2.0 * std::numbers::pi * (turn - std::floor(turn));
    return axis.across * std::cos(angle) + axis.aside * std::sin(angle);
}

double turn_of(const LightAxis& axis, const Vector3& direction)
{
    const double turn =
        std::atan2(dot(direction, axis.aside), dot(direction, axis.across)) / (2.0 * std::numbers::pi);
    return turn < 0.0 ? turn + 1.0 : turn;
}

FaceVector on_face(const Vector3& vector, std::uint32_t face, LinesAlong lines)
{
    const CubeFaceAxes axes = axes_of_face(face);
    const double u = dot(vector, axes.right);
    const double v = dot(vector, axes.up);
    return {dot(vector, axes.axis), lines == LinesAlong::u ? u : v, lines == LinesAlong::u ? v : u};
}

// A point (1, x, y) is in the plane of the beam when the determinant of it, the sun and the beam's outward vector is 0.
BeamLine::BeamLine(const FaceVector& to_sun, const FaceVector& outward_of_beam)
    : offset(to_sun.x * outward_of_beam.y - to_sun.y * outward_of_beam.x),
      dx(outward_of_beam.x * to_sun.ahead - to_sun.x * outward_of_beam.ahead),
      dy(outward_of_beam.y * to_sun.ahead - to_sun.y * outward_of_beam.ahead), outward(outward_of_beam)
{}

} // namespace duskline
