#pragma once

#include <duskline/geometry/grid.h>

#include <cstdint>
#include <span>
#include <string>

namespace duskline {

/// How an animation runs.
struct AnimationOptions {
    double seconds_a_frame = 0.15; ///< above 0, at most 60
    float quality = 80.0f;         ///< of WebP's lossy compression, 0 to 100
    bool overwrite = false;
};

/// Grey frames of one size as an animated WebP that runs for ever. The file appears whole or not at all. Throws
/// InvalidInput for no frames, frames of different sizes or of more than 16383 pixels a side, and options out of range;
/// OutputError when the file cannot be written, or exists and may not be replaced.
void write_animation(const std::string& path, std::span<const Grid<std::uint8_t>> frames,
                     const AnimationOptions& options = {});

} // namespace duskline
