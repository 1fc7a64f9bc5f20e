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
    FRONT at = EMPTY_FRONT;
    FRONT half_behind = EMPTY_FRONT;
    int segments = (lines + lines_per_segment - 1) / lines_per_segment;
    store_front(slot, at, half_behind);
    for (int segment = 1; segment < segments; ++segment) {
        for (int line = (segment - 1) * lines_per_segment; line < segment * lines_per_segment; line += kLinesPerTilt)
            if (is_lowered_at(line)) {
                at = lowered(at);
                half_behind = lowered(half_behind);
            }
        int index = segment * beams + slot;
        at = higher(at, stored_at(index));
        half_behind = higher(half_behind, stored_half_behind(index));
        store_front(index, at, half_behind);
    }
}
