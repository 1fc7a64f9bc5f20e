// The surface as what stands in a light's way: depth alone, by a matrix from places relative to the eye. The mesh is
// the one the eye sees, so that nothing shades itself for being drawn in two ways. It has no seams: under light along the
// ground their upright faces are before what lies beyond them in the same texel, and would draw dark lines.

#version 430 core
#include "planet_surface.glsl"

layout(location = 0) in vec3 corner; // column and row, 0 to 128; 1 for the lower border of a seam

uniform mat4 to_clip;

void main()
{
    PlanetTile tile = tiles[first_tile + gl_InstanceID];
    gl_Position = to_clip * vec4(planet_corner(tile, ivec2(corner.xy)).from_eye_m, 1.0);
}
