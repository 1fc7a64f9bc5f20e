// Last pass of the silhouette map: a NextV that cannot shadow the silhouette behind it is covered by that one, and left
// out. Sakalauskas 2008, section 9.

#version 430 core
#include "smap_lines.glsl"
#include "smap_texels.glsl"
#include "smap_bounds.glsl"

out TEXEL texel;

int past_covered(int own, int beam)
{
    int next = next_of(own);
    if (next == 0)
        return own;
    int column = column_of(next - 1, beam);
    vec4 bounds = bounds_in(column, next - 1);
    for (;;) {
        int after = next_of(texel_in(column, next - 1));
        if (after == 0)
            break;
        column = column_of(after - 1, beam);
        vec4 of_after = bounds_in(column, after - 1);
        if (!cannot_shadow(bounds, of_after))
            break;
        next = after;
        bounds = of_after;
    }
    return with_next(own, next);
}

void main()
{
    ivec2 place = place_of_texel(ivec2(gl_FragCoord.xy));
    TEXEL own = TEXEL(texelFetch(smap_texels, ivec2(gl_FragCoord.xy), 0));
#if DUSKLINE_SMAP_LANES == 4
    for (int lane = 0; lane < 4; ++lane)
        own[lane] = past_covered(own[lane], place.x);
    texel = own;
#else
    texel = past_covered(own, place.x);
#endif
}
