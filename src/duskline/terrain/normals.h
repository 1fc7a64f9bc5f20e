#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <span>

namespace duskline {

// The slope of the ground by Horn's weights, as gdaldem's hillshade and slope:
//
//      a b c      dz_dx = ((c - a) + 2 (f - d) + (i - g)) / (8 cell_size_m.x)     eastwards
//      d e f
//      g h i      dz_dy = ((a - g) + 2 (b - h) + (c - i)) / (8 cell_size_m.y)     northwards
//
// Every cell with data has a slope. A line of the nine that lacks one end (beyond the border, or no data)
// is measured from its middle instead, one that lacks more is left out and the others count for it; with
// none left the slope is 0. So a plane keeps its slope up to its border and to holes in it. A cell without
// data has slope NaN. (gdaldem leaves out every cell that misses a neighbour; elsewhere the two agree.)
// Source: Horn, Hill shading and the reflectance map, Proc. IEEE 69, 1981.

/// Metres of rise per metre of ground, eastwards and northwards.
struct Slope {
    double dz_dx = 0.0;
    double dz_dy = 0.0;
};

/// The slope at one cell.
Slope slope_at(const HeightField& field, std::size_t row, std::size_t column);

/// The slopes of a whole row, the same numbers rounded to float; each span holds one value per column. Some
/// nanoseconds a cell where no neighbour is missing.
void slopes_of_row(const HeightField& field, std::size_t row, std::span<float> dz_dx, std::span<float> dz_dy);

/// The unit vector that stands on ground of that slope, pointing up.
inline Vector3 upward_normal(Slope slope)
{
    return normalized({-slope.dz_dx, -slope.dz_dy, 1.0});
}

} // namespace duskline
