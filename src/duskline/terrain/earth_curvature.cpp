#include <duskline/terrain/earth_curvature.h>

#include <cmath>
#include <string>

namespace duskline {

namespace {

void require_finite(const char* what, double value)
{
    if (!std::isfinite(value))
        throw InvalidInput(std::string(what) + " must be a finite number, got " + std::to_string(value));
}

} // namespace

double curvature_drop_m(double distance_m, double coefficient, double radius_m)
{
    return coefficient * distance_m * distance_m / (2.0 * radius_m);
}

CurvedEarth::CurvedEarth(const EarthCurvature& curvature, CellSize cell_size_m, std::size_t columns)
    : drop_of_column_m_(columns),
      drop_per_square_row_m_(curvature_drop_m(cell_size_m.y, curvature.coefficient, curvature.radius_m)),
      tangent_row_(curvature.tangent_row)
{
    require_valid(HeightField{{}, cell_size_m});
    require_finite("curvature coefficient", curvature.coefficient);
    require_finite("tangent row", curvature.tangent_row);
    require_finite("tangent column", curvature.tangent_column);
    if (!(curvature.radius_m > 0.0 && std::isfinite(curvature.radius_m)))
        throw InvalidInput("radius must be above 0 metres and finite, got "
                           + std::to_string(curvature.radius_m));
    for (std::size_t column = 0; column < columns; ++column) {
        const double east_m = (static_cast<double>(column) - curvature.tangent_column) * cell_size_m.x;
        drop_of_column_m_[column] = curvature_drop_m(east_m, curvature.coefficient, curvature.radius_m);
    }
}

void CurvedEarth::lower(GridView<float> heights_m, std::size_t first_row, std::size_t first_column) const
{
    assert(first_column + heights_m.columns() <= drop_of_column_m_.size());
    const double* column_m = drop_of_column_m_.data() + first_column;
    for (std::size_t y = 0; y < heights_m.rows(); ++y) {
        const double rows = static_cast<double>(first_row + y) - tangent_row_;
        const double row_m = drop_per_square_row_m_ * (rows * rows);
        const auto row = heights_m.row(y);
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = static_cast<float>(row[x] - (column_m[x] + row_m));
    }
}

} // namespace duskline
