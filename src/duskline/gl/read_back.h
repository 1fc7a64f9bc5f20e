#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/gl/pixel.h>
#include <duskline/gl/texture.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace duskline::gl {

void read_back_texels(const Texture& texture, PixelLayout layout, void* values);

/// The texels of level 0, row 0 first: what `upload` took. T is a number or a std::array of numbers, with as many
/// channels as are wanted. Waits for what is being drawn.
template <typename T>
Grid<T> read_back(const Texture& texture)
{
    Grid<T> values(texture.height(), texture.width());
    read_back_texels(texture, PixelLayoutOf<T>::kLayout, values.data());
    return values;
}

/// A picture of what was drawn into the framebuffer bound for reading (a window, or Framebuffer::bind), the topmost
/// row first: red, green, blue, alpha.
Grid<std::array<std::uint8_t, 4>> read_back_picture(std::size_t width, std::size_t height);

} // namespace duskline::gl
