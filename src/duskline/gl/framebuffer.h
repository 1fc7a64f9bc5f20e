#pragma once

#include <duskline/gl/handle.h>
#include <duskline/gl/texture.h>
#include <duskline/gl/texture_array.h>

#include <array>
#include <cstddef>
#include <vector>

namespace duskline::gl {

void delete_framebuffer(unsigned int name);

/// What is drawn into: textures for colour outputs 0, 1, ... and at most one for depth, all of one size. They must
/// outlive it.
class Framebuffer {
public:
    /// Throws InvalidInput for textures of different sizes or none at all, UnsupportedOnThisMachine for a combination
    /// that the driver refuses.
    explicit Framebuffer(const std::vector<const Texture*>& colours, const Texture* depth = nullptr);

    /// Depth alone, in a layer of an array.
    Framebuffer(const TextureArray& depth, std::size_t layer);

    /// Everything drawn from now on goes here, to all of it (the viewport is its size).
    void bind() const;

    /// Fills colour outputs with `colour` and depth with the furthest. Leaves what is bound as it was.
    void clear(const std::array<float, 4>& colour = {0.0f, 0.0f, 0.0f, 0.0f}) const;

    /// Copies colour output 0 to the window, which must be as large. The window is bound afterwards.
    void copy_to_window() const;

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    unsigned int name() const { return framebuffer_.name(); }

private:
    std::size_t width_ = 0;
    std::size_t height_ = 0;
    std::size_t colours_ = 0;
    bool has_depth_ = false;
    Handle<delete_framebuffer> framebuffer_;
};

/// Everything drawn from now on goes to the window, whose size in pixels is given.
void bind_window(std::size_t width, std::size_t height);

/// Fills the window with black and depth with the furthest. It must be bound.
void clear_window();

} // namespace duskline::gl
