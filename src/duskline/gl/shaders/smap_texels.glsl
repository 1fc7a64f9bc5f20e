// Texels of a silhouette map: bit 0 says Black, the others NextV + 1, 0 for none.
//
// DUSKLINE_SMAP_LANES 1: one section a texel, column x and row v.
// DUSKLINE_SMAP_LANES 4: four lines of one beam a texel, so that a pass works on four at a time and has a quarter of the
// texels. The column is that of the first of the four; `smap_margin` more are there for beams which enter on the others.

#if DUSKLINE_SMAP_LANES == 4
#define TEXEL ivec4
#else
#define TEXEL int
#endif

layout(binding = DUSKLINE_SMAP_TEXELS) uniform isampler2D smap_texels;
uniform int smap_margin;

// The beam of a texel, and the first of its lines.
ivec2 place_of_texel(ivec2 texel)
{
    int first_line = texel.y * DUSKLINE_SMAP_LANES;
    return ivec2(texel.x - smap_margin - shift_of(first_line), first_line);
}

bool is_section(int v, int beam)
{
    if (v < 0 || v >= smap_line_count)
        return false;
    int x = beam + shift_of(v);
    return x >= 0 && x <= smap_cells;
}

// Where the section of a beam lies, and where its bounds do; it must be one.
int column_of(int v, int beam)
{
    return beam + shift_of(v - v % DUSKLINE_SMAP_LANES) + smap_margin;
}

int texel_in(int column, int v)
{
#if DUSKLINE_SMAP_LANES == 4
    return texelFetch(smap_texels, ivec2(column, v / 4), 0)[v % 4];
#else
    return texelFetch(smap_texels, ivec2(column, v), 0).r;
#endif
}

// 0, White without NextV, where there is no such section.
int texel_at(int v, int beam)
{
    return is_section(v, beam) ? texel_in(column_of(v, beam), v) : 0;
}

bool is_black(int texel)
{
    return (texel & 1) != 0;
}

// NextV + 1
int next_of(int texel)
{
    return texel >> 1;
}

int with_next(int texel, int next)
{
    return (texel & 1) | (next << 1);
}
