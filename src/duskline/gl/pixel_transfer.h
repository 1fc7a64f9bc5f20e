#pragma once

#include <duskline/gl/pixel.h>
#include <duskline/gl/texture.h>

#include <epoxy/gl.h>

#include <array>
#include <cstddef>

namespace duskline::gl {

/// What OpenGL calls it.
GLenum internal_format(TextureFormat format);

/// The `format` and `type` of a transfer between memory and a texture of that format.
struct TransferFormat {
    GLenum format;
    GLenum type;
};
TransferFormat transfer_format(PixelLayout layout, TextureFormat texture);

/// While it lives the texture is bound for editing; then what was bound before is again.
class BoundForEdit {
public:
    explicit BoundForEdit(const Texture& texture);
    BoundForEdit(const BoundForEdit&) = delete;
    BoundForEdit& operator=(const BoundForEdit&) = delete;
    ~BoundForEdit();

private:
    GLint before_ = 0;
};

/// While it lives pixels go from and to plain memory, rows `row_stride` pixels apart and no other rule; then as before.
class PlainPixels {
public:
    explicit PlainPixels(std::size_t row_stride);
    PlainPixels(const PlainPixels&) = delete;
    PlainPixels& operator=(const PlainPixels&) = delete;
    ~PlainPixels();

private:
    std::array<GLint, 12> before_{};
    GLint pack_buffer_ = 0;
    GLint unpack_buffer_ = 0;
};

} // namespace duskline::gl
