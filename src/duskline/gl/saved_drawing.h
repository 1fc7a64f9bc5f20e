#pragma once

#include <array>
#include <cstddef>

namespace duskline::gl {

/// What is drawn around a pass is afterwards what it was before: framebuffers, viewport, program and the tests that may
/// keep fragments from being written as they are, which are off meanwhile.
class SavedDrawing {
public:
    SavedDrawing();
    SavedDrawing(const SavedDrawing&) = delete;
    SavedDrawing& operator=(const SavedDrawing&) = delete;
    ~SavedDrawing();

private:
    static constexpr std::size_t kTests = 7;

    int program_ = 0;
    int draw_framebuffer_ = 0;
    int read_framebuffer_ = 0;
    std::array<int, 4> viewport_{};
    std::array<bool, kTests> tests_{};
};

} // namespace duskline::gl
