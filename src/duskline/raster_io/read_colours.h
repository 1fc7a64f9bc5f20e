#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/read_height_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace duskline {

/// The colours of any raster that GDAL reads, on the grid of a height file, in the library's order of rows and
/// columns: red, green, blue and opacity, 0 where the raster has no colour.
///
/// Bands of 8 bits: red, green, blue and perhaps alpha; grey and perhaps alpha; or numbers with a table of
/// colours. A raster on another grid, or in another coordinate system, is warped to the heights' grid
/// (bilinear; each cell takes the average of what lies under it where the raster is finer). One without a
/// place of its own must have the heights' rows and columns, and is taken to lie over them.
///
/// Throws InputError, saying why, when it cannot be read so; UnsupportedOnThisMachine when memory does not
/// suffice; Cancelled.
Grid<std::array<std::uint8_t, 4>> read_colours(const std::string& path, const HeightFile& like,
                                               const Execution& execution = {});

/// The same on a grid of `rows` x `columns` cells over the ground of the heights. A raster without a place of its own
/// may also have that size; one of the heights' size is then resampled.
Grid<std::array<std::uint8_t, 4>> read_colours(const std::string& path, const HeightFile& like,
                                               std::size_t rows, std::size_t columns,
                                               const Execution& execution = {});

} // namespace duskline
