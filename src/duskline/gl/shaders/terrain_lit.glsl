// How much of the light's disc a place on the ground sees, by what a technique has left.
//
// SHADOW_LOOKUP   what that is (gl/shadow_lookup.h)
//   0             nothing: all is lit
//   1             a mask: 0 in shadow, 1 in the light
//   2             heights of shadow: lit is what lies at or above
//   3             two of them, of the disc's two edges
//   4, 5          a silhouette map; a place is asked for itself, not the cells around it
//   6             nothing: every line on the way to the light is looked at, for every place
//   7             two masks, one turning into the other
//   8             the visible part of the disc, 0 to 1
//   9             a shadow map that goes with the viewer; again for the place itself

#include "four_cells.glsl"
#include "terrain_shadow.glsl" // disc_above

uniform sampler2D heights_m; // NaN where there are no data

bool has_data(ivec2 at)
{
    return !isnan(texelFetch(heights_m, at, 0).r);
}

// Where to gather the four cells around a place: their common corner, whatever its rounding.
vec2 corner_of_four(vec2 cell)
{
    return (floor(cell) + 1.0) / vec2(textureSize(heights_m, 0));
}

#if SHADOW_LOOKUP == 9
#include "terrain_shadow_map.glsl"

float lit_over(vec2 cell, vec2 across, vec2 down)
{
    return terrain_shadow_map(cell);
}

bool is_lit(ivec2 at)
{
    return terrain_shadow_map(at) > 0.5;
}

#elif SHADOW_LOOKUP >= 4 && SHADOW_LOOKUP <= 6
#include "smap_shadow.glsl"

// In 256 parts of a cell, so that a place on a line is on it, whatever its rounding: lines do not shade themselves.
vec2 in_parts(vec2 cell)
{
    return clamp(floor(cell * 256.0 + 0.5) / 256.0, vec2(0.0), vec2(textureSize(heights_m, 0) - 1));
}

bool is_shadowed(vec3 point)
{
#if SHADOW_LOOKUP == 6
    return is_shadowed_by_full_scan(point);
#else
    return is_shadowed_by_smap(point);
#endif
}

float lit_over(vec2 cell, vec2 across, vec2 down)
{
    vec2 place = in_parts(cell);
    vec4 around_m = textureGather(heights_m, corner_of_four(place));
    vec4 shares = shares_of_known(shares_of_four(fract(place)), around_m);
    if (dot(shares, vec4(1.0)) <= 0.0)
        return 1.0;
    return is_shadowed(vec3(in_light_frame(place), mean_of_four(around_m, shares))) ? 0.0 : 1.0;
}

bool is_lit(ivec2 at)
{
    return !is_shadowed(vec3(in_light_frame(vec2(at)), texelFetch(heights_m, at, 0).r));
}

#elif SHADOW_LOOKUP == 0

float lit_over(vec2 cell, vec2 across, vec2 down)
{
    return 1.0;
}

bool is_lit(ivec2 at)
{
    return true;
}

#else
#define IS_MASK (SHADOW_LOOKUP == 1 || SHADOW_LOOKUP == 7)
uniform sampler2D shadow;
uniform sampler2D later_shadow;
uniform float later_share;
uniform float shadow_drop_m; // the height a shadow loses over the diagonal of a cell

