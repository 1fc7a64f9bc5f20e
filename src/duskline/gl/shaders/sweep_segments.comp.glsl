// First pass of the sweep (sweep_answers.comp.glsl): for each segment of lines and each beam, the highest ground on
// those lines alone, as a front that begins empty.

#version 430 core
layout(local_size_x = 64) in;
#include "sweep_beams.glsl"

void main()
{
    int slot = int(gl_GlobalInvocationID.x);
    if (slot >= beams)
        return;
    int beam = first_beam + slot;
    int segment = int(gl_GlobalInvocationID.y);
    int first = segment * lines_per_segment;
    int last = min(first + lines_per_segment, lines);
    FRONT at = EMPTY_FRONT;
    FRONT half_behind = EMPTY_FRONT;
    if (meets_grid(beam, first, last))
        for (int line = first; line < last; ++line) {
            if (is_lowered_at(line)) {
                at = lowered(at);
                half_behind = lowered(half_behind);
            }
            float fraction = shifts[line].fraction;
            Ground ground = ground_at(line, beam + sideways * shifts[line].whole);
            at = carried_at(at, ground, fraction, line);
            half_behind = carried_half_behind(half_behind, ground, fraction, line);
        }
    // Where the next segment begins.
    store_front((segment + 1) * beams + slot, at, half_behind);
}
