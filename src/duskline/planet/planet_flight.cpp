#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_flight.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

constexpr double kTurnsFrom = 0.35;
constexpr double kTurnsUntil = 0.95;

double eased(double share)
{
    const double t = std::clamp(share, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// By equal factors.
double height_between(double from_m, double to_m, double share)
{
    return from_m * std::pow(to_m / from_m, share);
}

Angle turned_towards(Angle from, Angle to, double share)
{
    const double turn_deg = std::remainder(to.degrees() - from.degrees(), 360.0);
    return Angle::from_degrees(from.degrees() + share * turn_deg);
}

// On the great circle between two unit vectors; of opposite ones over some great circle.
Vector3 direction_between(const Vector3& from, const Vector3& to, double share)
{
    const double angle = std::atan2(length(cross(from, to)), dot(from, to));
    if (angle < 1e-9)
        return normalized(from + (to - from) * share);
    Vector3 aside = to - from * dot(from, to);
    if (length(aside) < 1e-9)
        aside = cross(from, std::abs(from.z) < 0.9 ? Vector3{0.0, 0.0, 1.0} : Vector3{1.0, 0.0, 0.0});
    return normalized(from * std::cos(share * angle) + normalized(aside) * std::sin(share * angle));
}

} // namespace

PlanetCamera fly_down(const PlanetTerrain& terrain, const FlyDown& flight, double share)
{
    if (!(flight.to_m > 0.0 && flight.from_m > flight.to_m && std::isfinite(flight.from_m)))
        throw InvalidInput("a flight down must begin higher than it ends, and end above the ground; got "
                           + std::to_string(flight.from_m) + " m and " + std::to_string(flight.to_m) + " m");
    const Vector3 direction = direction_at(terrain.globe(), flight.place);
    const double ground_m = terrain.height_m(direction, terrain.deepest_level());
    const double over_ground_m = height_between(flight.from_m, flight.to_m, eased(share));
    const double raised = eased((std::clamp(share, 0.0, 1.0) - kTurnsFrom) / (kTurnsUntil - kTurnsFrom));
    PlanetCamera camera;
    camera.eye_m = point_m(terrain.globe(), direction, ground_m + over_ground_m);
    camera.heading = flight.heading;
    camera.pitch = Angle::from_degrees(-90.0 + raised * (flight.last_pitch.degrees() + 90.0));
    camera.vertical_view = flight.vertical_view;
    return camera;
}

PlanetCamera between(const PlanetTerrain& terrain, const PlanetCamera& from, const PlanetCamera& to,
                     double clearance_m, double share)
{
    const Globe& globe = terrain.globe();
    const double t = eased(share);
    const auto above_ellipsoid = [&](const PlanetCamera& camera) {
        return std::max(1.0, height_m(globe, camera.eye_m));
    };
    PlanetCamera camera;
    camera.eye_m = point_m(globe, direction_between(normalized(from.eye_m), normalized(to.eye_m), t),
                           height_between(above_ellipsoid(from), above_ellipsoid(to), t));
    camera.heading = wrapped_to_circle(turned_towards(from.heading, to.heading, t));
    camera.pitch = turned_towards(from.pitch, to.pitch, t);
    camera.vertical_view = turned_towards(from.vertical_view, to.vertical_view, t);
    return kept_above_ground(camera, terrain, clearance_m);
}

} // namespace duskline
