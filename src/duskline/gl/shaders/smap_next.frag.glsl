// A pass of the search for NextV, the next silhouette towards the light. Blocks of `distance` lines, whose sections know
// of those within their block, are merged into blocks of `blocks` times as many:
//
//      |  A  |  B  |     each section of B that knows of none looks at the last line of A: it is a silhouette itself,
//           ^   |        or knows the next one
//           '---'
//
// Sakalauskas 2008, section 6 (binary and quad search) and section 9: silhouettes that cannot shadow a section are left
// out, and with DUSKLINE_SMAP_LANES 4 four lines are worked on at a time.

#version 430 core
#include "smap_lines.glsl"
#include "smap_texels.glsl"
#include "smap_bounds.glsl"

uniform int distance_lines; // 1, 2, 4, ... or 1, 4, 16, ...
uniform int blocks;         // 2 or 4
uniform bool better;        // leave out silhouettes that cannot shadow the section

out TEXEL texel;

// What the section in `column` of line v learns from line w, or what that knows.
int learned(int column, int v, int w, int beam, int looked_up)
{
    int next = is_black(looked_up) ? w + 1 : next_of(looked_up);
    if (next == 0 || !better)
        return next;
    vec4 own = bounds_in(column, v);
    while (next > 0) {
        int of_next = column_of(next - 1, beam);
        if (!cannot_shadow(bounds_in(of_next, next - 1), own))
            break;
        next = next_of(texel_in(of_next, next - 1));
    }
    return next;
}

#if DUSKLINE_SMAP_LANES == 4
void main()
{
    ivec2 texel_place = ivec2(gl_FragCoord.xy);
    ivec2 place = place_of_texel(texel_place);
    int beam = place.x;
    ivec4 own = texelFetch(smap_texels, texel_place, 0);
    ivec4 next = own >> 1;
    if (distance_lines == 1) { // all within this texel
        for (int lane = 1; lane < 4; ++lane)
            for (int w = lane - 1; w >= 0 && next[lane] == 0; --w)
                if (is_section(place.y + lane, beam))
                    next[lane] = learned(texel_place.x, place.y + lane, place.y + w, beam, own[w]);
    } else {
        int block = place.y - place.y % distance_lines;
        int before = place.y / distance_lines % 4;
        for (int k = 0; k < before; ++k) {
            int w = block - 1 - k * distance_lines;
            int looked_up = texel_at(w, beam); // the same for all four
            for (int lane = 0; lane < 4; ++lane)
                if (next[lane] == 0 && is_section(place.y + lane, beam))
                    next[lane] = learned(texel_place.x, place.y + lane, w, beam, looked_up);
        }
    }
    texel = (own & 1) | (next << 1);
}
#else
void main()
{
    ivec2 texel_place = ivec2(gl_FragCoord.xy);
    int beam = place_of_texel(texel_place).x;
    int v = texel_place.y;
    int own = texel_in(texel_place.x, v);
    int next = next_of(own);
    int block = v - v % distance_lines;
    int before = v / distance_lines % blocks;
    for (int k = 0; k < before && next == 0; ++k) {
        int w = block - 1 - k * distance_lines;
        next = learned(texel_place.x, v, w, beam, texel_at(w, beam));
    }
    texel = with_next(own, next);
}
#endif
