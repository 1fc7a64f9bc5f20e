#include <duskline/gl/pixel_transfer.h>
#include <duskline/gl/read_back.h>

#include <algorithm>

namespace duskline::gl {

void read_back_texels(const Texture& texture, PixelLayout layout, void* values)
{
    const BoundForEdit bound(texture);
    const PlainPixels plain(0);
    const auto [format, type] = transfer_format(layout, texture.format());
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT); // after imageStore
    glGetTexImage(GL_TEXTURE_2D, 0, format, type, values);
}

Grid<std::array<std::uint8_t, 4>> read_back_picture(std::size_t width, std::size_t height)
{
    Grid<std::array<std::uint8_t, 4>> picture(height, width);
    const PlainPixels plain(0);
    glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
    glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA, GL_UNSIGNED_BYTE,
                 picture.data());
    for (std::size_t row = 0; row < height / 2; ++row) // OpenGL begins with the lowest
        std::ranges::swap_ranges(picture.row(row), picture.row(height - 1 - row));
    return picture;
}

} // namespace duskline::gl
