#include <duskline/gl/saved_drawing.h>

#include <epoxy/gl.h>

namespace duskline::gl {

namespace {

constexpr std::array<GLenum, 7> kTestNames = {
    GL_DEPTH_TEST, GL_STENCIL_TEST,   GL_SCISSOR_TEST,     GL_BLEND,
    GL_CULL_FACE,  GL_COLOR_LOGIC_OP, GL_FRAMEBUFFER_SRGB,
};

} // namespace

SavedDrawing::SavedDrawing()
{
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
    for (std::size_t i = 0; i < kTests; ++i) {
        tests_.at(i) = glIsEnabled(kTestNames.at(i)) == GL_TRUE;
        glDisable(kTestNames.at(i));
    }
}

SavedDrawing::~SavedDrawing()
{
    for (std::size_t i = 0; i < kTests; ++i)
        if (tests_[i])
            glEnable(kTestNames[i]);
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
    glUseProgram(static_cast<GLuint>(program_));
}

} // namespace duskline::gl
