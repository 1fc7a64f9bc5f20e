#pragma once

#include <duskline/planet/planet_tile.h>

#include <cstdint>
#include <vector>

namespace duskline {

/// Every tile of a level, all round the globe.
inline std::vector<PlanetTile> tiles_of_level(std::uint32_t level)
{
    std::vector<PlanetTile> tiles;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (std::uint32_t row = 0; row < 1U << level; ++row)
            for (std::uint32_t column = 0; column < 1U << level; ++column)
                tiles.push_back({face, level, row, column});
    return tiles;
}

} // namespace duskline
