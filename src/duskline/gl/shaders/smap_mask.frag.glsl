// The answer for every cell: 1 in the light, 0 in the shadow; no data counts as light.
//
// DUSKLINE_FULL_SCAN 0: by the silhouette map. 1: by every line.

#version 430 core
#include "smap_shadow.glsl"

out float lit;

void main()
{
    ivec2 cell = ivec2(gl_FragCoord.xy);
    vec3 point = vec3(in_light_frame(vec2(cell)), texelFetch(smap_heights, cell, 0).r);
    if (isnan(point.z))
        lit = 1.0;
    else
#if DUSKLINE_FULL_SCAN == 1
        lit = is_shadowed_by_full_scan(point) ? 0.0 : 1.0;
#else
        lit = is_shadowed_by_smap(point) ? 0.0 : 1.0;
#endif
}
