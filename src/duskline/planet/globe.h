#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>

#include <array>

namespace duskline {

/// The figure of a planet: an ellipsoid of revolution about its axis.
///
/// Planets have one frame, fixed to them and right-handed: origin at the centre, z to the north pole, x to longitude 0,
/// y to 90 degrees east; metres.
///
/// Heights stand on the ellipsoid along the line FROM THE CENTRE: the ground in the planetocentric unit direction d is the
/// point (base_radius_m(d) + height) d. Heights of files stand along the ellipsoid's normal, at most 0.19 degrees aside on
/// the earth: taking one for the other moves a summit 4 km high by at most 13 m sideways and 2 cm in height.
struct Globe {
    double equatorial_radius_m = 6378137.0;
    double polar_radius_m = 6356752.314245179;

    bool operator==(const Globe&) const = default;
};

/// The earth (NIMA TR8350.2).
inline constexpr Globe kWgs84 = {};

/// The Moon of maps (IAU).
inline constexpr double kMoonRadius_m = 1737400.0;

constexpr Globe sphere_of_radius(double radius_m)
{
    return {radius_m, radius_m};
}

/// Throws InvalidInput unless both radii are finite, above 0 and within a factor of two of each other.
void require_valid(const Globe& globe);

/// From the centre to the ellipsoid. `direction` is a unit vector, as everywhere below.
double base_radius_m(const Globe& globe, const Vector3& direction);

/// The point at a height above the ellipsoid in a direction.
inline Vector3 point_m(const Globe& globe, const Vector3& direction, double height_m)
{
    return direction * (base_radius_m(globe, direction) + height_m);
}

/// How high a point (not the centre) is above the ellipsoid along its own direction.
double height_m(const Globe& globe, const Vector3& point_m);

/// A place on the ellipsoid as maps have it: longitude eastwards, latitude geodetic (of the ellipsoid's normal), -90 to 90
/// degrees. On a sphere geodetic and planocentric latitude are the same.
struct LonLat {
    Angle longitude;
    Angle latitude;
};

/// Where the ellipsoid at that place lies, seen from the centre; and back, with longitudes from -180 to 180 degrees.
/// Closed form, exact to rounding: tan(planetocentric) = (polar / equatorial)^2 tan(geodetic).
Vector3 direction_at(const Globe& globe, const LonLat& place);
LonLat lon_lat_of(const Globe& globe, const Vector3& direction);

/// The point at a place and height (along the direction from the centre, see above).
inline Vector3 point_m(const Globe& globe, const LonLat& place, double height_m)
{
    return point_m(globe, direction_at(globe, place), height_m);
}

/// What is east, north and up at a place: unit vectors, right-handed. Up is the ellipsoid's normal. At the poles, where
/// every direction is south or north, the frame is that of longitude 0.
struct LocalFrame {
    Vector3 east;
    Vector3 north;
    Vector3 up;
};
LocalFrame local_frame(const Globe& globe, const Vector3& direction);

} // namespace duskline
