// Whether any point is in shadow, by the silhouette map (IsShadow of Sakalauskas 2008, section 8) or, to compare it
// with, by looking at every line on the way to the border (section 3).
//
//     #define DUSKLINE_SMAP_LANES 4
//     #include "smap_shadow.glsl"
//     ... is_shadowed_by_smap(vec3(u, v, height_m))
//
// Points are told in the frame of the light: u cells along a line, v lines from the one nearest the light, metres.
// A point is not compared with the line it is on.

#include "smap_lines.glsl"
#include "smap_texels.glsl"

uniform float smap_lateral; // cells along a line per line away from the light
uniform float smap_drop_m;  // fall of the light per line

// (u, v) of a cell of the grid.
vec2 in_light_frame(vec2 cell)
{
    vec2 from_first = cell - vec2(smap_first_texel);
    return vec2(dot(from_first, vec2(smap_cell_step)), dot(from_first, vec2(smap_line_step)));
}

// Where the ray from a point is above line w, is there ground above it?
bool is_shaded_by_line(vec3 point, int w)
{
    float away = point.y - float(w);
    float u = point.x - smap_lateral * away;
    float cell = floor(u);
    float height = between(sample_m(w, int(cell)), sample_m(w, int(cell) + 1), u - cell);
    return height > point.z + smap_drop_m * away;
}

// The beam over a point, on a line or between two.
int beam_over(vec3 point)
{
    if (point.y == floor(point.y)) {
        LineFacts line = facts_of(clamp(int(point.y), 0, smap_line_count - 1));
        return int(floor(point.x - line.part)) + 1 - line.shift;
    }
    return int(floor(point.x - smap_lateral * point.y)) + 1;
}

bool is_shadowed_by_smap(vec3 point)
{
    int v = int(floor(point.y));
    int beam = beam_over(point);
    if (float(v) != point.y && is_shaded_by_line(point, v))
        return true;
    int next = next_of(texel_at(v, beam));
    while (next > 0) {
        if (is_shaded_by_line(point, next - 1))
            return true;
        next = next_of(texel_in(column_of(next - 1, beam), next - 1));
    }
    return false;
}

bool is_shadowed_by_full_scan(vec3 point)
{
    for (int w = int(ceil(point.y)) - 1; w >= 0; --w) {
        float u = point.x - smap_lateral * (point.y - float(w));
        if (u < 0.0 || u > float(smap_cells - 1))
            return false;
        if (is_shaded_by_line(point, w))
            return true;
    }
    return false;
}
