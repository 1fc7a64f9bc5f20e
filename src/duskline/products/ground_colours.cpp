#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/products/ground_colours.h>
#include <duskline/terrain/normals.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;

float steepness(float dz_dx, float dz_dy)
{
    return std::sqrt(dz_dx * dz_dx + dz_dy * dz_dy);
}

// Rock shows where the ground is steep; `slope` is the rise over run.
Colour ground_with_rock(const Tint& tint, Colour ground, float slope)
{
    const float t =
        std::clamp((slope - Tint::kSteepBegins) / (Tint::kSteepEnds - Tint::kSteepBegins), 0.0f, 1.0f);
    return mix(ground, tint.rock, tint.rock_share * t * t * (3.0f - 2.0f * t));
}

} // namespace

GroundColours::GroundColours(const HeightField& field, const Tint& tint, GridView<const Rgba8> texture,
                             const Execution& execution)
    : GroundColours(field, field, tint, texture, execution)
{}

GroundColours::GroundColours(const HeightField& field, const HeightField& at_rest, const Tint& tint,
                             GridView<const Rgba8> texture, const Execution& execution)
    : field_(field), tint_(tint), texture_(texture), water_(at_rest, tint, execution)
{}

void GroundColours::fill_row(std::size_t row, std::span<const float> dz_dx, std::span<const float> dz_dy,
                             std::span<GroundColour> colours) const
{
    for (std::size_t x = 0; x < colours.size(); ++x)
        colours[x] = colour(row, x, steepness(dz_dx[x], dz_dy[x]));
    std::vector<float> cover(colours.size());
    water_.fill_cover(row, cover);
    if (std::ranges::any_of(cover, [](float c) { return c > 0.0f; })) {
        std::vector<Colour> water(colours.size());
        water_.fill_colours(row, water);
        for (std::size_t x = 0; x < colours.size(); ++x)
            colours[x].colour = mix(colours[x].colour, water[x], cover[x]);
    }
    if (texture_.empty())
        return;
    for (std::size_t x = 0; x < colours.size(); ++x) {
        const Rgba8& texel = texture_(row, x);
        const float opacity = static_cast<float>(texel[3]) / 255.0f;
        colours[x].colour = mix(colours[x].colour, decoder_.colour(texel), opacity);
        colours[x].opacity += (1.0f - colours[x].opacity) * opacity;
    }
}

GroundColour GroundColours::colour(std::size_t row, std::size_t column, float steepness) const
{
    const float height_m = field_.heights_m(row, column);
    if (std::isnan(height_m))
        return {};
    const Palette::Entry entry = tint_.ground.at(height_m);
    const bool under_water = tint_.sea.kind == SeaKind::floor && height_m < tint_.sea.level_m;
    if (tint_.rock_share > 0.0f && !under_water)
        return {ground_with_rock(tint_, entry.colour, steepness), entry.opacity};
    return {entry.colour, entry.opacity};
}

void paint_ground(const GroundColours& colours, const CellRectangle& rectangle, GridView<Rgba8> picture,
                  const Execution& execution)
{
    const HeightField& field = colours.field();
    const SrgbEncoder encoder;
    for_rows(rectangle.rows, kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        std::vector<float> dz_dx(field.columns());
        std::vector<float> dz_dy(field.columns());
        std::vector<GroundColour> ground(field.columns());
        for (std::size_t y = rectangle.first_row + first; y < rectangle.first_row + last; ++y) {
            slopes_of_row(field, y, dz_dx, dz_dy);
            colours.fill_row(y, dz_dx, dz_dy, ground);
            for (std::size_t x = rectangle.first_column; x < rectangle.first_column + rectangle.columns; ++x)
                picture(y, x) = std::isnan(field.heights_m(y, x)) ? Rgba8{0, 0, 0, 0}
                                                                  : encoder.pixel(ground[x].colour, y, x);
        }
    });
}

CellRectangle repainted(const CellRectangle& heights_changed, const HeightField& field)
{
    return grown(heights_changed, 1, field.rows(), field.columns());
}

Picture ground_picture(const HeightField& field, const Tint& tint, GridView<const Rgba8> texture,
                       const Execution& execution)
{
    if (!texture.empty() && (texture.rows() != field.rows() || texture.columns() != field.columns()))
        throw InvalidInput("the texture must have the size of the terrain, " + std::to_string(field.rows())
                           + " x " + std::to_string(field.columns()) + ", got "
                           + std::to_string(texture.rows()) + " x " + std::to_string(texture.columns()));
    const GroundColours ground(field, tint, texture, Execution{execution.threads, {}});
    Picture picture(field.rows(), field.columns());
    paint_ground(ground, {0, 0, field.rows(), field.columns()}, picture.view(), execution);
    return picture;
}

} // namespace duskline
