#pragma once

#include <duskline/casting/casters.h>
#include <duskline/execution/progress.h>
#include <duskline/light/directional_light.h>

namespace duskline {

/// The part of a light's disc that is seen from each cell: 0 in the full shadow, 1 in the full light, between in
/// the half-shadow (penumbra); NaN where the heights have no data.
using VisibleFraction = Grid<float>;

/// Soft shadows: how much of the disc stands over the horizon of every cell, as a share of its solid angle.
///
/// The disc is cut into upright slices and the horizon taken as level within each: 3 of them where it is smooth, 15
/// where it jumps; more for wide discs. What of the disc is below the horizontal lights nothing: from level ground a
/// sun that is half up is seen to one half, and a disc whose centre is below the horizontal can still light. A disc of
/// no size gives the hard mask, 0 or 1.
///
/// The caster finds the cells in half-shadow, by its masks for the suns at the lower and upper edge of the disc and
/// those of `sweep` at its sides; rays find their horizons. By an exact caster the result is about 0.005, in the
/// half-shadow, from averaging masks over the disc, but for the side of a shadow that a spike a cell wide casts, which
/// no mask may show. `sweep` takes cells for fully lit or dark that are not, as in its masks. Discs wider than 1
/// degree ask no caster: every cell gets its horizons, slowly.
///
/// Same bytes for any number of threads and any SIMD level. Throws InvalidInput for angles or cell sizes out of
/// range, Cancelled. Cost: two masks, and 1 to 2 microseconds a cell in half-shadow; memory: 4 masks and 4 bytes a
/// cell.
VisibleFraction visible_fraction(const HeightField& field, const DirectionalLight& light,
                                 const Caster& caster, const Execution& execution = {});

} // namespace duskline
