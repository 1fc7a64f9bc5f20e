#pragma once

#include <cstddef>

namespace duskline {

/// Cells of a grid: `rows` x `columns` of them from (first_row, first_column) on.
struct CellRectangle {
    std::size_t first_row = 0;
    std::size_t first_column = 0;
    std::size_t rows = 0;
    std::size_t columns = 0;
};

} // namespace duskline
