// The mesh that stands for a terrain, in space relative to the eye: patches of 32 x 32 squares, each of 2^level cells a
// side, as view/level_of_detail.h selects them. Every second corner moves onto its neighbour, as far as its distance
// from the eye says, until the patch is one of the next coarser level. F. Strugar, Continuous distance-dependent level
// of detail for rendering heightmaps, 2009.

#version 430 core

layout(location = 0) in vec2 corner; // of the patch, 0 to 32

// Row, column and level of each patch.
layout(std430, binding = 0) readonly buffer Patches
{
    uint patches[];
};

uniform sampler2D mesh_heights_m;
uniform ivec2 last_cell; // column and row
uniform vec2 cell_size_m;
uniform ivec2 eye_cell; // the eye's place in cells: whole ones, and the rest
uniform vec2 eye_in_cell;
uniform float eye_height_m;
uniform mat4 eye_to_clip;
uniform vec2 morph[24]; // of each level: the distance where it begins, and 1 over how far it takes

out vec2 cell; // column and row, fractions too
out vec3 from_eye_m;

// Whole cells are subtracted as integers, so that nothing is rounded however large the terrain is.
vec3 place_from_eye(ivec2 at)
{
    vec2 cells = vec2(at - eye_cell) - eye_in_cell;
    float height_m = texelFetch(mesh_heights_m, at, 0).r - eye_height_m;
    return vec3(cells.x * cell_size_m.x, -cells.y * cell_size_m.y, height_m);
}

void main()
{
    ivec2 first = ivec2(patches[3 * gl_InstanceID + 1], patches[3 * gl_InstanceID]);
    uint level = patches[3 * gl_InstanceID + 2];
    ivec2 corner_of_patch = ivec2(corner);
    ivec2 fine = first + corner_of_patch * (1 << level);
    ivec2 coarse = fine - (corner_of_patch & 1) * (1 << level);
    // The mesh ends at the last row and column, whether or not they are whole patches away.
    fine = min(fine, last_cell);
    coarse = min(coarse, last_cell);

    vec3 fine_m = place_from_eye(fine);
    float turned = clamp((length(fine_m) - morph[level].x) * morph[level].y, 0.0, 1.0);
    from_eye_m = mix(fine_m, place_from_eye(coarse), turned);
    cell = mix(vec2(fine), vec2(coarse), turned);
    gl_Position = eye_to_clip * vec4(from_eye_m, 1.0);
}
