// How much of the light's disc a place on the ground sees, by what a technique has left in `shadow`.
//
// SHADOW_LOOKUP   what that is
//   0             nothing: all is lit
//   1             a mask: 0 in shadow, 1 in the light
//   2             heights of shadow: lit is what lies at or above
//   3             two of them, of the disc's two edges

#include "terrain_shadow.glsl" // disc_above

uniform sampler2D heights_m; // NaN where there are no data
uniform sampler2D shadow;
uniform float shadow_drop_m; // the height a shadow loses over the diagonal of a cell

// A finite float, so that infinities and what is made of them cannot spoil a mean.
float held(float x)
{
    return clamp(x, -1.0, 1.0);
}

// How far the ground at a cell lies above its shadow: 1 or more far above, -1 far below. Only what a shadow loses over
// a cell counts, so that between cells it changes sign where the edge is. Of a mask its answer, 1 or -1.
float clearance(ivec2 at)
{
    float height_m = texelFetch(heights_m, at, 0).r;
#if SHADOW_LOOKUP == 1
    return 2.0 * texelFetch(shadow, at, 0).r - 1.0;
#elif SHADOW_LOOKUP == 3
    vec2 limbs_m = texelFetch(shadow, at, 0).rg;
    if (isinf(limbs_m.g) || isinf(limbs_m.r) || !(limbs_m.g - limbs_m.r > 1e-3 * shadow_drop_m))
        return height_m >= limbs_m.g ? 1.0 : -1.0;
    return held(2.0 * (height_m - limbs_m.r) / (limbs_m.g - limbs_m.r) - 1.0);
#else
    float shadow_m = texelFetch(shadow, at, 0).r;
    return isinf(shadow_m) ? (shadow_m < 0.0 ? 1.0 : -1.0) : held((height_m - shadow_m) / shadow_drop_m);
#endif
}

bool has_data(ivec2 at)
{
    return !isnan(texelFetch(heights_m, at, 0).r);
}

// Bilinear between the four cells around; cells without data do not count.
float clearance_between(vec2 cell)
{
    ivec2 last = textureSize(heights_m, 0) - 1;
    vec2 first = floor(cell);
    vec2 rest = cell - first;
    float sum = 0.0;
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 at = clamp(ivec2(first) + step, ivec2(0), last);
        vec2 near = mix(1.0 - rest, rest, vec2(step));
        float weight = near.x * near.y;
        if (weight > 0.0 && has_data(at)) {
            sum += weight * clearance(at);
            weights += weight;
        }
    }
    return weights > 0.0 ? sum / weights : 1.0;
}

// At one place; `width` is how many cells a pixel takes. An edge is as wide as a pixel.
float lit_at(vec2 cell, float width)
{
#if SHADOW_LOOKUP == 0
    return 1.0;
#elif SHADOW_LOOKUP != 3
    float soft = clamp(width, 0.02, 1.0);
    return smoothstep(-soft, soft, clearance_between(cell));
#else
    return disc_above(-clearance_between(cell));
#endif
}

// The yes or no of a cell, as a mask has it.
bool is_lit(ivec2 at)
{
#if SHADOW_LOOKUP == 0
    return true;
#elif SHADOW_LOOKUP == 1
    return texelFetch(shadow, at, 0).r > 0.5;
#elif SHADOW_LOOKUP == 2
    return texelFetch(heights_m, at, 0).r >= texelFetch(shadow, at, 0).r;
#else
    vec2 limbs_m = texelFetch(shadow, at, 0).rg;
    return 2.0 * texelFetch(heights_m, at, 0).r >= limbs_m.r + limbs_m.g;
#endif
}

// Over a pixel that is so large on the ground (columns and rows from pixel to pixel).
float lit_over(vec2 cell, vec2 across, vec2 down)
{
    float width = max(length(across), length(down));
    if (width < 1.0)
        return lit_at(cell, width);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 offset = vec2[](vec2(-0.375, -0.125), vec2(0.125, -0.375), vec2(0.375, 0.125), vec2(-0.125, 0.375))[i];
        sum += lit_at(cell + offset.x * across + offset.y * down, 0.5 * width);
    }
    return 0.25 * sum;
}
