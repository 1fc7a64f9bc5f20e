#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/pixel_transfer.h>
#include <duskline/gl/texture_array.h>

#include <string>

namespace duskline::gl {

namespace {

class ArrayBoundForEdit {
public:
    explicit ArrayBoundForEdit(unsigned int name)
    {
        glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &before_);
        glBindTexture(GL_TEXTURE_2D_ARRAY, name);
    }
    ArrayBoundForEdit(const ArrayBoundForEdit&) = delete;
    ArrayBoundForEdit& operator=(const ArrayBoundForEdit&) = delete;
    ~ArrayBoundForEdit() { glBindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(before_)); }

private:
    GLint before_ = 0;
};

Handle<delete_texture> new_texture()
{
    GLuint name = 0;
    glGenTextures(1, &name);
    return Handle<delete_texture>(name);
}

std::size_t limit(GLenum name)
{
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<std::size_t>(value);
}

std::string size_text(std::size_t width, std::size_t height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

void require_possible(std::size_t width, std::size_t height, std::size_t layers)
{
    const std::size_t most = limit(GL_MAX_TEXTURE_SIZE);
    if (width == 0 || height == 0 || width > most || height > most)
        throw InvalidInput("a texture must have 1 to " + std::to_string(most)
                           + " texels a side on this machine, got " + size_text(width, height));
    if (layers == 0 || layers > most_layers())
        throw InvalidInput("a texture array must have 1 to " + std::to_string(most_layers())
                           + " layers on this machine, got " + std::to_string(layers));
}

} // namespace

std::size_t most_layers()
{
    return limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
}

TextureArray::TextureArray(TextureFormat format, std::size_t width, std::size_t height, std::size_t layers)
    : format_(format), width_(width), height_(height), layers_(layers)
{
    require_possible(width, height, layers);
    texture_ = new_texture();
    const ArrayBoundForEdit bound(name());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, internal_format(format), static_cast<GLsizei>(width),
                   static_cast<GLsizei>(height), static_cast<GLsizei>(layers));
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void TextureArray::upload_rows(const void* values, PixelLayout layout, std::size_t rows, std::size_t columns,
                               std::size_t row_stride, std::size_t layer)
{
    if (rows != height_ || columns != width_)
        throw InvalidInput("a layer of a texture array takes " + size_text(width_, height_) + " values, got "
                           + size_text(columns, rows));
    if (layer >= layers_)
        throw InvalidInput("a texture array of " + std::to_string(layers_) + " layers has no layer "
                           + std::to_string(layer));
    const ArrayBoundForEdit bound(name());
    const PlainPixels plain(row_stride);
    const auto [format, type] = transfer_format(layout, format_);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(layer), static_cast<GLsizei>(width_),
                    static_cast<GLsizei>(height_), 1, format, type, values);
}

void TextureArray::compare_reversed_depth()
{
    const ArrayBoundForEdit bound(name());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

void TextureArray::bind(unsigned int unit) const
{
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, name());
    glActiveTexture(static_cast<GLenum>(active));
}

} // namespace duskline::gl
