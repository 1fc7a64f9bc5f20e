// A separable filter of a shadow map: mean and mean square of depth over 5 texels of a line; rows of the depth map first,
// then columns of what that has left. Depth counts from the middle of the box, where floats are finest.
//
// DUSKLINE_ROWS   1 for the first pass, 0 for the second

#version 430 core

uniform sampler2D source;

out vec2 moments;

vec2 moments_at(ivec2 texel)
{
    vec2 value = texelFetch(source, clamp(texel, ivec2(0), textureSize(source, 0) - 1), 0).rg;
#if DUSKLINE_ROWS
    float depth = value.r - 0.5;
    return vec2(depth, depth * depth);
#else
    return value;
#endif
}

void main()
{
    const ivec2 step = ivec2(DUSKLINE_ROWS, 1 - DUSKLINE_ROWS);
    moments = vec2(0.0);
    for (int i = -2; i <= 2; ++i)
        moments += moments_at(ivec2(gl_FragCoord.xy) + i * step) / 5.0;
}
