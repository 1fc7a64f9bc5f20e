#pragma once

#include <duskline/geometry/grid.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace duskline {

/// A grey picture or map made smaller: the mean of the cells that fall to each pixel, of numbers as they are. Whole cells
/// only, so that columns (and rows) of pixels stand for numbers of cells that differ by at most one. Throws InvalidInput
/// unless 1 <= rows <= the map's rows, and likewise columns.
Grid<std::uint8_t> mean_of_cells(GridView<const std::uint8_t> map, std::size_t rows, std::size_t columns);

/// How pictures of one size lie side by side, row after row.
struct TileLayout {
    std::size_t columns = 1; ///< pictures in a row, at least 1
    std::size_t gap = 0;     ///< pixels between them and around all of them
    std::size_t caption = 0; ///< pixels over each for a line of text

    std::size_t rows_for(std::size_t tiles) const { return (tiles + columns - 1) / columns; }
};

/// The upper left pixel of a tile.
struct TilePlace {
    std::size_t row = 0;
    std::size_t column = 0;
};
TilePlace tile_place(const TileLayout& layout, std::size_t tile, std::size_t tile_rows,
                     std::size_t tile_columns);

/// The columns for so many tiles, at least 1: those that leave the fewest places empty, of a picture that is nearly square
/// to half as wide again.
std::size_t columns_for(std::size_t tiles, std::size_t tile_rows, std::size_t tile_columns);

/// The pictures side by side, black where there is none, dark grey between them. Captions, one for each or none, are
/// written in the caption's height: digits, colons and hyphens; other signs leave a blank. Throws InvalidInput unless all
/// pictures have one size and there is one at least.
Grid<std::uint8_t> tiled(std::span<const Grid<std::uint8_t>> pictures, const TileLayout& layout,
                         std::span<const std::string> captions = {});

} // namespace duskline
