// How a shader finds lamps and places in their depth maps. One declaration for C++ and for GLSL (std140).
//
// Places are relative to the eye, in the axes of the scene.

#ifdef __cplusplus
#pragma once

#include <duskline/gl/shaders/terrain_shadow_block.h>
#include <duskline/view/scene_lamp.h>

#include <array>
#include <cstddef>

namespace duskline::gl {

struct alignas(16) LampOnCard {
    BlockVec4 place; ///< from the eye, metres; the range
    BlockVec4 axis;  ///< of the beam, unit; cosine at its border, or -2 without a beam
    BlockVec4 light; ///< at 1 m, in suns; 1 over how much the cosine grows to where the beam is full
    BlockVec4 right; ///< of a searchlight's map, unit; 1 over half the side of a map 1 m ahead
    BlockVec4 up;    ///< of a searchlight's map, unit
    std::array<int, 6> layers = {}; ///< of faces; a searchlight's is the first
    int faces = 0;                  ///< 1 or 6
    int unused = 0;
};

struct alignas(16) LampBlock {
    std::array<LampOnCard, kMostLamps> lamps;
    int count = 0;
    int taps = 1;       ///< of the kernel, a side
    float texel = 1.0f; ///< 1 over the maps' texels a side
    float nearest_m = 0.1f;
};

static_assert(kMostLamps == 8);
static_assert(offsetof(LampOnCard, layers) == 80 && sizeof(LampOnCard) == 112);
static_assert(offsetof(LampBlock, count) == 896 && sizeof(LampBlock) == 912);

} // namespace duskline::gl
#else
struct LampOnCard {
    vec4 place;
    vec4 axis;
    vec4 light;
    vec4 right;
    vec4 up;
    ivec4 first_layers;
    ivec2 last_layers;
    int faces;
    int unused;
};
layout(std140, binding = DUSKLINE_LAMP_BLOCK) uniform LampBlock
{
    LampOnCard lamps[8];
    int count;
    int taps;
    float texel;
    float nearest_m;
}
lamp_maps;
#endif
