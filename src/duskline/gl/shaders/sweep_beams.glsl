// What the passes of the sweep share: lines of cells in the order of the light, and beams that are carried over them.
// The numbers are those of casting/sweep.cpp and casting/kernels/sweep_lines-inl.h, operation by operation, so that
// the answers are, too: `precise` forbids fused multiply-adds.
//
// DUSKLINE_LIMBS 1: one light. 2: two lights of one azimuth, the upper and the lower edge of the sun's disc, in the two
// components of every height of shadow.

#if DUSKLINE_LIMBS == 2
#define FRONT vec2
#define FRONT_IMAGE rg32f
#else
#define FRONT float
#define FRONT_IMAGE r32f
#endif

layout(binding = 0) uniform sampler2D heights;

// Where beams stand over each line: see kernels::BeamShift.
struct Shift {
    int whole;
    float fraction;
};
layout(std430, binding = 0) readonly buffer Shifts { Shift shifts[]; };

// Heights of the front that comes into each segment of lines, by segment and beam: x or xy on the beams of the comb
// `shifts`, y or zw half a cell behind them.
#if DUSKLINE_LIMBS == 2
#define FRONT_PAIR vec4
FRONT at_beam(vec4 pair) { return pair.xy; }
FRONT half_behind(vec4 pair) { return pair.zw; }
#else
#define FRONT_PAIR vec2
FRONT at_beam(vec2 pair) { return pair.x; }
FRONT half_behind(vec2 pair) { return pair.y; }
#endif
layout(std430, binding = 1) buffer Fronts { FRONT_PAIR fronts[]; };

uniform int lines;
uniform int cells;            // of a line
uniform ivec2 first_texel;    // of the line nearest the light
uniform ivec2 line_step;      // texels from line to line, away from the light
uniform ivec2 cell_step;      // texels from cell to cell
uniform int sideways;         // 1 when light moves towards higher cells, else -1
uniform int first_beam;
uniform int beams;
uniform int lines_per_segment; // a multiple of kLinesPerTilt
uniform FRONT drop_m;          // fall of the light per line

const int kLinesPerTilt = 32;
const FRONT kNoShadow_m = FRONT(-1.0e30);
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

// The front of a beam `fraction` of a cell ahead of `ground`. A beam that leaves the grid goes on over the same height,
// and beside no data half a cell around a sample casts.
FRONT raised(FRONT front, float ground, float ahead, bool ahead_has_left, float fraction, FRONT tilt)
{
    float next = ahead_has_left ? ground : ahead;
    precise float rise = next - ground;
    precise FRONT under_beam = (FRONT(ground) + tilt) + FRONT(rise * fraction);
    if (isnan(rise))
        under_beam = FRONT(fraction < 0.5 ? ground : next) + tilt;
#if DUSKLINE_LIMBS == 2
    return mix(front, under_beam, greaterThan(under_beam, front)); // false for NaN
#else
    return under_beam > front ? under_beam : front;
#endif
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

FRONT carried_at(FRONT front, Ground ground, float fraction, FRONT tilt)
{
    return raised(front, ground.here, ground.ahead, ground.ahead_has_left, fraction, tilt);
}

FRONT carried_half_behind(FRONT front, Ground ground, float fraction, FRONT tilt)
{
    if (fraction < 0.5)
        return raised(front, ground.before, ground.here, ground.here_has_left, fraction + 0.5, tilt);
    return raised(front, ground.here, ground.ahead, ground.ahead_has_left, fraction - 0.5, tilt);
}

FRONT carried_behind(FRONT front, Ground ground, float fraction, FRONT tilt)
{
    return raised(front, ground.before, ground.here, ground.here_has_left, fraction, tilt);
}

// Whether the beam, or one of those behind it, is over the grid on one of the lines [first, last).
bool meets_grid(int beam, int first, int last)
{
    int at_first = beam + sideways * shifts[first].whole;
    int at_last = beam + sideways * shifts[last - 1].whole;
    return max(at_first, at_last) >= -1 && min(at_first, at_last) <= cells;
}
