#include <duskline/geometry/invalid_input.h>
#include <duskline/products/tiles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace duskline {

namespace {

constexpr std::uint8_t kGap = 40;
constexpr std::uint8_t kText = 220;

// Digits, colon and hyphen on 3 x 5 points, row by row from the highest bit of 15.
constexpr std::size_t kGlyphRows = 5;
constexpr std::size_t kGlyphColumns = 3;
constexpr std::array<std::uint16_t, 12> kGlyphs = {0b111101101101111, 0b010110010010111, 0b111001111100111,
                                                   0b111001111001111, 0b101101111001001, 0b111100111001111,
                                                   0b111100111101111, 0b111001001010010, 0b111101111101111,
                                                   0b111101111001111, 0b000010000010000, 0b000000111000000};

std::uint16_t glyph_of(char sign)
{
    if (sign >= '0' && sign <= '9')
        return kGlyphs.at(static_cast<std::size_t>(sign - '0'));
    if (sign == ':')
        return kGlyphs[10];
    return sign == '-' ? kGlyphs[11] : std::uint16_t{0};
}

void draw_glyph(GridView<std::uint8_t> picture, std::uint16_t glyph, TilePlace at, std::size_t scale)
{
    for (std::size_t y = 0; y < kGlyphRows * scale; ++y)
        for (std::size_t x = 0; x < kGlyphColumns * scale; ++x) {
            const std::size_t bit = kGlyphRows * kGlyphColumns - 1 - (y / scale * kGlyphColumns + x / scale);
            const bool inside = at.row + y < picture.rows() && at.column + x < picture.columns();
            if (inside && ((static_cast<unsigned int>(glyph) >> bit) & 1U) != 0)
                picture(at.row + y, at.column + x) = kText;
        }
}

// In the middle of a line `height` pixels high, with a point of the glyphs as many pixels wide as fit.
void draw_text(GridView<std::uint8_t> picture, const std::string& text, TilePlace at, std::size_t height)
{
    const std::size_t scale = std::max<std::size_t>(height / (kGlyphRows + 2), 1);
    const std::size_t above = (height - std::min(height, kGlyphRows * scale)) / 2;
    for (std::size_t i = 0; i < text.size(); ++i)
        draw_glyph(picture, glyph_of(text[i]), {at.row + above, at.column + i * (kGlyphColumns + 1) * scale},
                   scale);
}

// The cells of a side that fall to one of its `pixels`.
struct Cells {
    std::size_t first;
    std::size_t last;
};
Cells cells_of(std::size_t pixel, std::size_t pixels, std::size_t cells)
{
    return {pixel * cells / pixels, (pixel + 1) * cells / pixels};
}

std::uint8_t mean(GridView<const std::uint8_t> map, Cells rows, Cells columns)
{
    std::uint64_t sum = 0;
    for (std::size_t y = rows.first; y < rows.last; ++y)
        for (const std::uint8_t value : map.row(y).subspan(columns.first, columns.last - columns.first))
            sum += value;
    const std::uint64_t count = (rows.last - rows.first) * (columns.last - columns.first);
    return static_cast<std::uint8_t>((sum + count / 2) / count);
}

void require_one_size(std::span<const Grid<std::uint8_t>> pictures)
{
    if (pictures.empty())
        throw InvalidInput("there are no pictures to lay side by side");
    for (const Grid<std::uint8_t>& picture : pictures)
        if (picture.rows() != pictures.front().rows() || picture.columns() != pictures.front().columns())
            throw InvalidInput("pictures laid side by side must have one size");
}

} // namespace

Grid<std::uint8_t> mean_of_cells(GridView<const std::uint8_t> map, std::size_t rows, std::size_t columns)
{
    if (rows < 1 || rows > map.rows() || columns < 1 || columns > map.columns())
        throw InvalidInput("a map of " + std::to_string(map.rows()) + " x " + std::to_string(map.columns())
                           + " cells cannot be shrunk to " + std::to_string(rows) + " x "
                           + std::to_string(columns));
    Grid<std::uint8_t> small(rows, columns);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x)
            small(y, x) = mean(map, cells_of(y, rows, map.rows()), cells_of(x, columns, map.columns()));
    return small;
}

TilePlace tile_place(const TileLayout& layout, std::size_t tile, std::size_t tile_rows,
                     std::size_t tile_columns)
{
    return {layout.gap + layout.caption + tile / layout.columns * (tile_rows + layout.caption + layout.gap),
            layout.gap + tile % layout.columns * (tile_columns + layout.gap)};
}

std::size_t columns_for(std::size_t tiles, std::size_t tile_rows, std::size_t tile_columns)
{
    const double square = std::sqrt(static_cast<double>(tiles) * static_cast<double>(tile_rows)
                                    / static_cast<double>(tile_columns));
    const std::size_t narrowest =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(square)), 1, tiles);
    const std::size_t widest = std::min(narrowest + (narrowest + 1) / 2, tiles);
    const auto empty = [tiles](std::size_t columns) { return (columns - tiles % columns) % columns; };
    std::size_t best = narrowest;
    for (std::size_t columns = narrowest; columns <= widest; ++columns)
        best = empty(columns) < empty(best) ? columns : best;
    return best;
}

Grid<std::uint8_t> tiled(std::span<const Grid<std::uint8_t>> pictures, const TileLayout& layout,
                         std::span<const std::string> captions)
{
    require_one_size(pictures);
    if (layout.columns < 1)
        throw InvalidInput("pictures laid side by side need a column at least");
    const std::size_t rows = pictures.front().rows();
    const std::size_t columns = pictures.front().columns();
    const std::size_t places = layout.rows_for(pictures.size()) * layout.columns;
    const TilePlace last = tile_place(layout, places - 1, rows, columns);
    const std::uint8_t ground = layout.gap + layout.caption > 0 ? kGap : std::uint8_t{0};
    Grid<std::uint8_t> sheet(last.row + rows + layout.gap, last.column + columns + layout.gap, ground);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const TilePlace place = tile_place(layout, i, rows, columns);
        for (std::size_t y = 0; y < rows; ++y)
            std::ranges::copy(pictures[i].row(y), sheet.row(place.row + y).subspan(place.column).begin());
        if (i < captions.size())
            draw_text(sheet.view(), captions[i], {place.row - layout.caption, place.column}, layout.caption);
    }
    return sheet;
}

} // namespace duskline
