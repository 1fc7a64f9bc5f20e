#include <duskline/gl/pixel_transfer.h>

#include <utility>

namespace duskline::gl {

namespace {

constexpr std::array<GLenum, 12> kPixelStore = {
    GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
    GL_UNPACK_SKIP_PIXELS, GL_UNPACK_ALIGNMENT, GL_PACK_SWAP_BYTES,   GL_PACK_LSB_FIRST,
    GL_PACK_ROW_LENGTH,    GL_PACK_SKIP_ROWS,   GL_PACK_SKIP_PIXELS,  GL_PACK_ALIGNMENT,
};

bool holds_integers(TextureFormat format)
{
    return format == TextureFormat::r32i || format == TextureFormat::rg32i || format == TextureFormat::rgba32i
           || format == TextureFormat::r32ui;
}

GLenum type_of(PixelLayout::Channel channel)
{
    switch (channel) {
    case PixelLayout::Channel::uint8:
        return GL_UNSIGNED_BYTE;
    case PixelLayout::Channel::uint32:
        return GL_UNSIGNED_INT;
    case PixelLayout::Channel::int32:
        return GL_INT;
    case PixelLayout::Channel::float32:
        break;
    }
    return GL_FLOAT;
}

} // namespace

GLenum internal_format(TextureFormat format)
{
    switch (format) {
    case TextureFormat::r8:
        return GL_R8;
    case TextureFormat::rgba8:
        return GL_RGBA8;
    case TextureFormat::srgb8_alpha8:
        return GL_SRGB8_ALPHA8;
    case TextureFormat::r32f:
        return GL_R32F;
    case TextureFormat::rg32f:
        return GL_RG32F;
    case TextureFormat::rgba32f:
        return GL_RGBA32F;
    case TextureFormat::r32i:
        return GL_R32I;
    case TextureFormat::rg32i:
        return GL_RG32I;
    case TextureFormat::rgba32i:
        return GL_RGBA32I;
    case TextureFormat::r32ui:
        return GL_R32UI;
    case TextureFormat::depth32f:
        break;
    }
    return GL_DEPTH_COMPONENT32F;
}

TransferFormat transfer_format(PixelLayout layout, TextureFormat texture)
{
    constexpr std::array<GLenum, 4> numbers = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    constexpr std::array<GLenum, 4> integers = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER,
                                                GL_RGBA_INTEGER};
    const auto channels = static_cast<std::size_t>(layout.channels - 1);
    const GLenum type = type_of(layout.channel);
    if (texture == TextureFormat::depth32f)
        return {GL_DEPTH_COMPONENT, type};
    return {holds_integers(texture) ? integers[channels] : numbers[channels], type};
}

BoundForEdit::BoundForEdit(const Texture& texture)
{
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &before_);
    glBindTexture(GL_TEXTURE_2D, texture.name());
}

BoundForEdit::~BoundForEdit()
{
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before_));
}

PlainPixels::PlainPixels(std::size_t row_stride)
{
    for (std::size_t i = 0; i < kPixelStore.size(); ++i) {
        glGetIntegerv(kPixelStore[i], &before_[i]);
        const bool is_alignment =
            kPixelStore[i] == GL_UNPACK_ALIGNMENT || kPixelStore[i] == GL_PACK_ALIGNMENT;
        glPixelStorei(kPixelStore[i], is_alignment ? 1 : 0);
    }
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer_);
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack_buffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(row_stride));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(row_stride));
}

PlainPixels::~PlainPixels()
{
    for (std::size_t i = 0; i < kPixelStore.size(); ++i)
        glPixelStorei(kPixelStore[i], before_[i]);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer_));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack_buffer_));
}

} // namespace duskline::gl
