#pragma once

#include <duskline/execution/progress.h>
#include <duskline/terrain/height_field.h>
#include <duskline/terrain/normals.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// Where the centre of a finer cell lies along one axis of a grid: between two samples, or in the outer half of a
/// cell at the border, where both are the one.
struct FinerPlace {
    double place = 0.0;      ///< in cells from the centre of cell 0
    std::size_t before = 0;  ///< the sample at or before it
    std::size_t after = 0;   ///< and the next
    std::size_t nearest = 0; ///< the cell it lies in
    float t = 0.0f;          ///< share of the way from `before` to `after`
};

/// The place of one of `finer_cells` cells over the ground of `cells` cells; at least one each.
FinerPlace finer_place(std::size_t finer_cell, std::size_t finer_cells, std::size_t cells);

/// The places of all of them.
std::vector<FinerPlace> finer_places(std::size_t finer_cells, std::size_t cells);

/// Values on a finer grid over the same ground: `rows` x `columns` cells, which together cover what the cells of
/// `values` cover.
///
///     o       o       o      samples, and three times as many cells along a row: cell i lies at
///     | . o . | . o . |      (i + 1/2) columns / finer_columns - 1/2 of the old columns
///
/// Between four samples a value is bilinear, so on the lines of the grid straight from sample to sample. In the
/// outer half of a cell at the border, or beside a hole, the missing samples are taken to be as the cell's own: no
/// value leaves the range of those around it. A finer cell whose centre lies in a cell without data has NaN; on the
/// edge of two cells it belongs to the one before.
///
/// Same bits for any number of threads. Throws InvalidInput unless there are at least as many rows and columns as in
/// `values`, Cancelled. Some nanoseconds a finer cell.
Grid<float> refined(GridView<const float> values, std::size_t rows, std::size_t columns,
                    const Execution& execution = {});

/// The ground between samples, as a terrain of finer cells.
Terrain refined(const HeightField& field, std::size_t rows, std::size_t columns,
                const Execution& execution = {});

/// Normals between those of the samples, made unit vectors again.
NormalField refined(const NormalField& normals, std::size_t rows, std::size_t columns,
                    const Execution& execution = {});

} // namespace duskline
