// Walls under the borders of a terrain in a light's box: light that comes in beside the grid meets the ground's side, not
// its underside. A strip for each border, two corners of the mesh's at a time, one on the ground and one below.

#version 430 core
#include "caster_place.glsl"

uniform mat4 to_clip;
uniform int caster_step; // cells from corner to corner
uniform int border;      // 0 first row, 1 last row, 2 first column, 3 last column
uniform float bottom_m;  // relative to the origin

void main()
{
    int along = gl_VertexID / 2 * caster_step;
    ivec2 last = caster_last_cell();
    ivec2 cell = border < 2 ? ivec2(along, border == 0 ? 0 : last.y) : ivec2(border == 2 ? 0 : last.x, along);
    vec3 place_m = caster_place(cell);
    if ((gl_VertexID & 1) == 1)
        place_m.z = bottom_m;
    gl_Position = to_clip * vec4(place_m, 1.0);
}
