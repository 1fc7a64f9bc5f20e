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

/// Shadow edges by super-sampling: 4 x 4 points over every cell that an edge may pass through, one with a neighbour
/// (diagonally too) of the other answer in `mask`, each on the surface (ground_height.h) and with a ray of its own.
/// Within about 0.03 of what 8 x 8 points find, and several times as close as what is found from shadow heights, which
/// know nothing of the ground between samples; but some 10 microseconds for each such cell. What is not ground
/// (beyond the border, beside holes) does not count. A shadow narrower than a cell and between all centres is not
/// seen. Other cells have 0 or 1.
///
/// `mask` is an exact caster's for that light. Throws InvalidInput when the sizes differ, Cancelled.
LitFraction super_sampled_lit_fraction(const HeightField& field, const ShadowMask& mask,
                                       const DirectionalLight& light, const Execution& execution = {});

/// The same for finer cells over the terrain, from their mask (casting/finer_mask.h). The result has the mask's size.
/// Throws InvalidInput for fewer cells than the terrain has, Cancelled.
LitFraction finer_super_sampled_lit_fraction(const HeightField& field, const ShadowMask& finer_mask,
                                             const DirectionalLight& light, const Execution& execution = {});

/// 0 or 1 for every cell of a mask, NaN for `unknown`.
LitFraction lit_fraction(const ShadowMask& mask, const Execution& execution = {});

} // namespace duskline
