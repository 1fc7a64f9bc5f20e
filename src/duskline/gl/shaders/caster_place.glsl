// Corners of a terrain's mesh as a shadow map has it: one level of detail all over, relative to some origin.

uniform sampler2D caster_heights_m;
uniform vec2 caster_cell_size_m;
uniform ivec2 caster_origin_cell; // the origin's place in cells: whole ones, and the rest
uniform vec2 caster_origin_in_cell;
uniform float caster_origin_height_m;

ivec2 caster_last_cell()
{
    return textureSize(caster_heights_m, 0) - 1;
}

// Whole cells are subtracted as integers, so that nothing is rounded however large the terrain is.
vec3 caster_place(ivec2 cell)
{
    ivec2 at = min(cell, caster_last_cell()); // where the mesh ends, whether or not they are whole steps away
    vec2 cells = vec2(at - caster_origin_cell) - caster_origin_in_cell;
    float height_m = texelFetch(caster_heights_m, at, 0).r - caster_origin_height_m;
    return vec3(cells.x * caster_cell_size_m.x, -cells.y * caster_cell_size_m.y, height_m);
}
