#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/vector.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
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

/// The upward unit normal of every cell, one plane for each component; NaN in all three where there is no data,
/// and `up` above 0 elsewhere. Made once, it serves any number of lights.
struct NormalField {
    Grid<float> east;
    Grid<float> north;
    Grid<float> up;

    std::size_t rows() const { return up.rows(); }
    std::size_t columns() const { return up.columns(); }
};

/// The normals of Horn's slopes, to a few units in the last place of a float. Throws InvalidInput for cell sizes out
/// of range, Cancelled. Some nanoseconds and 12 bytes a cell.
NormalField upward_normals(const HeightField& field, const Execution& execution = {});

/// A unit normal in three signed bytes, 127 for 1; (0, 0, 0) stands for no data. What comes back, made a unit vector
/// again, lies within 0.4 degrees of what went in, 0.17 on average.
using PackedNormal = std::array<std::int8_t, 3>;
PackedNormal packed(Vector3 normal);
Vector3 unpacked(PackedNormal bytes);

/// What the normals are after they were packed to bytes and unpacked.
NormalField through_bytes(const NormalField& normals, const Execution& execution = {});

} // namespace duskline
