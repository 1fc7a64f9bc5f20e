#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/height_texture.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>

namespace duskline::gl {

namespace {

std::string size_text(std::size_t columns, std::size_t rows)
{
    return std::to_string(columns) + " x " + std::to_string(rows);
}

bool differ(float a, float b)
{
    return !(a == b || (std::isnan(a) && std::isnan(b)));
}

// The columns [first, last) in which two rows differ.
struct Columns {
    std::size_t first;
    std::size_t last;
};

Columns changed_columns(std::span<const float> before, std::span<const float> after)
{
    const auto first = std::mismatch(before.begin(), before.end(), after.begin(), std::not_fn(differ));
    const auto last = std::mismatch(before.rbegin(), before.rend(), after.rbegin(), std::not_fn(differ));
    const auto from = static_cast<std::size_t>(first.first - before.begin());
    return {from, std::max(from, before.size() - static_cast<std::size_t>(last.first - before.rbegin()))};
}

} // namespace

Texture height_texture(const GridView<const float>& heights_m)
{
    Texture texture(TextureFormat::r32f, heights_m.columns(), heights_m.rows());
    texture.upload(heights_m);
    return texture;
}

void upload_rectangle(Texture& texture, const GridView<const float>& heights_m,
                      const CellRectangle& rectangle)
{
    if (texture.width() != heights_m.columns() || texture.height() != heights_m.rows())
        throw InvalidInput("a texture of " + size_text(texture.width(), texture.height())
                           + " cannot be brought up to date with a grid of "
                           + size_text(heights_m.columns(), heights_m.rows()));
    if (rectangle.first_row > heights_m.rows() || rectangle.rows > heights_m.rows() - rectangle.first_row
        || rectangle.first_column > heights_m.columns()
        || rectangle.columns > heights_m.columns() - rectangle.first_column)
        throw InvalidInput("a rectangle of " + size_text(rectangle.columns, rectangle.rows) + " from column "
                           + std::to_string(rectangle.first_column) + " and row "
                           + std::to_string(rectangle.first_row) + " on reaches out of a grid of "
                           + size_text(heights_m.columns(), heights_m.rows()));
    texture.upload(
        heights_m.window(rectangle.first_row, rectangle.first_column, rectangle.rows, rectangle.columns),
        rectangle.first_row, rectangle.first_column);
}

CellRectangle changed_rectangle(const GridView<const float>& before, const GridView<const float>& after)
{
    if (before.rows() != after.rows() || before.columns() != after.columns())
        throw InvalidInput("grids of " + size_text(before.columns(), before.rows()) + " and "
                           + size_text(after.columns(), after.rows()) + " cannot be compared cell by cell");
    std::size_t first_row = before.rows();
    std::size_t last_row = 0;
    std::size_t first_column = before.columns();
    std::size_t last_column = 0;
    for (std::size_t row = 0; row < before.rows(); ++row) {
        const Columns changed = changed_columns(before.row(row), after.row(row));
        if (changed.first == changed.last)
            continue;
        first_row = std::min(first_row, row);
        last_row = row + 1;
        first_column = std::min(first_column, changed.first);
        last_column = std::max(last_column, changed.last);
    }
    if (first_row >= last_row)
        return {};
    return {first_row, first_column, last_row - first_row, last_column - first_column};
}

} // namespace duskline::gl
