#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/brush.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

void require_valid(const Brush& brush)
{
    if (!(brush.radius_m > 0.0 && std::isfinite(brush.radius_m)))
        throw InvalidInput("the radius of a brush must be above 0, got " + std::to_string(brush.radius_m));
    if (!(brush.amount_m >= 0.0 && std::isfinite(brush.amount_m)))
        throw InvalidInput("the amount of a brush must be at least 0, got " + std::to_string(brush.amount_m));
    if (!(brush.smoothing >= 0.0 && brush.smoothing <= 1.0))
        throw InvalidInput("the smoothing of a brush must be from 0 to 1, got "
                           + std::to_string(brush.smoothing));
}

// The cells of one axis within a distance of a place: first and count.
struct Span {
    std::size_t first = 0;
    std::size_t count = 0;
};

Span covered(double at, double reach, std::size_t cells)
{
    const double first = std::max(0.0, std::ceil(at - reach));
    const double last = std::min(static_cast<double>(cells) - 1.0, std::floor(at + reach));
    if (!(first <= last))
        return {};
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(last - first) + 1};
}

// Of the data among a cell and its neighbours.
float mean_around(GridView<const float> heights_m, std::size_t row, std::size_t column)
{
    float sum = 0.0f;
    float count = 0.0f;
    for (std::size_t y = row - std::min<std::size_t>(row, 1); y < std::min(row + 2, heights_m.rows()); ++y)
        for (std::size_t x = column - std::min<std::size_t>(column, 1);
             x < std::min(column + 2, heights_m.columns()); ++x)
            if (!std::isnan(heights_m(y, x))) {
                sum += heights_m(y, x);
                count += 1.0f;
            }
    return sum / count;
}

} // namespace

CellRectangle stroke(GridView<float> heights_m, CellSize cell_size_m, const GridPoint& at, const Brush& brush)
{
    require_valid(brush);
    duskline::require_valid(HeightField{heights_m, cell_size_m});
    const Span rows = covered(at.row, brush.radius_m / cell_size_m.y, heights_m.rows());
    const Span columns = covered(at.column, brush.radius_m / cell_size_m.x, heights_m.columns());
    if (rows.count == 0 || columns.count == 0)
        return {};
    Grid<float> after_m(rows.count, columns.count);
    for (std::size_t y = 0; y < rows.count; ++y)
        for (std::size_t x = 0; x < columns.count; ++x) {
            const std::size_t row = rows.first + y;
            const std::size_t column = columns.first + x;
            const double down_m = (static_cast<double>(row) - at.row) * cell_size_m.y;
            const double right_m = (static_cast<double>(column) - at.column) * cell_size_m.x;
            const double inside = std::max(
                0.0, 1.0 - (down_m * down_m + right_m * right_m) / (brush.radius_m * brush.radius_m));
            const auto effect = static_cast<float>(inside * inside);
            const float before_m = heights_m(row, column);
            if (brush.effect == BrushEffect::smooth)
                after_m(y, x) = before_m
                                + effect * static_cast<float>(brush.smoothing)
                                      * (mean_around(heights_m, row, column) - before_m);
            else
                after_m(y, x) = before_m
                                + (brush.effect == BrushEffect::raise ? effect : -effect)
                                      * static_cast<float>(brush.amount_m);
        }
    for (std::size_t y = 0; y < rows.count; ++y)
        std::ranges::copy(after_m.row(y),
                          heights_m.row(rows.first + y).subspan(columns.first, columns.count).begin());
    return {rows.first, columns.first, rows.count, columns.count};
}

} // namespace duskline
