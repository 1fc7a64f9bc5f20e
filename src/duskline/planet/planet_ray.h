#pragma once

#include <duskline/planet/light_axis.h>
#include <duskline/planet/planet_level.h>

namespace duskline {

/// The truth for shadows on a curved planet: a march in double precision from a point towards the sun, in its half-plane
/// about the light's axis, past every crossing with the rows and columns of the samples, over tiles and faces, until no
/// ground can be as far from the axis any more. Beyond the terminator as well: the globe itself shades.
///
/// Light is parallel and goes straight (no refraction). The ground right under a point does not count, and where ray and
/// ground touch the point is lit, as for `cast_by_ray`. Directions need not be unit vectors, but may not be 0.
///
/// Takes some 20 ns a crossing: 0.1 ms for a shadow of 5000 samples. Safe to ask from many threads if `heights_of` is.
class PlanetRays {
public:
    /// Throws InvalidInput for a globe, level or direction out of range, or an empty range of heights.
    /// `raised`: see LightAxis.
    PlanetRays(PlanetLevel ground, const Vector3& to_sun, Angle raised = {});

    /// The height above the ellipsoid under which a point in that direction is in shadow: minus infinity where nothing stands
    /// nearer to the sun (under the sun itself), plus infinity on the axis of the planet's shadow.
    double shadow_height_m(const Vector3& direction) const;

    /// Whether a point is lit; faster, as it ends at the first ground above the ray.
    bool is_lit(const Vector3& direction, double height_m) const;

private:
    PlanetLevel ground_;
    LightAxis axis_;
};

} // namespace duskline
