// How a shader finds the shadow over a place in the world. One declaration for C++ and for GLSL (std140).
//
// A world position p lies over the grid at column = dot(to_column, (p, 1)) and row = dot(to_row, (p, 1)), counted from
// the centre of cell (0, 0), and dot(to_height, (p, 1)) metres high.

#ifdef __cplusplus
#pragma once

#include <cstddef>

namespace duskline::gl {

struct alignas(16) BlockVec4 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    float w = 0.0f;
};

struct alignas(16) TerrainShadowBlock {
    BlockVec4 to_column;
    BlockVec4 to_row;
    BlockVec4 to_height;
    float soft = 0.0f; ///< 1 for two heights, the disc's edges; 0 for one
    float lowest_limb =
        -1.0f; ///< of the disc, -1 its lower edge to 1 its upper one, that is above the horizontal
    float unused[2] = {};
};

static_assert(offsetof(TerrainShadowBlock, to_row) == 16 && offsetof(TerrainShadowBlock, to_height) == 32);
static_assert(offsetof(TerrainShadowBlock, soft) == 48 && offsetof(TerrainShadowBlock, lowest_limb) == 52);
static_assert(sizeof(TerrainShadowBlock) == 64);

} // namespace duskline::gl
#else
layout(std140, binding = DUSKLINE_SHADOW_BLOCK) uniform TerrainShadowBlock
{
    vec4 to_column;
    vec4 to_row;
    vec4 to_height;
    float soft;
    float lowest_limb;
}
terrain_shadow;
#endif
