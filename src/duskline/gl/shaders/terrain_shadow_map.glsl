// What a shadow map that follows the viewer says of a place on a terrain (gl/terrain_shadow_map.h).

#include "caster_surface.glsl"
#include "shadow_map.glsl"

uniform bool light_is_below; // the horizon: nothing is lit
uniform int caster_step;     // cells from corner to corner, in the near map and the wide one
uniform int wide_caster_step;

float terrain_shadow_map(vec2 cell)
{
    if (light_is_below)
        return 0.0;
    CasterSurface near = caster_surface(cell, caster_step);
    CasterSurface wide = caster_surface(cell, wide_caster_step);
    return shadow_map_factor(near.place_m, near.normal, wide.place_m, wide.normal, length(near.place_m));
}

vec4 terrain_shadow_map_overlay(vec2 cell, float lit)
{
    vec3 place_m = caster_surface(cell, caster_step).place_m;
    return shadow_map_overlay(place_m, length(place_m), lit);
}
