#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/pixel_transfer.h>
#include <duskline/gl/texture.h>

#include <array>
#include <bit>
#include <cassert>
#include <string>

namespace duskline::gl {

void delete_texture(unsigned int name)
{
    glDeleteTextures(1, &name);
}

namespace {

Handle<delete_texture> new_texture()
{
    GLuint name = 0;
    glGenTextures(1, &name);
    return Handle<delete_texture>(name);
}

std::string size_text(std::size_t width, std::size_t height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

void require_possible_size(std::size_t width, std::size_t height, std::size_t levels)
{
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const auto most = static_cast<std::size_t>(largest);
    if (width == 0 || height == 0 || width > most || height > most)
        throw InvalidInput("a texture must have 1 to " + std::to_string(most)
                           + " texels a side on this machine, got " + size_text(width, height));
    if (levels == 0 || levels > static_cast<std::size_t>(std::bit_width(std::max(width, height))))
        throw InvalidInput("a texture of " + size_text(width, height) + " texels cannot have "
                           + std::to_string(levels) + " levels");
}

} // namespace

Texture::Texture(TextureFormat format, std::size_t width, std::size_t height, std::size_t levels)
    : format_(format), width_(width), height_(height), levels_(levels)
{
    require_possible_size(width, height, levels);
    texture_ = new_texture();
    const BoundForEdit bound(*this);
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(levels), internal_format(format),
                   static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    set_filter(Filter::nearest);
    set_outside(Outside::edge);
}

void Texture::upload_rows(const void* values, PixelLayout layout, std::size_t rows, std::size_t columns,
                          std::size_t row_stride, std::size_t first_row, std::size_t first_column)
{
    if (first_row > height_ || rows > height_ - first_row || first_column > width_
        || columns > width_ - first_column)
        throw InvalidInput("values of " + size_text(columns, rows) + " from column "
                           + std::to_string(first_column) + " and row " + std::to_string(first_row)
                           + " on reach out of a texture of " + size_text(width_, height_));
    if (rows == 0 || columns == 0)
        return;
    const BoundForEdit bound(*this);
    const PlainPixels plain(row_stride);
    const auto [format, type] = transfer_format(layout, format_);
    glTexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(first_column), static_cast<GLint>(first_row),
                    static_cast<GLsizei>(columns), static_cast<GLsizei>(rows), format, type, values);
}

void Texture::set_filter(Filter filter)
{
    const BoundForEdit bound(*this);
    const GLint within = filter == Filter::nearest ? GL_NEAREST : GL_LINEAR;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, within);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                    filter == Filter::trilinear ? GL_LINEAR_MIPMAP_LINEAR : within);
}

void Texture::set_outside(Outside outside, float border)
{
    constexpr std::array<GLint, 3> modes = {GL_CLAMP_TO_EDGE, GL_REPEAT, GL_CLAMP_TO_BORDER};
    const BoundForEdit bound(*this);
    const GLint mode = modes[static_cast<std::size_t>(outside)];
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, mode);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, mode);
    const std::array<GLfloat, 4> colour = {border, border, border, border};
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, colour.data());
}

void Texture::compare_depth()
{
    const BoundForEdit bound(*this);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

void Texture::make_mipmaps()
{
    const BoundForEdit bound(*this);
    glGenerateMipmap(GL_TEXTURE_2D);
}

void Texture::bind(unsigned int unit) const
{
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, name());
    glActiveTexture(static_cast<GLenum>(active));
}

void Texture::bind_image(unsigned int unit, Access access) const
{
    constexpr std::array<GLenum, 3> accesses = {GL_READ_ONLY, GL_WRITE_ONLY, GL_READ_WRITE};
    glBindImageTexture(unit, name(), 0, GL_FALSE, 0, accesses[static_cast<std::size_t>(access)],
                       internal_format(format_));
}

} // namespace duskline::gl
