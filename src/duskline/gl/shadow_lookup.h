#pragma once

#include <duskline/gl/texture.h>

namespace duskline::gl {

/// In what form a technique leaves its shadows for shaders: SHADOW_LOOKUP of terrain_lit.glsl.
enum class ShadowLookup {
    none,    ///< no texture: all is lit
    mask,    ///< r8, 0 in shadow, 1 in the light and for no data
    heights, ///< r32f, heights of shadow: lit is what lies at or above
    limbs,   ///< rg32f, those below which all of the light's disc is hidden, and above which nothing is
};
inline constexpr int kShadowLookups = 4;

/// The shadows of a terrain as a technique has left them, a texel for each cell. The texture is the technique's.
struct TerrainShadow {
    ShadowLookup lookup = ShadowLookup::none;
    const Texture* texture = nullptr;
};

} // namespace duskline::gl
