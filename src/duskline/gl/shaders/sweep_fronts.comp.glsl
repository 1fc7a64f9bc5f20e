// Second pass of the sweep (sweep_answers.comp.glsl): the front that comes into each segment of lines, from what the
// segments before it add. One beam after another of what is a short list.

#version 430 core
layout(local_size_x = 64) in;
#include "sweep_beams.glsl"

void main()
{
    int slot = int(gl_GlobalInvocationID.x);
    if (slot >= beams)
        return;
    FRONT at = kNoShadow_m;
    FRONT half_back = kNoShadow_m;
    int segments = (lines + lines_per_segment - 1) / lines_per_segment;
    fronts[slot] = FRONT_PAIR(at, half_back);
    for (int segment = 1; segment < segments; ++segment) {
        for (int line = (segment - 1) * lines_per_segment; line < segment * lines_per_segment; line += kLinesPerTilt)
            if (is_lowered_at(line)) {
                at = lowered(at);
                half_back = lowered(half_back);
            }
        FRONT_PAIR added = fronts[segment * beams + slot];
        at = max(at, at_beam(added));
        half_back = max(half_back, half_behind(added));
        fronts[segment * beams + slot] = FRONT_PAIR(at, half_back);
    }
}
