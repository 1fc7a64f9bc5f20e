#pragma once

#include <duskline/geometry/cell_rectangle.h>
#include <duskline/gl/texture.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <cstdint>

namespace duskline::gl {

/// A terrain on the graphics card, for techniques that find its shadows and for pictures of it. Keeps a view of the
/// heights, which must outlive it. 13 bytes a cell.
class TerrainTextures {
public:
    /// `ground` are the colours of the ground (products/ground_colours.h), of the field's size. Throws InvalidInput for
    /// sizes that differ, that are 0, or that the context has no textures for.
    TerrainTextures(const HeightField& field, GridView<const std::array<std::uint8_t, 4>> ground);

    const HeightField& field() const { return field_; }

    /// The heights as they are, NaN for no data: r32f, one texel for each cell.
    const Texture& heights() const { return heights_; }

    /// Heights everywhere (`with_holes_filled`), with mipmaps.
    const Texture& mesh_heights() const { return mesh_heights_; }

    /// The ground's own colours, with mipmaps.
    const Texture& ground() const { return ground_; }

    /// To be called when heights have changed in a rectangle inside the grid. Where there was no data there must be none
    /// still, and the other way round. Cost: the rectangle, and the mipmaps of all.
    void heights_changed(const CellRectangle& rectangle);

    /// To be called when the ground's colours, a picture of all of it, have changed in a rectangle inside the grid. Cost:
    /// the rectangle, and the mipmaps of all.
    void colours_changed(GridView<const std::array<std::uint8_t, 4>> ground, const CellRectangle& rectangle);

private:
    HeightField field_;
    Grid<float> filled_m_; ///< empty without holes
    Texture heights_;
    Texture mesh_heights_;
    Texture ground_;
};

} // namespace duskline::gl
