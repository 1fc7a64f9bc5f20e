#pragma once

#include <algorithm>
#include <cstddef>

namespace duskline {

/// Cells of a grid: `rows` x `columns` of them from (first_row, first_column) on.
struct CellRectangle {
    std::size_t first_row = 0;
    std::size_t first_column = 0;
    std::size_t rows = 0;
    std::size_t columns = 0;

    bool operator==(const CellRectangle&) const = default;
};

/// The smallest rectangle that holds two; of none when neither has cells.
constexpr CellRectangle united(const CellRectangle& a, const CellRectangle& b)
{
    if (a.rows == 0 || a.columns == 0)
        return b;
    if (b.rows == 0 || b.columns == 0)
        return a;
    const std::size_t first_row = std::min(a.first_row, b.first_row);
    const std::size_t first_column = std::min(a.first_column, b.first_column);
    return {first_row, first_column, std::max(a.first_row + a.rows, b.first_row + b.rows) - first_row,
            std::max(a.first_column + a.columns, b.first_column + b.columns) - first_column};
}

/// A rectangle and the cells up to so many around it, within a grid of that size. Of none it stays none.
constexpr CellRectangle grown(const CellRectangle& a, std::size_t by, std::size_t rows, std::size_t columns)
{
    if (a.rows == 0 || a.columns == 0)
        return {};
    const std::size_t first_row = a.first_row - std::min(a.first_row, by);
    const std::size_t first_column = a.first_column - std::min(a.first_column, by);
    return {first_row, first_column, std::min(a.first_row + a.rows + by, rows) - first_row,
            std::min(a.first_column + a.columns + by, columns) - first_column};
}

} // namespace duskline
