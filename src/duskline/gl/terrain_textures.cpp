#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/terrain_textures.h>
#include <duskline/terrain/require_same_size.h>
#include <duskline/view/level_of_detail.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace duskline::gl {

namespace {

std::size_t all_levels(const HeightField& field)
{
    return static_cast<std::size_t>(std::bit_width(std::max(field.rows(), field.columns())));
}

bool has_holes(const HeightField& field)
{
    for (std::size_t row = 0; row < field.rows(); ++row)
        if (std::ranges::any_of(field.heights_m.row(row),
                                [](float height_m) { return std::isnan(height_m); }))
            return true;
    return false;
}

} // namespace

TerrainTextures::TerrainTextures(const HeightField& field, GridView<const std::array<std::uint8_t, 4>> ground)
    : field_(field), filled_m_(has_holes(field) ? with_holes_filled(field) : Grid<float>()),
      heights_(TextureFormat::r32f, field.columns(), field.rows()),
      mesh_heights_(TextureFormat::r32f, field.columns(), field.rows(), all_levels(field)),
      ground_(TextureFormat::srgb8_alpha8, field.columns(), field.rows(), all_levels(field))
{
    require_same_size("the ground's colours", ground, field);
    heights_.upload(field.heights_m);
    mesh_heights_.set_filter(Texture::Filter::trilinear);
    mesh_heights_.upload(filled_m_.empty() ? field.heights_m : GridView<const float>(filled_m_.view()));
    mesh_heights_.make_mipmaps();
    ground_.set_filter(Texture::Filter::trilinear);
    ground_.upload(ground);
    ground_.make_mipmaps();
}

namespace {

template <typename T>
GridView<const T> part_of(GridView<const T> all, const CellRectangle& rectangle)
{
    return all.window(rectangle.first_row, rectangle.first_column, rectangle.rows, rectangle.columns);
}

} // namespace

void TerrainTextures::heights_changed(const CellRectangle& rectangle)
{
    const GridView<const float> changed_m = part_of(field_.heights_m, rectangle);
    heights_.upload(changed_m, rectangle.first_row, rectangle.first_column);
    if (filled_m_.empty()) {
        mesh_heights_.upload(changed_m, rectangle.first_row, rectangle.first_column);
    } else {
        for (std::size_t row = 0; row < rectangle.rows; ++row)
            for (std::size_t column = 0; column < rectangle.columns; ++column)
                if (!std::isnan(changed_m(row, column)))
                    filled_m_(rectangle.first_row + row, rectangle.first_column + column) =
                        changed_m(row, column);
        mesh_heights_.upload(part_of(std::as_const(filled_m_).view(), rectangle), rectangle.first_row,
                             rectangle.first_column);
    }
    mesh_heights_.make_mipmaps();
}

void TerrainTextures::colours_changed(GridView<const std::array<std::uint8_t, 4>> ground,
                                      const CellRectangle& rectangle)
{
    require_same_size("the ground's colours", ground, field_);
    ground_.upload(part_of(ground, rectangle), rectangle.first_row, rectangle.first_column);
    ground_.make_mipmaps();
}

} // namespace duskline::gl
