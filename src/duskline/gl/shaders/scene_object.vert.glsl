// Things on a terrain and over it, many of one shape, in space relative to the eye.

#version 430 core

layout(location = 0) in vec3 corner; // of the shape: x right, y ahead, z up; as wide as 1, from the ground to 1
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 own_colour;

// As C++ has it: gl/scene_objects.cpp.
struct Placed {
    vec4 place; // column, row, height in metres over the ground (or over 0), 1 on the ground (or 0)
    vec4 size;  // width and height in metres, cosine and sine of the turn, clockwise from above
};
layout(std430, binding = 0) readonly buffer Objects
{
    Placed objects[];
};

uniform sampler2D mesh_heights_m;
uniform vec2 cell_size_m;
uniform ivec2 eye_cell; // the eye's place in cells: whole ones, and the rest
uniform vec2 eye_in_cell;
uniform float eye_height_m;
uniform mat4 eye_to_clip;

out vec3 from_eye_m;
out vec3 direction; // of the surface
out vec3 colour;

vec3 turned(vec3 v, vec2 turn)
{
    return vec3(turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x, v.z);
}

void main()
{
    Placed object = objects[gl_InstanceID];
    vec2 whole = floor(object.place.xy);
    float height_m = object.place.z - eye_height_m;
    if (object.place.w > 0.5) // wherever the ground is now
        height_m += texelFetch(mesh_heights_m, ivec2(whole), 0).r;
    vec2 cells = vec2(ivec2(whole) - eye_cell) + (object.place.xy - whole - eye_in_cell);
    vec3 scale = vec3(object.size.xx, object.size.y);
    from_eye_m = vec3(cells.x * cell_size_m.x, -cells.y * cell_size_m.y, height_m)
                 + turned(corner * scale, object.size.zw);
    direction = turned(normal / scale, object.size.zw);
    colour = own_colour;
    gl_Position = eye_to_clip * vec4(from_eye_m, 1.0);
}
