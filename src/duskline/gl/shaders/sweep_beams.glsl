// What the passes of the sweep share: lines of cells in the order of the light, and beams that are carried over them.
// The numbers are those of casting/sweep.cpp and casting/kernels/sweep_lines-inl.h, operation by operation, so that
// the answers are, too: `precise` forbids fused multiply-adds.
//
// DUSKLINE_LIMBS 1: one light. 2: two lights of one azimuth, the upper and the lower edge of the sun's disc. A front then
// has three numbers: its height for the upper edge, that for the lower edge, and the line whose ground made the latter.

#if DUSKLINE_LIMBS == 2
#define FRONT vec3
#define STORED_FRONT vec4
#define EMPTY_FRONT vec3(-1.0e30, -1.0e30, 0.0)
#define FRONT_IMAGE rg32f
#else
#define FRONT float
#define STORED_FRONT float
#define EMPTY_FRONT -1.0e30 // lower than any ground, and finite, because fronts are interpolated
#define FRONT_IMAGE r32f
#endif

layout(binding = 0) uniform sampler2D heights;

// Where beams stand over each line: see kernels::BeamShift.
struct Shift {
    int whole;
    float fraction;
};
layout(std430, binding = 0) readonly buffer Shifts { Shift shifts[]; };

// Fronts that come into each segment of lines, by segment and beam: on the beams of the comb `shifts`, and half a cell
// behind them.
layout(std430, binding = 1) buffer Fronts { STORED_FRONT fronts[]; };

uniform int lines;
uniform int cells;            // of a line
uniform ivec2 first_texel;    // of the line nearest the light
uniform ivec2 line_step;      // texels from line to line, away from the light
uniform ivec2 cell_step;      // texels from cell to cell
uniform int sideways;         // 1 when light moves towards higher cells, else -1
uniform int first_beam;
uniform int beams;
uniform int lines_per_segment; // a multiple of kLinesPerTilt
uniform FRONT drop_m;          // fall of the light per line; 0 for what does not fall

const int kLinesPerTilt = 32;
#define NO_DATA uintBitsToFloat(0x7fc00000u)

float height_m(int line, int cell)
{
    bool inside = cell >= 0 && cell < cells;
    float height = texelFetch(heights, first_texel + line * line_step + clamp(cell, 0, cells - 1) * cell_step, 0).r;
    return inside ? height : NO_DATA;
}

bool has_left(int cell)
{
    return sideways > 0 ? cell >= cells : cell < 0;
}

FRONT tilt_at(int line)
{
    return drop_m * float(line % kLinesPerTilt);
}

bool is_lowered_at(int line)
{
    return line % kLinesPerTilt == 0 && line != 0;
}

FRONT lowered(FRONT front)
{
    precise FRONT result = front - drop_m * float(kLinesPerTilt);
    return result;
}

// The front or `candidate`, ground on this line.
FRONT higher(FRONT front, FRONT candidate)
{
#if DUSKLINE_LIMBS == 2
    float upper = candidate.x > front.x ? candidate.x : front.x;
    return vec3(upper, candidate.y > front.y ? candidate.yz : front.yz);
#else
    return candidate > front ? candidate : front; // false for NaN
#endif
}

// The front of a beam `fraction` of a cell ahead of `ground`. A beam that leaves the grid goes on over the same height,
// and beside no data half a cell around a sample casts.
FRONT raised(FRONT front, float ground, float ahead, bool ahead_has_left, float fraction, int line)
{
    float next = ahead_has_left ? ground : ahead;
    FRONT tilt = tilt_at(line);
    precise float rise = next - ground;
    precise FRONT under_beam = (FRONT(ground) + tilt) + FRONT(rise * fraction);
    if (isnan(rise))
        under_beam = FRONT(fraction < 0.5 ? ground : next) + tilt;
#if DUSKLINE_LIMBS == 2
    return higher(front, vec3(under_beam.xy, float(line)));
#else
    return higher(front, under_beam);
#endif
}

void store_front(int index, FRONT at, FRONT half_behind)
{
#if DUSKLINE_LIMBS == 2
    fronts[2 * index] = vec4(at, 0.0);
    fronts[2 * index + 1] = vec4(half_behind, 0.0);
#else
    fronts[2 * index] = at;
    fronts[2 * index + 1] = half_behind;
#endif
}

FRONT stored_at(int index)
{
    return FRONT(fronts[2 * index]);
}

FRONT stored_half_behind(int index)
{
    return FRONT(fronts[2 * index + 1]);
}

// The three beams that decide cell j of a line: `at` is `fraction` of a cell ahead of it, the others half a cell and a
// cell behind that one.
//
//          j - sideways          j            j + sideways
//                o-------x-------o-------x------o-----x
//                   behind          half_behind       at          (fraction below a half)
struct Beams {
    FRONT at;
    FRONT half_behind;
    FRONT behind;
};

struct Ground {
    float before; // of cell j - sideways
    float here;
    float ahead;
    bool here_has_left;
    bool ahead_has_left;
};

Ground ground_at(int line, int cell)
{
    return Ground(height_m(line, cell - sideways), height_m(line, cell), height_m(line, cell + sideways),
                  has_left(cell), has_left(cell + sideways));
}

FRONT carried_at(FRONT front, Ground ground, float fraction, int line)
{
    return raised(front, ground.here, ground.ahead, ground.ahead_has_left, fraction, line);
}

FRONT carried_half_behind(FRONT front, Ground ground, float fraction, int line)
{
    if (fraction < 0.5)
        return raised(front, ground.before, ground.here, ground.here_has_left, fraction + 0.5, line);
    return raised(front, ground.here, ground.ahead, ground.ahead_has_left, fraction - 0.5, line);
}

FRONT carried_behind(FRONT front, Ground ground, float fraction, int line)
{
    return raised(front, ground.before, ground.here, ground.here_has_left, fraction, line);
}

// Whether the beam, or one of those behind it, is over the grid on one of the lines [first, last).
bool meets_grid(int beam, int first, int last)
{
    int at_first = beam + sideways * shifts[first].whole;
    int at_last = beam + sideways * shifts[last - 1].whole;
    return max(at_first, at_last) >= -1 && min(at_first, at_last) <= cells;
}
