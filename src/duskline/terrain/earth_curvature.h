#pragma once

#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// How ground falls away from the plane that touches a globe, as light sees it.
///
/// A place d metres from the tangent point lies coefficient d^2 / (2 radius) lower. Air bends light
/// downwards, so that the globe seems flatter: the coefficient is 6/7 with the Earth's air, as in
/// gdal_viewshed, 1 without air, and 0 for a flat earth. The parabola stands for the sphere: it is 3 mm
/// wrong at 50 km, 0.8 m at 200 km.
struct EarthCurvature {
    double coefficient = 6.0 / 7.0; ///< finite
    double radius_m = 6371000.0;    ///< of the globe near the terrain; the Earth's mean by default
    double tangent_row = 0.0;    ///< the tangent point in cells of the whole grid, fractions allowed; usually
    double tangent_column = 0.0; ///< its centre. Light stays parallel everywhere else.
};

/// How far the ground lies below the tangent plane, `distance_m` from the tangent point, metres.
double curvature_drop_m(double distance_m, double coefficient, double radius_m);

/// Lowers the heights of a grid, all at once or window by window: every height sinks by the same amount and
/// to the same bits, whatever the windows. After that a flat world's shadows are right for the round one.
class CurvedEarth {
public:
    /// For a grid of that many columns. Throws InvalidInput unless the cell size and the radius are finite
    /// and above 0, and the rest is finite.
    CurvedEarth(const EarthCurvature& curvature, CellSize cell_size_m, std::size_t columns);

    /// Lowers, in place, the window of the grid that begins at (first_row, first_column). NaN stays NaN.
    /// Runs at about the speed of memory on one thread; windows may be lowered by several at a time.
    void lower(GridView<float> heights_m, std::size_t first_row = 0, std::size_t first_column = 0) const;

private:
    std::vector<double> drop_of_column_m_;
    double drop_per_square_row_m_;
    double tangent_row_;
};

} // namespace duskline
