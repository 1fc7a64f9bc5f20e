// Shadow heights by the sweep (casting/sweep.cpp), on the graphics card: a front of beams is carried over the lines of
// the grid, away from the light, and each cell asks how high the shadow stands over it.
//
// On a beam this is a running maximum, which is found in three passes that all work on many lines at a time:
//
//      lines        | segment 0 | segment 1 | segment 2 | ...
//      segments     |  highest  |  highest  |  highest  |        of each segment alone
//      fronts       |  none     |  0        |  0, 1     |        what comes into each segment
//      answers      |  cell by cell, from what comes in |
//
// All numbers are compared and rounded as in one go from line 0 (rounding keeps the order of heights, so a maximum may
// be taken before or after): the bits of the CPU's sweep, whatever the segments.
//
// Work: every cell twice. The longest chain: lines per segment + segments.

#version 430 core
layout(local_size_x = 64) in;
#include "sweep_beams.glsl"

layout(FRONT_IMAGE, binding = 0) writeonly uniform image2D shadow_heights;

uniform bool halfway;      // whether beams stand between cells at all
uniform vec2 lowest_m;     // plus infinity where the light is under the horizon
uniform vec2 highest_m;    // minus infinity where it is straight overhead

const float kRaised_m = -1.0e20; // a front below this is one that no ground has raised yet

// Between the two beams on either side of the cell.
FRONT front_over_cell(Beams beams, float fraction)
{
    if (!halfway)
        return beams.at;
    bool before_half = fraction < 0.5;
    FRONT nearer = before_half ? beams.at : beams.half_behind;
    FRONT other = before_half ? beams.half_behind : beams.behind;
    float share = 2.0 * (before_half ? fraction : fraction - 0.5);
    precise FRONT front = nearer + (other - nearer) * share;
    return front;
}

float shadow_height(float front, float tilt, float lowest, float highest)
{
    float none = uintBitsToFloat(0xff800000u); // minus infinity
    precise float height = front - tilt;
    return min(max(front > kRaised_m ? height : none, lowest), highest);
}

#if DUSKLINE_LIMBS == 2
// Where the ground sees some of the disc, the first height is that of the ground that hides the disc's lower edge: the
// penumbra is as wide as that ground is far. (The front of the upper edge may be of ground much nearer.)
vec4 shadow_height_texel(FRONT front, FRONT tilt, float ground, int line)
{
    float upper = shadow_height(front.x, tilt.x, lowest_m.x, highest_m.x);
    float lower = shadow_height(front.y, tilt.y, lowest_m.y, highest_m.y);
    float same_ground = lower - (float(line) - front.z) * (drop_m.x - drop_m.y);
    return vec4(upper > ground ? upper : min(upper, same_ground), lower, 0.0, 1.0);
}
#else
vec4 shadow_height_texel(FRONT front, FRONT tilt, float ground, int line)
{
    return vec4(shadow_height(front, tilt, lowest_m.x, highest_m.x), 0.0, 0.0, 1.0);
}
#endif

void answer(int line, int cell, FRONT front, float ground)
{
    vec4 texel = isnan(ground) ? vec4(NO_DATA) : shadow_height_texel(front, tilt_at(line), ground, line);
    imageStore(shadow_heights, first_texel + line * line_step + cell * cell_step, texel);
}

Beams incoming(int segment, int slot)
{
    int slot_behind = slot - sideways;
    bool there = slot_behind >= 0 && slot_behind < beams;
    int index = segment * beams + slot;
    FRONT behind = there ? stored_at(segment * beams + slot_behind) : EMPTY_FRONT;
    return Beams(stored_at(index), stored_half_behind(index), behind);
}

void main()
{
    int segment = int(gl_GlobalInvocationID.y);
    int first = segment * lines_per_segment;
    int last = min(first + lines_per_segment, lines);
    // The beams that meet a cell of the segment, counted from the lowest.
    int moved = sideways > 0 ? -shifts[last - 1].whole : shifts[first].whole;
    int beam = int(gl_GlobalInvocationID.x) + moved;
    int slot = beam - first_beam;
    if (slot >= beams || int(gl_GlobalInvocationID.x) >= cells + shifts[last - 1].whole - shifts[first].whole)
        return;

    Beams front = incoming(segment, slot);
    for (int line = first; line < last; ++line) {
        if (is_lowered_at(line))
            front = Beams(lowered(front.at), lowered(front.half_behind), lowered(front.behind));
        float fraction = shifts[line].fraction;
        int cell = beam + sideways * shifts[line].whole;
        Ground ground = ground_at(line, cell);
        if (cell >= 0 && cell < cells)
            answer(line, cell, front_over_cell(front, fraction), ground.here);
        front = Beams(carried_at(front.at, ground, fraction, line),
                      carried_half_behind(front.half_behind, ground, fraction, line),
                      carried_behind(front.behind, ground, fraction, line));
    }
}
