#pragma once

#include <duskline/planet/planet_tile.h>
#include <duskline/planet/tile_heights.h>

#include <cstdint>
#include <functional>

namespace duskline {

/// The heights of a tile. They must stay as they are and where they are while anybody asks.
using HeightsOfTile = std::function<const TileHeights&(const PlanetTile&)>;

/// The ground of one level all round the globe: between neighbouring samples of a row or column it is the straight line from
/// one to the other in space, as it is drawn.
struct PlanetLevel {
    Globe globe;
    std::uint32_t level = 0;
    HeightRange range; ///< of all its heights, or a wider one
    HeightsOfTile heights_of;
};

/// Throws InvalidInput for a globe or level out of range, or an empty range of heights.
void require_valid(const PlanetLevel& ground);

} // namespace duskline
