#pragma once

#include <duskline/gl/texture.h>

namespace duskline::gl {

class SilhouettePasses;
class TerrainShadowMap;

/// In what form a technique leaves its shadows for shaders: SHADOW_LOOKUP of terrain_lit.glsl.
enum class ShadowLookup {
    none,        ///< nothing: all is lit
    mask,        ///< r8, 0 in shadow, 1 in the light and for no data; filtered linearly
    heights,     ///< r32f, heights of shadow: lit is what lies at or above
    limbs,       ///< rg32f, those below which all of the light's disc is hidden, and above which nothing is
    silhouettes, ///< a silhouette map, which every pixel looks itself up in
    silhouettes_by_four, ///< the same with four lines in a texel (NextVSearch::parallel_quad)
    lines,               ///< no map: every pixel looks at every line on the way to the light
    two_masks,           ///< as mask, one turning into the other
    fraction,            ///< r8, how much of the light's disc is seen
    shadow_map,          ///< a depth map that goes with the viewer, which every pixel looks itself up in
};

/// The shadows of a terrain as a technique has left them. What it points to is the technique's.
struct TerrainShadow {
    ShadowLookup lookup = ShadowLookup::none;
    const Texture* texture = nullptr;              ///< of mask, heights, limbs, ...: a texel for each cell
    const SilhouettePasses* silhouettes = nullptr; ///< of silhouettes, silhouettes_by_four, lines
    const Texture* later = nullptr;                ///< of two_masks the second
    float later_share = 0.0f;                      ///< how far the first has turned into it, 0 to 1
    const TerrainShadowMap* map = nullptr;         ///< of shadow_map
};

} // namespace duskline::gl
