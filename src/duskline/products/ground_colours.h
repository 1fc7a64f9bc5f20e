#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/cell_rectangle.h>
#include <duskline/products/level_water.h>
#include <duskline/products/tint.h>
#include <duskline/terrain/height_field.h>

#include <span>

namespace duskline {

/// What ground looks like lying level in full light, and how much of it there is to see.
struct GroundColour {
    Colour colour;
    float opacity = 1.0f;
};

/// The ground's own colours, row by row: a tint with rock on steep slopes and water, and over it a texture wherever
/// that is opaque. Keeps references to the field and the tint, and a view of the texture.
class GroundColours {
public:
    /// `texture` is empty or of the field's size.
    GroundColours(const HeightField& field, const Tint& tint, GridView<const Rgba8> texture,
                  const Execution& execution);

    /// Of ground that moves: water is what is level in the ground at rest, of the same size, and stays water.
    GroundColours(const HeightField& field, const HeightField& at_rest, const Tint& tint,
                  GridView<const Rgba8> texture, const Execution& execution);

    /// The colours of a row, given its slopes (`slopes_of_row`); without a meaning where there are no data.
    void fill_row(std::size_t row, std::span<const float> dz_dx, std::span<const float> dz_dy,
                  std::span<GroundColour> colours) const;

    /// Whether ground of that height is the surface of a sea, which lies level.
    bool is_water(float height_m) const { return water_.is_water(height_m); }

    const HeightField& field() const { return field_; }

private:
    GroundColour colour(std::size_t row, std::size_t column, float steepness) const;

    const HeightField& field_;
    const Tint& tint_;
    GridView<const Rgba8> texture_;
    LevelWater water_;
    SrgbDecoder decoder_;
};

/// Paints cells of a picture of the ground's own colours: sRGB, opaque; transparent black where there are no data. The
/// picture has the size of the colours' field. Throws Cancelled. Cost: the rows of the rectangle.
void paint_ground(const GroundColours& colours, const CellRectangle& rectangle, GridView<Rgba8> picture,
                  const Execution& execution = {});

/// What of such a picture changes when heights change in a rectangle: that, and the cells around it, by whose slopes they
/// count. How far a shore is from water stays what it was when the colours were made.
CellRectangle repainted(const CellRectangle& heights_changed, const HeightField& field);

/// A picture of the ground's own colours, for renderers that light it themselves: sRGB, opaque; transparent black
/// where there are no data. Throws InvalidInput for a texture of another size, Cancelled.
Picture ground_picture(const HeightField& field, const Tint& tint, GridView<const Rgba8> texture = {},
                       const Execution& execution = {});

} // namespace duskline
