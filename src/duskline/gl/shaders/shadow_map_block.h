// How a shader finds places in shadow maps. One declaration for C++ and for GLSL (std140).
//
// (position, 1) times `to_column`, `to_row` and `to_depth`, for positions relative to the eye, is a place in the box of a
// map, 0 to 1 each way; depth grows away from the light.

#ifdef __cplusplus
#pragma once

#include <duskline/gl/shaders/terrain_shadow_block.h>

#include <array>
#include <cstddef>

namespace duskline::gl {

struct alignas(16) ShadowMapPart {
    BlockVec4 to_column;
    BlockVec4 to_row;
    BlockVec4 to_depth;
    BlockVec4
        borders; ///< distances from the eye up to which kernels are of 5, 4, 3 and 2 taps a side, metres
    float fade_begin_m = 0.0f; ///< distances from the eye between which shadows fade
    float fade_end_m = 0.0f;
    float texel = 1.0f;  ///< 1 over the map's texels a side
    float spread = 1.0f; ///< texels from tap to tap
};

struct alignas(16) ShadowMapBlock {
    ShadowMapPart near_box;
    ShadowMapPart wide_box;
    std::array<BlockVec4, 8>
        disc;              ///< 16 points of a disc of radius 1, two in each; any first few lie well apart
    float strength = 1.0f; ///< of shadows: 0 none, 1 full
    int overlay = 0;       ///< ShadowMapOverlay
    int samples = 8;       ///< points of the disc, 4 to 16
};

static_assert(sizeof(ShadowMapPart) == 80);
static_assert(offsetof(ShadowMapBlock, disc) == 160 && offsetof(ShadowMapBlock, strength) == 288);
static_assert(sizeof(ShadowMapBlock) == 304);

} // namespace duskline::gl
#else
struct ShadowMapPart {
    vec4 to_column;
    vec4 to_row;
    vec4 to_depth;
    vec4 borders;
    float fade_begin_m;
    float fade_end_m;
    float texel;
    float spread;
};
layout(std140, binding = DUSKLINE_SHADOW_MAP_BLOCK) uniform ShadowMapBlock
{
    ShadowMapPart near_box;
    ShadowMapPart wide_box;
    vec4 disc[8];
    float strength;
    int overlay;
    int samples;
}
shadow_map;
#endif
