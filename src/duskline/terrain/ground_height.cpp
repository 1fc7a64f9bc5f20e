#include <duskline/terrain/ground_height.h>

#include <cmath>

namespace duskline {

namespace {

// As in the march of rays (casting/grid_line_surface.h): closer to a sample is on it.
constexpr double kSlack_cells = 1e-6;

// A share `t` of the way from a to b, either of which may be missing; NaN where nothing is known.
double between(double a, double b, double t)
{
    const double height_m = a + (b - a) * t;
    if (!std::isnan(height_m))
        return height_m;
    if (t <= kSlack_cells)
        return a;
    return t >= 1.0 - kSlack_cells ? b : height_m;
}

double sample_m(const HeightField& field, double row, double column)
{
    const bool inside = row >= 0.0 && column >= 0.0 && row < static_cast<double>(field.rows())
                        && column < static_cast<double>(field.columns());
    return inside ? field.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column))
                  : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

std::optional<double> ground_height_m(const HeightField& field, double row, double column)
{
    const double y = std::floor(row);
    const double x = std::floor(column);
    const auto on_row = [&](double line) {
        return between(sample_m(field, line, x), sample_m(field, line, x + 1.0), column - x);
    };
    const double height_m = between(on_row(y), on_row(y + 1.0), row - y);
    return std::isnan(height_m) ? std::nullopt : std::optional(height_m);
}

} // namespace duskline
