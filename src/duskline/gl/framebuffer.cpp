#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>

#include <epoxy/gl.h>

#include <string>

namespace duskline::gl {

void delete_framebuffer(unsigned int name)
{
    glDeleteFramebuffers(1, &name);
}

namespace {

Handle<delete_framebuffer> new_framebuffer()
{
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return Handle<delete_framebuffer>(name);
}

class BoundForDrawing {
public:
    explicit BoundForDrawing(GLuint framebuffer)
    {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before_);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    }
    BoundForDrawing(const BoundForDrawing&) = delete;
    BoundForDrawing& operator=(const BoundForDrawing&) = delete;
    ~BoundForDrawing() { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before_)); }

private:
    GLint before_ = 0;
};

void require_complete()
{
    if (const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE)
        throw UnsupportedOnThisMachine("this driver does not draw into such textures (framebuffer status "
                                       + std::to_string(status) + ")");
}

void attach(GLenum place, const Texture& texture)
{
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, place, GL_TEXTURE_2D, texture.name(), 0);
}

} // namespace

Framebuffer::Framebuffer(const std::vector<const Texture*>& colours, const Texture* depth)
    : colours_(colours.size()), has_depth_(depth != nullptr)
{
    std::vector<const Texture*> all = colours;
    if (depth != nullptr)
        all.push_back(depth);
    if (all.empty())
        throw InvalidInput("a framebuffer needs at least one texture");
    width_ = all.front()->width();
    height_ = all.front()->height();
    for (const Texture* texture : all)
        if (texture->width() != width_ || texture->height() != height_)
            throw InvalidInput("textures of a framebuffer must have one size, got " + std::to_string(width_)
                               + " x " + std::to_string(height_) + " and " + std::to_string(texture->width())
                               + " x " + std::to_string(texture->height()));

    framebuffer_ = new_framebuffer();
    const BoundForDrawing bound(name());
    std::vector<GLenum> outputs;
    for (const Texture* texture : colours) {
        outputs.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(outputs.size()));
        attach(outputs.back(), *texture);
    }
    if (depth != nullptr)
        attach(GL_DEPTH_ATTACHMENT, *depth);
    glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
    require_complete();
}

Framebuffer::Framebuffer(const TextureArray& depth, std::size_t layer)
    : width_(depth.width()), height_(depth.height()), has_depth_(true), framebuffer_(new_framebuffer())
{
    const BoundForDrawing bound(name());
    glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth.name(), 0,
                              static_cast<GLint>(layer));
    glDrawBuffers(0, nullptr);
    require_complete();
}

void Framebuffer::bind() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, name());
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
}

void Framebuffer::clear(const std::array<float, 4>& colour) const
{
    const BoundForDrawing bound(name());
    for (std::size_t i = 0; i < colours_; ++i)
        glClearBufferfv(GL_COLOR, static_cast<GLint>(i), colour.data());
    if (has_depth_) {
        constexpr float furthest = 1.0f;
        glClearBufferfv(GL_DEPTH, 0, &furthest);
    }
}

void Framebuffer::copy_to_window() const
{
    const auto width = static_cast<GLint>(width_);
    const auto height = static_cast<GLint>(height_);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

void bind_window(std::size_t width, std::size_t height)
{
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
}

void clear_window()
{
    constexpr std::array<float, 4> black = {0.0f, 0.0f, 0.0f, 1.0f};
    constexpr float furthest = 1.0f;
    glClearBufferfv(GL_COLOR, 0, black.data());
    glClearBufferfv(GL_DEPTH, 0, &furthest);
}

} // namespace duskline::gl
