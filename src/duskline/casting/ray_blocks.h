#pragma once

// Rays over blocks of grid squares: which ones a ray passes through until the far side of the block it stands at.
// Not installed.
//
//      +-------+-------+
//      |       |  .    |      Seen by lines, a ray passes at most two blocks of a size beside each other, so which
//      |       |.      |      ones they are is never a matter of rounding.
//      |      .|       |
//      |    P  |       |
//      +-------+-------+

#include <duskline/casting/grid_line_surface.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace duskline {

/// The line at the far side of the block of that level that lies ahead of `line`.
inline std::int64_t block_end(const GridLineSurface& surface, std::size_t level, std::int64_t line)
{
    const std::int64_t last = surface.last_line();
    if (surface.counting().lines_turned)
        return last - (((last - 1 - line) >> level) << level);
    return std::min(((line >> level) + 1) << level, last);
}

/// Whether at that line, where blocks of a level meet, blocks of the next one do.
inline bool is_border_above(const GridLineSurface& surface, std::size_t level, std::int64_t line)
{
    const std::int64_t index = surface.counting().lines_turned ? surface.last_line() - line : line;
    return ((index >> level) & 1) == 0;
}

/// The highest ground in the blocks ahead of `line` that hold the cells from `first` to `last` and the squares
/// after them. `highest_m(level, block_row, block_column)` is that of one block.
template <typename Highest>
float highest_ahead_m(const GridLineSurface& surface, std::size_t level, std::int64_t line,
                      std::int64_t first, std::int64_t last, const Highest& highest_m)
{
    const auto block_of = [level](std::int64_t square, std::int64_t last_sample, bool turned) {
        const std::int64_t last_square = std::max<std::int64_t>(last_sample - 1, 0);
        const std::int64_t inside = std::clamp<std::int64_t>(square, 0, last_square);
        return (turned ? last_square - inside : inside) >> level;
    };
    const auto line_block =
        static_cast<std::size_t>(block_of(line, surface.last_line(), surface.counting().lines_turned));
    std::int64_t block = block_of(first, surface.last_cell(), surface.counting().cells_turned);
    std::int64_t last_block = block_of(last, surface.last_cell(), surface.counting().cells_turned);
    if (block > last_block)
        std::swap(block, last_block);
    float highest = -std::numeric_limits<float>::infinity();
    for (; block <= last_block; ++block) {
        const auto cell_block = static_cast<std::size_t>(block);
        highest =
            std::max(highest, surface.counting().lines_are_rows ? highest_m(level, line_block, cell_block)
                                                                : highest_m(level, cell_block, line_block));
    }
    return highest;
}

} // namespace duskline
