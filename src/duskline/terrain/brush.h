#pragma once

#include <duskline/geometry/cell_rectangle.h>
#include <duskline/geometry/vector.h>
#include <duskline/terrain/height_field.h>

namespace duskline {

/// What a stroke does to the ground.
enum class BrushEffect {
    raise,
    lower,
    smooth, ///< towards the mean of the eight cells around
};

/// A round brush: its whole effect in the middle, falling smoothly to none at the radius.
struct Brush {
    BrushEffect effect = BrushEffect::raise;
    double radius_m = 100.0; ///< above 0
    double amount_m = 10.0;  ///< raised or lowered in the middle; at least 0
    double smoothing = 0.5;  ///< of the way to the mean, in the middle; 0 to 1
};

/// One stroke of a brush at a place in cells (its height does not matter), in place. Cells without data stay without.
/// Returns the cells that may have changed, of no rows where the brush touches none: what has to be told to those who
/// keep shadows, meshes or textures. Cost: the cells under the brush.
/// Throws InvalidInput for a brush or cell size out of range.
CellRectangle stroke(GridView<float> heights_m, CellSize cell_size_m, const GridPoint& at,
                     const Brush& brush);

} // namespace duskline
