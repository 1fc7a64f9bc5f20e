#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/planet/planet_level.h>

namespace duskline {

/// The truth for lamps on a curved planet: whether two points see each other over the ground of a level. The same march in
/// double precision as that of PlanetRays, past every crossing of the straight line between the points with the rows and
/// columns of the samples, over tiles and faces and beyond the horizon: the globe itself stands between, too.
///
///        lamp *----___                      A lamp infinitely far away is a sun.
///            /|       ----____  ____ p
///      _____/ |_/\_          _-
///               crossings
///
/// The ground right under either point does not count, and where line and ground touch they see each other, as for lamps of
/// `cast_by_ray`. Ground counts where rows and columns are crossed, so a point under the ground sees what is in its own square.
/// Light goes straight (no refraction). From either end the answer is the same, but where line and ground come within rounding
/// (a nanometre or so) of touching.
///
/// Takes some 20 ns a crossing up to the first ground in the way. Safe to ask from many threads if `heights_of` is.
class PlanetSight {
public:
    /// Throws InvalidInput for a globe or level out of range, or an empty range of heights.
    explicit PlanetSight(PlanetLevel ground);

    /// Of points in the planet's frame, metres, near the ground or anywhere in space. Throws InvalidInput, with the point, for
    /// one that is not finite or is the centre.
    bool sees(const Vector3& from_m, const Vector3& to_m) const;

private:
    PlanetLevel ground_;
};

} // namespace duskline
