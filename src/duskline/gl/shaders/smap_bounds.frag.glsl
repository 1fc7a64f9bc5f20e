// A pass of the silhouette map: what the ground of each section is bounded by at its two ends, as the light sees it, so
// that it can be told what cannot shadow it (casting/smap.h). Texels lie as those of the map do, but one for each line.

#version 430 core
#include "smap_lines.glsl"
#include "smap_texels.glsl"

out vec4 bounds; // x, y: no higher, at the first end and the last; z, w: no lower

void main()
{
    int v = int(gl_FragCoord.y);
    LineFacts line = facts_of(v);
    int u = int(gl_FragCoord.x) - smap_margin - shift_of(v - v % DUSKLINE_SMAP_LANES) + line.shift - 1;
    float s0 = sample_m(v, u);
    float s1 = sample_m(v, u + 1);
    float s2 = sample_m(v, u + 2);
    precise float first = between(s0, s1, line.part);
    precise float last = between(s1, s2, line.part);
    precise float chord = first + (last - first) * (1.0 - line.part);
    precise float bulge = s1 - chord;
    precise float up = (bulge > 0.0 ? bulge : 0.0) + line.rounding_m;
    precise float down = (bulge < 0.0 ? -bulge : 0.0) + line.rounding_m;
    precise vec2 tilted = vec2(first + line.tilt_m, last + line.tilt_m);
    bounds = vec4(tilted + up, tilted - down);
}
