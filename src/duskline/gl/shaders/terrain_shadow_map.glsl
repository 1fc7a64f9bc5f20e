// What a shadow map that follows the viewer says of a place on a terrain (gl/terrain_shadow_map.h).

#include "caster_surface.glsl"
#include "shadow_map.glsl"

uniform bool light_is_below; // the horizon: nothing is lit
uniform int caster_step;     // cells from corner to corner, in the near map and the wide one
uniform int wide_caster_step;

// Over a sample the ground towards the light, as masks have it: up to the first line of the grid that a ray crosses, on
// straight lines from the sample, of which the mesh's triangles have one diagonal only.
//
//     side ---- diagonal
//       |    X /             X the crossing
//       |   / /
//      sample
vec3 ground_towards_light(ivec2 cell)
{
    vec2 towards = -shadow_map.near_box.to_depth.xy / caster_cell_size_m;
    ivec2 diagonal = cell + ivec2(towards.x < 0.0 ? -1 : 1, towards.y < 0.0 ? 1 : -1);
    ivec2 side = abs(towards.x) > abs(towards.y) ? ivec2(diagonal.x, cell.y) : ivec2(cell.x, diagonal.y);
    if (any(lessThan(diagonal, ivec2(0))) || any(greaterThan(diagonal, caster_last_cell())))
        return vec3(0.0); // no ground
    vec3 place_m = caster_place(cell);
    vec3 normal = cross(caster_place(side) - place_m, caster_place(diagonal) - place_m);
    return normal.z < 0.0 ? -normal : normal;
}

float terrain_shadow_map(CasterSurface near, CasterSurface wide)
{
    return light_is_below ? 0.0
                          : shadow_map_factor(near.place_m, near.normal, wide.place_m, wide.normal, length(near.place_m));
}

float terrain_shadow_map(vec2 cell)
{
    return terrain_shadow_map(caster_surface(cell, caster_step), caster_surface(cell, wide_caster_step));
}

// Of a sample.
float terrain_shadow_map(ivec2 cell)
{
    vec3 normal = ground_towards_light(cell);
    return terrain_shadow_map(CasterSurface(caster_surface(vec2(cell), caster_step).place_m, normal),
                              CasterSurface(caster_surface(vec2(cell), wide_caster_step).place_m, normal));
}

vec4 terrain_shadow_map_overlay(vec2 cell, float lit)
{
    vec3 place_m = caster_surface(cell, caster_step).place_m;
    return shadow_map_overlay(place_m, length(place_m), lit);
}
