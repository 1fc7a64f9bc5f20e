#pragma once

#include <duskline/planet/planet_tile.h>
#include <duskline/view/level_of_detail.h>

#include <cstdint>

namespace duskline {

/// A tile to draw, and at what distances from the eye its mesh turns into its parent's: from `begin_m` on each vertex moves,
/// and from `end_m` on it is where the parent's triangles are. The distance is that of the vertex's place ON THE PARENT'S
/// mesh, which both tiles at a change of level know. Tiles of level 0 never turn: both are infinite.
struct PlanetPatch {
    PlanetTile tile;
    MorphRange morph;
    std::uint32_t step =
        1; ///< every so many-th corner is enough, as seen from the eye: 1, 2, 4 or kLargestPatchStep

    bool operator==(const PlanetPatch&) const = default;
};

inline constexpr std::uint32_t kLargestPatchStep = 8;

} // namespace duskline
