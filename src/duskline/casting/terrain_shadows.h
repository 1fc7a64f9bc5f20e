#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/geometry/cell_rectangle.h>

#include <cstddef>
#include <optional>

namespace duskline {

/// The shadows of one terrain under a sun that moves, while the terrain is being edited: the bytes of
/// `cast_by_exact`, always, in memory that is there already.
///
///     TerrainShadows shadows(terrain);
///     for (const DirectionalLight& sun : day)
///         draw(shadows.cast(sun));
///     raise(terrain, hill);             // heights change in place
///     shadows.heights_changed(hill);
///     draw(shadows.mask());             // as if cast anew
///
/// Shapes: the mask has the field's rows and columns. No data, borders, ties: as for `ray`. Lights at or below the
/// horizon and straight overhead are answered as well.
///
/// Keeps a view of the heights, which must outlive it and change only as `heights_changed` is told. Not to be
/// used by two threads at a time. Memory: a byte per cell, and 8 per 64 x 64 cells.
class TerrainShadows {
public:
    /// One pass over the heights. Throws InvalidInput for cell sizes out of range, Cancelled.
    explicit TerrainShadows(const HeightField& field, const Execution& execution = {});

    /// Casts a sun, which stays the current one until the next. The mask is this object's own: the next call changes
    /// it. Throws InvalidInput for angles out of range, with everything as it was, and Cancelled, with no current sun.
    /// Cost: at most that of `cast_by_exact`, without its pass for the greatest height and without new memory.
    const ShadowMask& cast(const DirectionalLight& light, const Execution& execution = {});

    /// The mask of the current sun; `unknown` everywhere before the first, without a meaning after Cancelled.
    const ShadowMask& mask() const { return mask_; }

    /// To be called when heights in a rectangle have changed, raised, lowered, turned to no data or from it: casts
    /// anew, under the current sun, what that can change. These are the cells of the rectangle and those down-light
    /// of it, as far as the shadow of its highest old or new ground reaches. Returns how many cells were cast:
    /// those, and the cells between them and the ground towards the light that can shade them; 0 without a
    /// current sun.
    ///
    /// Throws InvalidInput for a rectangle that reaches out of the grid, with everything as it was, and Cancelled,
    /// with no current sun. Cost: O(cells cast), and a pass over the rectangle.
    std::size_t heights_changed(const CellRectangle& rectangle, const Execution& execution = {});

private:
    HeightRange touched_blocks_range(const CellRectangle& rectangle) const;
    void measure_blocks(std::size_t first_row, std::size_t last_row, std::size_t first_column,
                        std::size_t last_column, const Execution& execution);

    HeightField field_;
    Grid<HeightRange> blocks_; ///< the lowest and highest ground of blocks of cells
    HeightRange total_;
    ShadowMask mask_;
    std::optional<DirectionalLight> sun_;
};

} // namespace duskline
