#include <duskline/geometry/cross_product.h>
#include <duskline/planet/planet_camera.h>

#include <algorithm>
#include <cmath>

namespace duskline {

namespace {

constexpr Angle kUpright = Angle::from_degrees(90.0);

Vector3 in_planet(const LocalFrame& frame, const Vector3& local)
{
    return frame.east * local.x + frame.north * local.y + frame.up * local.z;
}

// Turned about an axis (a unit vector) by an angle, right-handed (O. Rodrigues).
Vector3 rotated(const Vector3& v, const Vector3& axis, double radians)
{
    const double sine = std::sin(radians);
    const double cosine = std::cos(radians);
    return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1.0 - cosine));
}

} // namespace

PlanetCamera camera_over(const Globe& globe, const LonLat& place, double height_m)
{
    PlanetCamera camera;
    camera.eye_m = point_m(globe, place, height_m);
    return camera;
}

CameraAxes axes_of(const Globe& globe, const PlanetCamera& camera)
{
    const LocalFrame frame = local_frame(globe, normalized(camera.eye_m));
    const CameraAxes local = axes_of(Camera{{}, camera.heading, camera.pitch, camera.vertical_view});
    return {in_planet(frame, local.forward), in_planet(frame, local.right), in_planet(frame, local.up)};
}

double clearance_m(const PlanetCamera& camera, const PlanetTerrain& terrain)
{
    const double ground_m = terrain.height_m(normalized(camera.eye_m), terrain.deepest_level());
    return height_m(terrain.globe(), camera.eye_m) - ground_m;
}

PlanetCamera turned(const PlanetCamera& camera, Angle by_heading, Angle by_pitch)
{
    PlanetCamera result = camera;
    result.heading = wrapped_to_circle(camera.heading + by_heading);
    result.pitch = std::clamp(camera.pitch + by_pitch, -kUpright, kUpright);
    return result;
}

// Along the great circle ahead. The heading is found anew there, since north turns on the way.
PlanetCamera flown(const Globe& globe, const PlanetCamera& camera, double right_m, double ahead_m,
                   double up_m)
{
    const double radius_m = length(camera.eye_m);
    const Vector3 here = camera.eye_m * (1.0 / radius_m);
    const LocalFrame frame = local_frame(globe, here);
    const auto [sine, cosine] = sine_cosine(camera.heading);
    const Vector3 ahead = frame.east * sine + frame.north * cosine;
    const Vector3 right = frame.east * cosine - frame.north * sine;
    const Vector3 way = ahead * ahead_m + right * right_m;
    const double height = height_m(globe, camera.eye_m) + up_m;
    const double distance_m = length(way);
    PlanetCamera result = camera;
    if (distance_m > 0.0) {
        const Vector3 axis = normalized(cross(here, way));
        const double angle = distance_m / radius_m;
        const Vector3 there = rotated(here, axis, angle);
        const LocalFrame frame_there = local_frame(globe, there);
        const Vector3 ahead_there = rotated(ahead, axis, angle);
        result.eye_m = point_m(globe, there, height);
        result.heading = wrapped_to_circle(Angle::from_radians(
            std::atan2(dot(ahead_there, frame_there.east), dot(ahead_there, frame_there.north))));
    } else {
        result.eye_m = point_m(globe, here, height);
    }
    return result;
}

PlanetCamera kept_above_ground(const PlanetCamera& camera, const PlanetTerrain& terrain, double wanted_m)
{
    const double missing_m = wanted_m - clearance_m(camera, terrain);
    PlanetCamera result = camera;
    if (missing_m > 0.0)
        result.eye_m = camera.eye_m + normalized(camera.eye_m) * missing_m;
    return result;
}

PlanetFrustum::PlanetFrustum(const Globe& globe, const PlanetCamera& camera, double aspect)
    : eye_m_(camera.eye_m)
{
    const auto [forward, right, up] = axes_of(globe, camera);
    const double half_height = tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    const double half_width = half_height * aspect;
    inwards_ = {forward, normalized(forward * half_width + right), normalized(forward * half_width - right),
                normalized(forward * half_height + up), normalized(forward * half_height - up)};
}

bool PlanetFrustum::may_see(const OrientedBox& box) const
{
    const Vector3 from_eye = box.centre_m - eye_m_;
    return std::ranges::all_of(inwards_, [&](const Vector3& inwards) {
        return dot(inwards, from_eye) + reach_m(box, inwards) >= 0.0;
    });
}

} // namespace duskline
