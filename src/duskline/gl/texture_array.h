#pragma once

#include <duskline/gl/texture.h>

#include <cstddef>

namespace duskline::gl {

/// Textures of one size and format in one object, so that one draw may use any of them: sampler2DArray, the third
/// coordinate the layer. Rows and columns as in Texture; nearest filtering, clamped to the edge, values not set.
class TextureArray {
public:
    /// Throws InvalidInput when a side or the number of layers is 0 or more than the context allows.
    TextureArray(TextureFormat format, std::size_t width, std::size_t height, std::size_t layers);

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    std::size_t layers() const { return layers_; }
    unsigned int name() const { return texture_.name(); }

    /// Replaces a layer. Throws InvalidInput for values of another size and a layer that is not there.
    template <typename T>
    void upload(const GridView<T>& values, std::size_t layer)
    {
        upload_rows(values.data(), PixelLayoutOf<std::remove_const_t<T>>::kLayout, values.rows(),
                    values.columns(), values.row_stride(), layer);
    }

    /// For depth32f: sampler2DArrayShadow, which answers whether the reference is at or above what is stored (with reversed
    /// depth: at or before it), mixed from four texels.
    void compare_reversed_depth();

    /// To a texture unit, for samplers of that number.
    void bind(unsigned int unit) const;

private:
    void upload_rows(const void* values, PixelLayout layout, std::size_t rows, std::size_t columns,
                     std::size_t row_stride, std::size_t layer);

    TextureFormat format_;
    std::size_t width_;
    std::size_t height_;
    std::size_t layers_;
    Handle<delete_texture> texture_;
};

/// The most layers a TextureArray may have in the current context: 2048 or more.
std::size_t most_layers();

} // namespace duskline::gl
