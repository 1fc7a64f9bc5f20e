#include <duskline/planet/ground_march.h>
#include <duskline/planet/planet_ray.h>

#include <cmath>
#include <limits>
#include <utility>

namespace duskline {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Directions nearer to the axis than this have no turn about it.
constexpr double kOnAxis = 1e-14;

// A direction in its half-plane about the axis of the raised light, and the sine and cosine of its theta there.
struct HalfPlanePlace {
    Vector3 unit;
    RayPlane plane;
    double sine;
    double cosine;
};

HalfPlanePlace half_plane_place(const LightAxis& axis, const Vector3& direction)
{
    const Vector3 unit = normalized(direction);
    const double cosine = dot(unit, axis.to_sun);
    // Twice, because once loses digits near the axis.
    Vector3 away = unit - axis.to_sun * cosine;
    away = away - axis.to_sun * dot(away, axis.to_sun);
    const double sine = length(away);
    if (sine <= kOnAxis)
        return {unit, {axis.to_sun, axis.across}, 0.0, cosine};
    const Vector3 outward = away * (1.0 / sine);
    return {unit,
            {axis.to_sun * axis.raised_cosine + outward * axis.raised_sine,
             outward * axis.raised_cosine - axis.to_sun * axis.raised_sine},
            axis.from_raised_axis(cosine, sine),
            cosine * axis.raised_cosine + sine * axis.raised_sine};
}

} // namespace

PlanetRays::PlanetRays(PlanetLevel ground, const Vector3& to_sun, Angle raised)
    : ground_(std::move(ground)), axis_(light_axis(to_sun, raised))
{
    require_valid(ground_);
}

double PlanetRays::shadow_height_m(const Vector3& direction) const
{
    const HalfPlanePlace place = half_plane_place(axis_, direction);
    if (place.sine <= kOnAxis) // or the edge of the sun is beyond
        return place.cosine > 0.0 ? -kInfinity : kInfinity;
    GroundMarch march(ground_, place.plane, 0.0, false);
    const double rho_m = march.greatest_rho_m(std::atan2(place.sine, place.cosine));
    return rho_m > 0.0 ? rho_m / place.sine - base_radius_m(ground_.globe, place.unit) : -kInfinity;
}

bool PlanetRays::is_lit(const Vector3& direction, double height_m) const
{
    const HalfPlanePlace place = half_plane_place(axis_, direction);
    if (place.sine <= kOnAxis) // or the edge of the sun is beyond
        return place.cosine > 0.0;
    const double own_rho_m = (base_radius_m(ground_.globe, place.unit) + height_m) * place.sine;
    GroundMarch march(ground_, place.plane, own_rho_m, true);
    return !(march.greatest_rho_m(std::atan2(place.sine, place.cosine)) > own_rho_m);
}

} // namespace duskline
