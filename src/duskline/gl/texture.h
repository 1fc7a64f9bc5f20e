#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/gl/handle.h>
#include <duskline/gl/pixel.h>

#include <cstddef>

namespace duskline::gl {

/// What a texel holds. Integers are read by isampler2D and usampler2D.
enum class TextureFormat {
    r8,
    rgba8,
    srgb8_alpha8,
    r32f,
    rg32f,
    rgba32f,
    r32i,
    rg32i,
    rgba32i,
    r32ui,
    depth32f
};

void delete_texture(unsigned int name);

/// A two-dimensional texture of a fixed size. Texel (x, y) is column x and row y of the grid it is filled from: row 0
/// is north, so y runs southwards. Samples lie in the middle of texels, as heights do in the middle of cells.
///
/// Begins with nearest filtering, clamped to its edge, its values not set.
class Texture {
public:
    /// Throws InvalidInput when a side is 0 or more than the context allows, or for more levels than fit.
    Texture(TextureFormat format, std::size_t width, std::size_t height, std::size_t levels = 1);

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    std::size_t levels() const { return levels_; }
    TextureFormat format() const { return format_; }
    unsigned int name() const { return texture_.name(); }

    /// Replaces the texels from column `first_column` and row `first_row` on, on level 0. T is a number or a
    /// std::array of numbers; OpenGL converts between bytes and floats. Throws InvalidInput when the values reach out
    /// of the texture.
    template <typename T>
    void upload(const GridView<T>& values, std::size_t first_row = 0, std::size_t first_column = 0)
    {
        upload_rows(values.data(), PixelLayoutOf<std::remove_const_t<T>>::kLayout, values.rows(),
                    values.columns(), values.row_stride(), first_row, first_column);
    }
    template <typename T>
    void upload(const Grid<T>& values)
    {
        upload(values.view());
    }

    enum class Filter { nearest, linear, trilinear };
    void set_filter(Filter filter);

    /// What lies outside: the nearest texel, the texture again, or `border` in all channels.
    enum class Outside { edge, repeat, border };
    void set_outside(Outside outside, float border = 0.0f);

    /// For depth32f: sampler2DShadow, which answers whether the reference is at or before what is stored.
    void compare_depth();

    /// Fills the levels above 0 with averages of the one below.
    void make_mipmaps();

    /// To a texture unit, for samplers of that number.
    void bind(unsigned int unit) const;

    /// To an image unit, level 0, for imageLoad and imageStore. Not for srgb8_alpha8 and depth32f.
    enum class Access { read, write, read_write };
    void bind_image(unsigned int unit, Access access) const;

private:
    void upload_rows(const void* values, PixelLayout layout, std::size_t rows, std::size_t columns,
                     std::size_t row_stride, std::size_t first_row, std::size_t first_column);

    TextureFormat format_;
    std::size_t width_;
    std::size_t height_;
    std::size_t levels_;
    Handle<delete_texture> texture_;
};

} // namespace duskline::gl
