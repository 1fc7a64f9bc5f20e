// Shadows of a planet from the heights of shadow at the corners of tiles: lit is what lies at or above. Of a disc there are
// two heights, and between them a part of it is seen.
//
// Between corners clearances (height less shadow height) are interpolated, between the two suns of a sun that moves too, and a
// tile that turns into its parent turns its clearances into the parent's as it turns its heights: so neither edges of
// tiles nor changes of level show, and edges of shadow travel.

#include "visible_disc.glsl"

uniform sampler2DArray planet_shadows_m; // 129 x 129 a tile
uniform sampler2DArray planet_second_shadows_m;

// Further above or below a shadow than ground can be: infinities that can be interpolated.
const float kFarFromShadow_m = 1e6;

// Over the first height and the second; of one height, over that.
vec2 corner_clearances_m(int layer, ivec2 corner, float second)
{
    ivec3 place = ivec3(corner, layer);
    vec2 height_m = vec2(tile_height_m(layer, corner));
    vec2 clear_m[2] = vec2[](vec2(0.0), vec2(0.0));
    if (second < 1.0)
        clear_m[0] = clamp(height_m - texelFetch(planet_shadows_m, place, 0).rg, -kFarFromShadow_m, kFarFromShadow_m);
    if (second > 0.0)
        clear_m[1] = clamp(height_m - texelFetch(planet_second_shadows_m, place, 0).rg, -kFarFromShadow_m, kFarFromShadow_m);
    return mix(clear_m[0], clear_m[1], second);
}

vec2 clearances_m(int layer, vec2 corner, float second)
{
    ivec2 first = clamp(ivec2(floor(corner)), ivec2(0), ivec2(kTileSquares - 1));
    vec2 t = corner - vec2(first);
    vec2 upper = mix(corner_clearances_m(layer, first, second),
                     corner_clearances_m(layer, first + ivec2(1, 0), second), t.x);
    vec2 lower = mix(corner_clearances_m(layer, first + ivec2(0, 1), second),
                     corner_clearances_m(layer, first + ivec2(1, 1), second), t.x);
    return mix(upper, lower, t.y);
}

// At the sharpest an edge is as wide as a pixel.
float light_at(vec2 clear_m)
{
#if PLANET_DISC
    float middle_m = 0.5 * (clear_m.x + clear_m.y);
    float half_m = max(0.5 * (clear_m.x - clear_m.y), max(0.7 * fwidth(middle_m), 1e-3));
    return visible_disc(middle_m + vec2(half_m, -half_m), -1.0);
#else
    float soft_m = max(0.7 * fwidth(clear_m.x), 1e-3);
    return smoothstep(-soft_m, soft_m, clear_m.x);
#endif
}

float planet_shadow(PlanetPlace place)
{
    bool own = place.layers.z != 0;
    bool parents = place.layers.w != 0;
    if (!own && !parents)
        return 1.0;
    // What is missing stands back for what is there.
    float turned = own ? (parents ? place.turned : 0.0) : 1.0;
    vec2 own_m = vec2(0.0);
    vec2 parents_m = vec2(0.0);
    if (turned < 1.0)
        own_m = clearances_m(place.layers.x, place.at, place.second_shadows.x);
    if (turned > 0.0)
        parents_m = clearances_m(place.layers.y, vec2(place.in_parent) + 0.5 * place.at, place.second_shadows.y);
    return light_at(mix(own_m, parents_m, turned));
}

vec4 planet_shadow_overlay(PlanetPlace place, float lit)
{
    return vec4(0.0);
}
