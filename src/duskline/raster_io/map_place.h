#pragma once

#include <duskline/raster_io/read_height_field.h>

namespace duskline {

/// A place on a grid in the library's order: rows and columns from the centre of cell (0, 0), fractions allowed.
struct GridPlace {
    double row = 0.0;
    double column = 0.0;
};

/// Where a place in the raster's own map coordinates lies on its grid; it may be outside. A raster without a
/// geotransform has pixels for coordinates, x to the right and y down from its upper left corner.
GridPlace grid_place(const HeightFileFacts& facts, double x, double y);

} // namespace duskline
