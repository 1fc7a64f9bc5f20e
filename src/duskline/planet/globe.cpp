#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/globe.h>

#include <cmath>
#include <string>

namespace duskline {

void require_valid(const Globe& globe)
{
    const double a = globe.equatorial_radius_m;
    const double b = globe.polar_radius_m;
    if (!(a > 0.0 && b > 0.0 && a <= 2.0 * b && b <= 2.0 * a && std::isfinite(a) && std::isfinite(b)))
        throw InvalidInput(
            "the radii of a globe must be above 0 m and within a factor of 2 of each other, got "
            + std::to_string(a) + " and " + std::to_string(b));
}

double base_radius_m(const Globe& globe, const Vector3& direction)
{
    // Of a sphere not rounded twice: a point at height 0 is on it to the last bit.
    if (globe.equatorial_radius_m == globe.polar_radius_m)
        return globe.equatorial_radius_m;
    const Vector3 stretched = {direction.x / globe.equatorial_radius_m,
                               direction.y / globe.equatorial_radius_m, direction.z / globe.polar_radius_m};
    return 1.0 / length(stretched);
}

double height_m(const Globe& globe, const Vector3& point_m)
{
    const double radius_m = length(point_m);
    return radius_m - base_radius_m(globe, point_m * (1.0 / radius_m));
}

Vector3 direction_at(const Globe& globe, const LonLat& place)
{
    const auto [sin_lon, cos_lon] = sine_cosine(place.longitude);
    const auto [sin_lat, cos_lat] = sine_cosine(place.latitude);
    const double flattening = globe.polar_radius_m / globe.equatorial_radius_m;
    return normalized({cos_lat * cos_lon, cos_lat * sin_lon, flattening * flattening * sin_lat});
}

LonLat lon_lat_of(const Globe& globe, const Vector3& direction)
{
    const double stretch = globe.equatorial_radius_m / globe.polar_radius_m;
    const double across = length({direction.x, direction.y, 0.0});
    return {Angle::from_radians(std::atan2(direction.y, direction.x)),
            Angle::from_radians(std::atan2(stretch * stretch * direction.z, across))};
}

LocalFrame local_frame(const Globe& globe, const Vector3& direction)
{
    const double across = length({direction.x, direction.y, 0.0});
    const Vector3 east =
        across > 0.0 ? Vector3{-direction.y / across, direction.x / across, 0.0} : Vector3{0.0, 1.0, 0.0};
    const double stretch = globe.equatorial_radius_m / globe.polar_radius_m;
    const Vector3 up = normalized({direction.x, direction.y, stretch * stretch * direction.z});
    return {east, cross(up, east), up};
}

} // namespace duskline
