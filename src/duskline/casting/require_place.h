#pragma once

// Places from which shadows may be asked for. Not installed.

#include <duskline/geometry/invalid_input.h>
#include <duskline/geometry/vector.h>

#include <cmath>
#include <string>

namespace duskline {

inline void require_coordinate(const char* what, double coordinate)
{
    // The farthest place whose neighbours a double can still name.
    constexpr double farthest = 4503599627370496.0;
    if (!(std::abs(coordinate) <= farthest))
        throw InvalidInput(std::string(what)
                           + " must be a finite number of cells, at most 2^52 from the grid, got "
                           + std::to_string(coordinate));
}

/// Throws InvalidInput unless both are finite and at most 2^52 cells away.
inline void require_place(double row, double column)
{
    require_coordinate("row", row);
    require_coordinate("column", column);
}

/// Throws InvalidInput for a height of NaN.
inline void require_height(const GridPoint& point)
{
    if (std::isnan(point.height_m))
        throw InvalidInput("the height of a point must be a number, got NaN");
}

} // namespace duskline
