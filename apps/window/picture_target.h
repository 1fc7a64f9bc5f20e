#pragma once

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/texture.h>
#include <duskline/products/colour.h>

#include <cstddef>

namespace duskline::window {

/// Where pictures without a window are drawn.
class PictureTarget {
public:
    PictureTarget(std::size_t width, std::size_t height);

    /// Everything drawn from now on goes here, over nothing.
    void begin() const;

    /// Copies what was drawn into the window of the same size.
    void show_in_window() const { framebuffer_.copy_to_window(); }

    /// What was drawn. Waits for it.
    Picture picture() const;

    std::size_t width() const { return colour_.width(); }
    std::size_t height() const { return colour_.height(); }

private:
    gl::Texture colour_;
    gl::Texture depth_;
    gl::Framebuffer framebuffer_;
};

} // namespace duskline::window
