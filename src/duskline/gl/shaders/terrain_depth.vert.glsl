// The depth of a terrain in a light's box: patches as in terrain.vert.glsl, all of one level, which none turns into
// another.

#version 430 core
#include "caster_place.glsl"

layout(location = 0) in vec2 corner; // of the patch, 0 to 32

// Row, column and level of each patch.
layout(std430, binding = 0) readonly buffer Patches
{
    uint patches[];
};

uniform mat4 to_clip;
uniform int caster_step; // cells from corner to corner

void main()
{
    ivec2 first = ivec2(patches[3 * gl_InstanceID + 1], patches[3 * gl_InstanceID]);
    gl_Position = to_clip * vec4(caster_place(first + ivec2(corner) * caster_step), 1.0);
}
