#pragma once

#include <duskline/geometry/cell_rectangle.h>
#include <duskline/gl/texture.h>

namespace duskline::gl {

/// Heights, or shadow heights (a ShadowField, by any caster), as a texture of one float a cell, no data and infinities
/// included. Throws InvalidInput when the grid is empty or larger than the context allows.
Texture height_texture(const GridView<const float>& heights_m);

/// Brings a rectangle of such a texture up to date with the grid it was made of: after an edit, or with the rectangle
/// that `changed_rectangle` found. Throws InvalidInput unless texture and grid have one size and hold the rectangle.
/// Cost: the bytes of the rectangle.
void upload_rectangle(Texture& texture, const GridView<const float>& heights_m,
                      const CellRectangle& rectangle);

/// The smallest rectangle with every cell in which two grids of one size differ; of no rows where none does. NaN is
/// like any NaN. Throws InvalidInput for different sizes. Cost: one pass over both.
CellRectangle changed_rectangle(const GridView<const float>& before, const GridView<const float>& after);

} // namespace duskline::gl
