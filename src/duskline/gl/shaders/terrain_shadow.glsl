// The shadow of the terrain, for any point of a scene: ground, trees, houses, aircraft, fog.
//
//     #include "terrain_shadow.glsl"
//     colour = albedo * (ambient + sun * shadow_factor(world_position) * max(dot(normal, to_sun), 0.0));
//
// The texture holds shadow heights (ShadowSweep, or a ShadowField uploaded as it is): the height under which a point is
// in shadow. A point is compared with what stands between the four texels around it:
//
//       o------o      at texels the answer is the caster's, to the bit; between them clearances (height less shadow
//       |  x   |      height) are interpolated, so edges run straight through cells and nothing needs a bias
//       o------o
//
// One height is a hard edge. Two are those of the disc's upper and lower edge, and between them the part of the disc
// is seen that stands over a straight horizon.
//
// Define DUSKLINE_SHADOW_TEXTURE and DUSKLINE_SHADOW_BLOCK before, to use other units than 7. Also compiled as C++, by
// the tests.

#ifndef DUSKLINE_SHADOW_TEXTURE
#define DUSKLINE_SHADOW_TEXTURE 7
#endif
#ifndef DUSKLINE_SHADOW_BLOCK
#define DUSKLINE_SHADOW_BLOCK 7
#endif

#ifndef __cplusplus
layout(binding = DUSKLINE_SHADOW_TEXTURE) uniform sampler2D terrain_shadow_heights;
#include "terrain_shadow_block.h"
#endif
#include "four_cells.glsl"
#include "visible_disc.glsl"

// Further above or below a shadow than ground can be: an infinity that can be interpolated.
const float kFarFromShadow_m = 1.0e6;

vec2 shadow_heights_at(ivec2 texel)
{
    return vec2(texelFetch(terrain_shadow_heights, texel, 0));
}

// How far a height lies above those of shadows.
vec4 clearances(float height_m, vec4 shadow_m)
{
    return clamp(vec4(height_m) - shadow_m, -kFarFromShadow_m, kFarFromShadow_m);
}

// For a place on the grid (x columns, y rows from the centre of cell (0, 0)) and a height in metres. 1 is full light,
// 0 full shadow. Outside the grid, and where there is no data, nothing is in shadow.
float shadow_factor_on_grid(vec2 place, float height_m)
{
    ivec2 size = textureSize(terrain_shadow_heights, 0);
    if (any(lessThan(place, vec2(-0.5, -0.5))) || any(greaterThan(place, vec2(size) - 0.5f)))
        return 1.0;
    vec2 within = clamp(place, vec2(0.0, 0.0), vec2(size - 1));
    ivec2 first = min(ivec2(floor(within)), size - 1);
    ivec2 last = min(first + 1, size - 1);
    // In 256 parts of a cell, as texture units do: a place that should be a texel's is, whatever its rounding.
    vec2 rest = floor((within - vec2(first)) * 256.0f + 0.5f) / 256.0f;

    vec2 south_west = shadow_heights_at(ivec2(first.x, last.y));
    vec2 south_east = shadow_heights_at(last);
    vec2 north_east = shadow_heights_at(ivec2(last.x, first.y));
    vec2 north_west = shadow_heights_at(first);
    vec4 shadow_m = vec4(south_west.x, south_east.x, north_east.x, north_west.x);
    vec4 shares = shares_of_known(shares_of_four(rest), shadow_m);
    if (dot(shares, vec4(1.0)) <= 0.0)
        return 1.0;
    float clearance_m = mean_of_four(clearances(height_m, shadow_m), shares);
    if (terrain_shadow.soft == 0.0)
        return clearance_m >= 0.0 ? 1.0 : 0.0;
    vec4 upper_m = vec4(south_west.y, south_east.y, north_east.y, north_west.y);
    return visible_disc(vec2(clearance_m, mean_of_four(clearances(height_m, upper_m), shares)),
                        terrain_shadow.lowest_limb);
}

// For a place in the world.
float shadow_factor(vec3 world_position)
{
    vec4 p = vec4(world_position, 1.0);
    vec2 place = vec2(dot(terrain_shadow.to_column, p), dot(terrain_shadow.to_row, p));
    return shadow_factor_on_grid(place, dot(terrain_shadow.to_height, p));
}
