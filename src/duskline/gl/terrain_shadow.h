#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/gl/buffer.h>
#include <duskline/gl/shaders/terrain_shadow_block.h>
#include <duskline/gl/texture.h>
#include <duskline/light/directional_light.h>
#include <duskline/terrain/height_field.h>

namespace duskline::gl {

/// How a grid lies in a world: which of its places and directions are which. All lengths in units of the world, and
/// any axes: a metre up may be {0, 1, 0}, and the origin may lie relative to the eye, so that numbers stay small.
struct GridPlacement {
    Vector3 origin = {};                   ///< the centre of cell (0, 0) at height 0
    Vector3 column_step = {1.0, 0.0, 0.0}; ///< from a cell to the next one in its row
    Vector3 row_step = {0.0, -1.0, 0.0};   ///< from a cell to the next one in its column
    Vector3 metre_up = {0.0, 0.0, 1.0};    ///< a metre of height; longer to exaggerate heights
};

/// x east, y north, z up, metres from the centre of cell (0, 0).
GridPlacement placement_in_metres(CellSize cell_size_m);

/// What `shadow_factor` needs (shaders/terrain_shadow.glsl) for a texture of shadow heights: one component, or two for
/// soft edges (ShadowSweepOptions::limbs). The light is the one they were cast for.
/// Throws InvalidInput when the steps lie in one plane, so that a place has no column and row.
TerrainShadowBlock terrain_shadow_block(const GridPlacement& placement, const Texture& shadow_heights,
                                        const DirectionalLight& light);

/// The units that terrain_shadow.glsl reads from unless told otherwise.
inline constexpr unsigned int kTerrainShadowUnit = 7;

/// Puts texture and block where shaders that include terrain_shadow.glsl find them. `buffer` holds the block and must
/// live while they draw.
void bind_terrain_shadow(const Texture& shadow_heights, const TerrainShadowBlock& block, Buffer& buffer,
                         unsigned int unit = kTerrainShadowUnit);

} // namespace duskline::gl
