// Shadows of a planet from the heights of shadow at the corners of tiles: lit is what lies at or above.
//
// Between corners clearances (height less shadow height) are interpolated, and a tile that turns into its parent turns
// its clearances into the parent's as it turns its heights, so neither edges of tiles nor changes of level show.

uniform sampler2DArray planet_shadow_heights_m; // 129 x 129 a tile

// Further above or below a shadow than ground can be: infinities that can be interpolated.
const float kFarFromShadow_m = 1e6;

float corner_clearance_m(int layer, ivec2 corner)
{
    float shadow_m = texelFetch(planet_shadow_heights_m, ivec3(corner, layer), 0).r;
    return clamp(tile_height_m(layer, corner) - shadow_m, -kFarFromShadow_m, kFarFromShadow_m);
}

float clearance_m(int layer, vec2 corner)
{
    ivec2 first = clamp(ivec2(floor(corner)), ivec2(0), ivec2(kTileSquares - 1));
    vec2 t = corner - vec2(first);
    float upper = mix(corner_clearance_m(layer, first),
                      corner_clearance_m(layer, first + ivec2(1, 0)), t.x);
    float lower = mix(corner_clearance_m(layer, first + ivec2(0, 1)),
                      corner_clearance_m(layer, first + ivec2(1, 1)), t.x);
    return mix(upper, lower, t.y);
}

float planet_shadow(PlanetPlace place)
{
    bool own = place.layers.z != 0;
    bool parents = place.layers.w != 0;
    if (!own && !parents)
        return 1.0;
    // What is missing stands back for what is there.
    float turned = own ? (parents ? place.turned : 0.0) : 1.0;
    float own_m = turned < 1.0 ? clearance_m(place.layers.x, place.at) : 0.0;
    float parents_m = turned > 0.0 ? clearance_m(place.layers.y, vec2(place.in_parent) + 0.5 * place.at) : 0.0;
    float clear_m = mix(own_m, parents_m, turned);
    // An edge is as wide as a pixel.
    float soft_m = max(0.7 * fwidth(clear_m), 1e-3);
    return smoothstep(-soft_m, soft_m, clear_m);
}

vec4 planet_shadow_overlay(PlanetPlace place, float lit)
{
    return vec4(0.0);
}
