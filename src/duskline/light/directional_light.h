#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>

namespace duskline {

/// Parallel light, as from the sun.
///
///   azimuth           *towards* the light, clockwise from the grid's north; any finite value, taken modulo 360
///   altitude          above the horizontal, -90 to 90 degrees; at or below 0 nothing is lit
///   angular_diameter  of the light's disc, 0 to 180 degrees; the sun's mean by default. Hard shadows take the
///                     centre of the disc.
struct DirectionalLight {
    Angle azimuth = Angle::from_degrees(315.0);
    Angle altitude = Angle::from_degrees(45.0);
    Angle angular_diameter = Angle::from_degrees(0.533);
};

/// Throws InvalidInput, with the value, unless every angle is in its range.
void require_valid(const DirectionalLight& light);

/// Unit vector towards the light: x east, y north, z up.
Vector3 direction_towards(const DirectionalLight& light);

} // namespace duskline
