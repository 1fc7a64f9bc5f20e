// What a shadow map that follows the viewer says of a place on a terrain (gl/terrain_shadow_map.h). The place is put on
// the triangle of the casters' mesh that it lies over, so that both are one surface and ground does not shade itself
// however coarse the mesh is.
//
//        low ---- east     the mesh's triangles; rows grow southwards
//         |  \     |
//         |    \   |
//       south ---- high

#include "caster_place.glsl"
#include "shadow_map.glsl"

uniform bool light_is_below; // the horizon: nothing is lit
uniform int caster_step;     // cells from corner to corner, in the near map and the wide one
uniform int wide_caster_step;

// From the eye.
struct CasterSurface {
    vec3 place_m;
    vec3 normal;
};

CasterSurface caster_surface(vec2 cell, int step)
{
    ivec2 last = caster_last_cell();
    vec2 within = clamp(cell, vec2(0.0), vec2(last));
    ivec2 low = min(ivec2(within), max(last - 1, 0)) / step * step;
    ivec2 high = min(low + step, last);
    vec2 rest = (within - vec2(low)) / vec2(max(high - low, ivec2(1)));
    bool south = rest.y > rest.x;
    vec3 first = caster_place(low);
    vec3 corner = caster_place(south ? ivec2(low.x, high.y) : ivec2(high.x, low.y));
    vec3 eastwards = south ? caster_place(high) - corner : corner - first;
    vec3 southwards = south ? corner - first : caster_place(high) - corner;
    return CasterSurface(first + rest.x * eastwards + rest.y * southwards, cross(southwards, eastwards));
}

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
