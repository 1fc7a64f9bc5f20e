// The answer of a technique for every cell, in a framebuffer with a pixel per cell: 1 lit, 0 in shadow.

#version 430 core
#include "terrain_lit.glsl"

out float lit;

void main()
{
    lit = is_lit(ivec2(gl_FragCoord.xy)) ? 1.0 : 0.0;
}
