#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>

namespace duskline {

/// The lit part of each cell's area: 0 in shadow, 1 in the light, between only where the edge of a shadow
/// passes through the cell; NaN where the heights have no data.
using LitFraction = Grid<float>;

/// Shadow edges placed within the cells they pass through, for pictures without stairs.
///
/// Nothing is blurred. The clearance (ground less shadow height) is above 0 in the light and below it in
/// shadow; between four cell centres it is taken as bilinear, and what counts is the part of the cell where it
/// is at least 0, found on 4 x 4 points. Clearances count up to the height a shadow loses over the diagonal
/// of a cell: on level ground that is just enough for edges to lie where they are; where ground and shadow
/// drift apart faster (the sides of a shadow) the edge passes midway between the centres. A cell whose 8
/// neighbours all agree with it has 0 or 1, and so has every cell under `uniform_answer`'s lights. Cells
/// beyond the border and cells without data agree with whoever asks.
///
/// Takes the light the heights were cast with. Throws InvalidInput when the sizes differ, Cancelled. Some
/// nanoseconds a cell.
LitFraction lit_fraction(const HeightField& field, const ShadowField& shadow_heights_m,
                         const DirectionalLight& light, const Execution& execution = {});

/// 0 or 1 for every cell of a mask, NaN for `unknown`.
LitFraction lit_fraction(const ShadowMask& mask, const Execution& execution = {});

} // namespace duskline
