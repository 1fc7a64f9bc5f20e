#include "picture_target.h"

#include <duskline/gl/read_back.h>

namespace duskline::window {

PictureTarget::PictureTarget(std::size_t width, std::size_t height)
    : colour_(gl::TextureFormat::rgba8, width, height), depth_(gl::TextureFormat::depth32f, width, height),
      framebuffer_({&colour_}, &depth_)
{}

void PictureTarget::begin() const
{
    framebuffer_.bind();
    framebuffer_.clear({0.0f, 0.0f, 0.0f, 1.0f});
}

Picture PictureTarget::picture() const
{
    framebuffer_.bind();
    return gl::read_back_picture(width(), height());
}

} // namespace duskline::window
