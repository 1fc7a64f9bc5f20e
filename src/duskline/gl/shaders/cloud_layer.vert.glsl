// A level rectangle over the whole terrain, in space relative to the eye. Its four corners come from their numbers.

#version 430 core

uniform vec2 last_cell; // column and row
uniform vec2 cell_size_m;
uniform ivec2 eye_cell; // the eye's place in cells: whole ones, and the rest
uniform vec2 eye_in_cell;
uniform float eye_height_m;
uniform float layer_m; // how high the layer is
uniform mat4 eye_to_clip;

out vec3 from_eye_m;
out vec2 cell;

void main()
{
    cell = vec2(gl_VertexID & 1, gl_VertexID >> 1) * last_cell;
    vec2 cells = cell - vec2(eye_cell) - eye_in_cell;
    from_eye_m = vec3(cells.x * cell_size_m.x, -cells.y * cell_size_m.y, layer_m - eye_height_m);
    gl_Position = eye_to_clip * vec4(from_eye_m, 1.0);
}