#if IS_MASK
// -1 in shadow, 1 in the light, between cells as texture units interpolate. Cells without data are lit: the edge beside
// them is where the ground ends.
float clearance_between(sampler2D mask, vec2 cell)
{
    return 2.0 * textureLod(mask, (cell + 0.5) / vec2(textureSize(mask, 0)), 0.0).r - 1.0;
}
#elif SHADOW_LOOKUP == 8
// The visible part between the four cells around; those without data do not count.
float fraction_between(vec2 cell)
{
    vec2 corner = corner_of_four(cell);
    vec4 shares = shares_of_known(shares_of_four(fract(cell)), textureGather(heights_m, corner));
    return dot(shares, vec4(1.0)) > 0.0 ? mean_of_four(textureGather(shadow, corner), shares) : 1.0;
}
#else
// How far the ground lies above its shadow: 1 or more far above, -1 far below. Only what a shadow loses over a cell
// counts, so that between cells it changes sign where the edge is.
vec4 clearances_of_four(vec2 corner, vec4 ground_m)
{
#if SHADOW_LOOKUP == 2
    return clamp((ground_m - textureGather(shadow, corner)) / shadow_drop_m, -1.0, 1.0);
#else
    vec4 lower_m = textureGather(shadow, corner, 0);
    vec4 upper_m = textureGather(shadow, corner, 1);
    vec4 hard = mix(vec4(-1.0), vec4(1.0), greaterThanEqual(ground_m, upper_m));
    vec4 soft = clamp(2.0 * (ground_m - lower_m) / (upper_m - lower_m) - 1.0, -1.0, 1.0);
    bvec4 finite = lessThan(abs(lower_m) + abs(upper_m), vec4(1e30));
    bvec4 apart = greaterThan(upper_m - lower_m, vec4(1e-3 * shadow_drop_m));
    return mix(mix(hard, soft, apart), hard, not(finite));
#endif
}

// Between the four cells around; those without data do not count.
float clearance_between(vec2 cell)
{
    vec2 corner = corner_of_four(cell);
    vec4 ground_m = textureGather(heights_m, corner);
    vec4 shares = shares_of_known(shares_of_four(fract(cell)), ground_m);
    return dot(shares, vec4(1.0)) > 0.0 ? mean_of_four(clearances_of_four(corner, ground_m), shares) : 1.0;
}
#endif

// -1 in shadow, 1 in the light -> 0, 1; between them an edge as wide as a pixel that takes `width` cells.
float sharpened(float clearance, float width)
{
    float soft = clamp(width, 0.02, 1.0);
    return smoothstep(-soft, soft, clearance);
}

// At one place.
float lit_at(vec2 cell, float width)
{
#if SHADOW_LOOKUP == 1
    return sharpened(clearance_between(shadow, cell), width);
#elif SHADOW_LOOKUP == 7
    return mix(sharpened(clearance_between(shadow, cell), width),
               sharpened(clearance_between(later_shadow, cell), width), later_share);
#elif SHADOW_LOOKUP == 8
    return fraction_between(cell);
#elif SHADOW_LOOKUP == 2
    return sharpened(clearance_between(cell), width);
#else
    return disc_above(-clearance_between(cell));
#endif
}

// Over a pixel that is so large on the ground (columns and rows from pixel to pixel): the mean of four places in it, which
// are one where it is smaller than a cell.
float lit_over(vec2 cell, vec2 across, vec2 down)
{
    float width = max(length(across), length(down));
    float spread = width < 1.0 ? 0.0 : 1.0;
    float edge = width < 1.0 ? width : 0.5 * width;
    vec2 one = spread * (0.375 * across + 0.125 * down);
    vec2 other = spread * (0.125 * across - 0.375 * down);
    return 0.25 * (lit_at(cell - one, edge) + lit_at(cell + other, edge) + lit_at(cell + one, edge)
                   + lit_at(cell - other, edge));
}

// The yes or no of a cell, as a mask has it.
bool is_lit(ivec2 at)
{
#if SHADOW_LOOKUP == 1 || SHADOW_LOOKUP == 8
    return texelFetch(shadow, at, 0).r > 0.5;
#elif SHADOW_LOOKUP == 7
    return mix(texelFetch(shadow, at, 0).r, texelFetch(later_shadow, at, 0).r, later_share) > 0.5;
#elif SHADOW_LOOKUP == 2
    return texelFetch(heights_m, at, 0).r >= texelFetch(shadow, at, 0).r;
#else
    vec2 limbs_m = texelFetch(shadow, at, 0).rg;
    return 2.0 * texelFetch(heights_m, at, 0).r >= limbs_m.r + limbs_m.g;
#endif
}
#endif
