#include <duskline/raster_io/map_place.h>

namespace duskline {

GridPlace grid_place(const HeightFileFacts& facts, double x, double y)
{
    const auto transform = facts.geotransform.value_or(std::array{0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    const auto [x0, x_per_column, x_per_row, y0, y_per_column, y_per_row] = transform;
    const double determinant = x_per_column * y_per_row - x_per_row * y_per_column;
    GridPlace place;
    place.column = ((x - x0) * y_per_row - (y - y0) * x_per_row) / determinant - 0.5;
    place.row = ((y - y0) * x_per_column - (x - x0) * y_per_column) / determinant - 0.5;
    if (facts.ground.columns_flipped)
        place.column = static_cast<double>(facts.columns) - 1.0 - place.column;
    if (facts.ground.rows_flipped)
        place.row = static_cast<double>(facts.rows) - 1.0 - place.row;
    return place;
}

} // namespace duskline
