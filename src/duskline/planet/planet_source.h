#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/grid.h>

namespace duskline {

/// Heights measured on a grid of longitude and latitude: of a whole planet or of a part.
///
///   heights_m    metres above the ellipsoid (mean sea level does as well), row 0 north, column 0 west; NaN: no data
///   west, north  outer border of the first column and row; latitudes geodetic
///   cell_*       above 0; rows must not reach beyond the poles, nor columns further than once round
struct PlanetSource {
    Grid<float> heights_m;
    Angle west;
    Angle north;
    Angle cell_width;
    Angle cell_height;
};

/// Throws InvalidInput for places and sizes out of range, and for a source without cells.
void require_valid(const PlanetSource& source);

} // namespace duskline
