#pragma once

#include <cstddef>

namespace duskline::gl {

/// How many objects of each kind the current context has: for those who look for leaks.
struct LiveObjects {
    std::size_t textures = 0;
    std::size_t buffers = 0;
    std::size_t framebuffers = 0;
    std::size_t vertex_arrays = 0;
    std::size_t programs = 0; ///< and shaders
    std::size_t queries = 0;

    bool operator==(const LiveObjects&) const = default;
};

/// Counts names from 1 to 10 000, beyond which those of leaks only come, as drivers hand out low names again. Names that
/// were never bound are no objects yet. Cost: a call of the driver for each name and kind.
LiveObjects live_objects();

} // namespace duskline::gl
