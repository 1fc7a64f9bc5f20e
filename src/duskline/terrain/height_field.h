#pragma once

#include <duskline/geometry/grid.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace duskline {

/// Distance between neighbouring cell centres, metres: `x` from column to column, `y` from row to row.
struct CellSize {
    double x = 1.0;
    double y = 1.0;
};

/// Ground heights on a grid, seen and not owned.
///
///   heights_m     one sample per cell centre, metres; row 0 lies north, column 0 west; NaN where nothing
///                 was measured (no data). Infinities are not heights: readers turn them into NaN.
///   cell_size_m   distance between neighbouring cell centres, metres; finite and above 0
///
/// The surface between the samples is the grid-line surface: along every row and every column the height is
/// linear from sample to sample. No data casts no shadow and is itself neither lit nor in shadow.
struct HeightField {
    GridView<const float> heights_m;
    CellSize cell_size_m;

    std::size_t rows() const { return heights_m.rows(); }
    std::size_t columns() const { return heights_m.columns(); }

    /// A rectangle of the same terrain, without a copy.
    HeightField window(std::size_t first_row, std::size_t first_column, std::size_t row_count,
                       std::size_t column_count) const
    {
        return {heights_m.window(first_row, first_column, row_count, column_count), cell_size_m};
    }
};

/// A terrain that owns its heights. Use it wherever a HeightField is wanted.
struct Terrain {
    Grid<float> heights_m;
    CellSize cell_size_m;

    operator HeightField() const& { return {heights_m.view(), cell_size_m}; }
    operator HeightField() const&& = delete; // the view would outlive its terrain
};

/// The lowest and highest of some heights, metres; NaN does not count. Of no heights at all, lowest is plus
/// infinity and highest minus infinity.
struct HeightRange {
    float lowest_m = std::numeric_limits<float>::infinity();
    float highest_m = -std::numeric_limits<float>::infinity();

    void include(float height_m)
    {
        // NaN is neither below nor above anything.
        lowest_m = height_m < lowest_m ? height_m : lowest_m;
        highest_m = height_m > highest_m ? height_m : highest_m;
    }
    void include(HeightRange other)
    {
        lowest_m = std::min(lowest_m, other.lowest_m);
        highest_m = std::max(highest_m, other.highest_m);
    }
};

/// The range of all heights: one pass.
HeightRange height_range(const HeightField& field);

/// Throws InvalidInput unless the cell size is finite and above zero. An empty grid is no error.
void require_valid(const HeightField& field);

} // namespace duskline
