// First pass of the silhouette map: which sections are Black, that is, hold a place which is higher, along the light,
// than the lines before and after. Five places are looked at, and what is straight between them.
//
// V. Sakalauskas, Hybrid Terrain Shadow Ray Casting, WSCG 2008, section 5, as casting/smap.h has it.

#version 430 core
#include "smap_lines.glsl"
#include "smap_texels.glsl"

uniform float rise_m; // by how much a section must look higher than its neighbours to be no silhouette
uniform float fall_m;

out TEXEL texel;

// A place this close to a sample is ground where the next one is missing.
const float kBesideSample = 1.2e-6;

// Three samples of a line under a section of another, and where they begin.
struct Samples {
    vec3 height_m;
    float part;
};

Samples samples_of(int w, int v, int x)
{
    bool there = w >= 0 && w < smap_line_count;
    LineFacts facts = facts_of(there ? w : v);
    int u = x - 1 + facts.shift - shift_of(v);
    return Samples(vec3(sample_m(w, u), sample_m(w, u + 1), sample_m(w, u + 2)),
                   facts.part);
}

float height_at(Samples line, float place)
{
    precise float from_first = place + line.part;
    return from_first < 1.0 ? between(line.height_m.x, line.height_m.y, from_first)
                            : between(line.height_m.y, line.height_m.z, from_first - 1.0);
}

// How far a place looks higher than the line before and the line after, towards the light and away from it.
vec2 over_neighbours(Samples before, Samples own, Samples after, float place)
{
    float height = height_at(own, place);
    precise vec2 over = vec2((height - height_at(before, place)) + rise_m, (height - height_at(after, place)) + fall_m);
    return over;
}

// What is not known is not lower.
bool is_low(float over)
{
    return over < 0.0;
}

// Whether the straight piece between a place that looks towards the light and one that looks away turns in between.
bool turns(vec2 towards, vec2 away)
{
    precise float own = towards.x * away.y;
    precise float other = away.x * towards.y;
    bool separate = own < other;
    return !is_low(towards.x) && !is_low(away.y) && !separate;
}

bool is_silhouette(vec2 a, vec2 b)
{
    bool a_is = !is_low(a.x) && !is_low(a.y);
    bool b_is = !is_low(b.x) && !is_low(b.y);
    return a_is || b_is || turns(a, b) || turns(b, a);
}

bool has_ground(Samples own)
{
    return !isnan(own.height_m.y) || (own.part < kBesideSample && !isnan(own.height_m.x));
}

int colour_of(int v, int x)
{
    Samples own = samples_of(v, v, x);
    if (!has_ground(own))
        return 0;
    Samples before = samples_of(v - 1, v, x);
    Samples after = samples_of(v + 1, v, x);
    precise float p0 = 1.0 - before.part;
    precise float p1 = 1.0 - own.part;
    precise float p2 = 1.0 - after.part;
    float places[5] = float[5](0.0, min(min(p0, p1), p2), max(min(p0, p1), min(max(p0, p1), p2)), max(max(p0, p1), p2), 1.0);
    vec2 last = over_neighbours(before, own, after, places[0]);
    bool black = false;
    for (int i = 1; i < 5; ++i) {
        vec2 next = over_neighbours(before, own, after, places[i]);
        black = black || is_silhouette(last, next);
        last = next;
    }
    return black ? 1 : 0;
}

int colour_at(int v, int beam)
{
    return is_section(v, beam) ? colour_of(v, beam + shift_of(v)) : 0;
}

void main()
{
    ivec2 place = place_of_texel(ivec2(gl_FragCoord.xy));
#if DUSKLINE_SMAP_LANES == 4
    texel = ivec4(colour_at(place.y, place.x), colour_at(place.y + 1, place.x), colour_at(place.y + 2, place.x),
                  colour_at(place.y + 3, place.x));
#else
    texel = colour_at(place.y, place.x);
#endif
}
