// What the passes of the silhouette map and its look-ups share: the terrain in lines across the light (casting/smap.h
// tells what the map is; its numbers are followed operation by operation).
//
// A *beam* is a band of light one cell wide. Its section of line v is column x = beam + shift of v: beams are numbered so
// that this is all.

#ifndef DUSKLINE_SMAP_HEIGHTS
#define DUSKLINE_SMAP_HEIGHTS 0
#endif
#ifndef DUSKLINE_SMAP_TEXELS
#define DUSKLINE_SMAP_TEXELS 1
#endif
#ifndef DUSKLINE_SMAP_LINES
#define DUSKLINE_SMAP_LINES 2
#endif

layout(binding = DUSKLINE_SMAP_HEIGHTS) uniform sampler2D smap_heights;
layout(binding = DUSKLINE_SMAP_LINES) uniform sampler2D smap_lines; // a texel for each line

struct LineFacts {
    int shift;        // whole cells by which beams have moved
    float part;       // of a cell beyond
    float tilt_m;     // added to its heights, makes light level
    float rounding_m; // by how much tilted heights may be wrong
};

LineFacts facts_of(int v)
{
    vec4 facts = texelFetch(smap_lines, ivec2(v, 0), 0);
    return LineFacts(int(facts.x), facts.y, facts.z, facts.w);
}

int shift_of(int v)
{
    return int(texelFetch(smap_lines, ivec2(v, 0), 0).x);
}

uniform int smap_line_count;
uniform int smap_cells;         // of a line
uniform ivec2 smap_first_texel; // of the line nearest the light
uniform ivec2 smap_line_step;   // texels from line to line, away from the light
uniform ivec2 smap_cell_step;   // texels from cell to cell

// Outside the grid there is nothing.
float sample_m(int v, int u)
{
    bool inside = u >= 0 && u < smap_cells && v >= 0 && v < smap_line_count;
    ivec2 texel = smap_first_texel + clamp(v, 0, smap_line_count - 1) * smap_line_step
                  + clamp(u, 0, smap_cells - 1) * smap_cell_step;
    float height = texelFetch(smap_heights, texel, 0).r;
    return inside ? height : uintBitsToFloat(0x7fc00000u);
}

// `share` of the way from one sample to the next one.
float between(float first, float next, float share)
{
    precise float height = first + (next - first) * share;
    return share == 0.0 ? first : height;
}
