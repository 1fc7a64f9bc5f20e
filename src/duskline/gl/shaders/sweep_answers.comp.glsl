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
uniform FRONT lowest_m;    // plus infinity where the light is under the horizon
uniform FRONT highest_m;   // minus infinity where it is straight overhead

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

void answer(int line, int cell, FRONT front, FRONT tilt, float ground)
{
    vec4 height = vec4(NO_DATA);
    if (!isnan(ground)) {
#if DUSKLINE_LIMBS == 2
        height.x = shadow_height(front.x, tilt.x, lowest_m.x, highest_m.x);
        height.y = shadow_height(front.y, tilt.y, lowest_m.y, highest_m.y);
#else
        height.x = shadow_height(front, tilt, lowest_m, highest_m);
#endif
    }
    imageStore(shadow_heights, first_texel + line * line_step + cell * cell_step, height);
}

Beams incoming(int segment, int slot)
{
    int slot_behind = slot - sideways;
    bool there = slot_behind >= 0 && slot_behind < beams;
    FRONT_PAIR own = fronts[segment * beams + slot];
    FRONT behind = there ? at_beam(fronts[segment * beams + slot_behind]) : kNoShadow_m;
    return Beams(at_beam(own), half_behind(own), behind);
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
        FRONT tilt = tilt_at(line);
        float fraction = shifts[line].fraction;
        int cell = beam + sideways * shifts[line].whole;
        Ground ground = ground_at(line, cell);
        if (cell >= 0 && cell < cells)
            answer(line, cell, front_over_cell(front, fraction), tilt, ground.here);
        front = Beams(carried_at(front.at, ground, fraction, tilt),
                      carried_half_behind(front.half_behind, ground, fraction, tilt),
                      carried_behind(front.behind, ground, fraction, tilt));
    }
}
