#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/planet/planet_tile.h>
#include <duskline/terrain/height_field.h>

#include <cstdint>

namespace duskline {

/// The ground of a tile. Samples are counted as in PlanetTile: -1 to kTileSquares + 1, both borders included; the grids have
/// sample (row, column) at (row + 1, column + 1), rows along v upwards.
///
///   heights_m   above the ellipsoid along the line from the centre (see Globe); never NaN
///   measured    1 where the height is a source's, 0 where detail was made up
struct TileHeights {
    Grid<float> heights_m{kTileStored, kTileStored};
    Grid<std::uint8_t> measured{kTileStored, kTileStored};
    HeightRange range; ///< of samples 0 to kTileSquares

    float height_m(std::int32_t row, std::int32_t column) const
    {
        return heights_m(static_cast<std::size_t>(row) + 1, static_cast<std::size_t>(column) + 1);
    }
    bool is_measured(std::int32_t row, std::int32_t column) const
    {
        return measured(static_cast<std::size_t>(row) + 1, static_cast<std::size_t>(column) + 1) != 0;
    }
    std::size_t bytes() const { return heights_m.size() * sizeof(float) + measured.size(); }
};

/// What the vertices of a tile are relative to when they are floats: the point at its middle, amid its heights. From the
/// ellipsoid instead, vertices on mountains would be off by tenths of a millimetre, which is seen from a metre away.
inline Vector3 origin_m(const Globe& globe, const PlanetTile& tile, const TileHeights& heights)
{
    const HeightRange range = heights.range;
    return point_m(globe, centre_direction(tile),
                   (static_cast<double>(range.lowest_m) + static_cast<double>(range.highest_m)) / 2.0);
}

/// Where a sample of a tile is.
inline Vector3 sample_point_m(const Globe& globe, const PlanetTile& tile, const TileHeights& heights,
                              std::int32_t row, std::int32_t column)
{
    return point_m(globe, sample_direction(tile, row, column),
                   static_cast<double>(heights.height_m(row, column)));
}

} // namespace duskline
