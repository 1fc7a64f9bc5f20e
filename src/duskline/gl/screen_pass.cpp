#include <duskline/gl/screen_pass.h>

#include <epoxy/gl.h>

#include <array>

namespace duskline::gl {

namespace {

// What may keep fragments from being written as they are.
constexpr std::array<GLenum, 7> kTests = {
    GL_DEPTH_TEST, GL_STENCIL_TEST,   GL_SCISSOR_TEST,     GL_BLEND,
    GL_CULL_FACE,  GL_COLOR_LOGIC_OP, GL_FRAMEBUFFER_SRGB,
};

class SavedDrawing {
public:
    SavedDrawing()
    {
        glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
        glGetIntegerv(GL_VIEWPORT, viewport_.data());
        for (std::size_t i = 0; i < kTests.size(); ++i) {
            tests_[i] = glIsEnabled(kTests[i]);
            glDisable(kTests[i]);
        }
    }
    SavedDrawing(const SavedDrawing&) = delete;
    SavedDrawing& operator=(const SavedDrawing&) = delete;
    ~SavedDrawing()
    {
        for (std::size_t i = 0; i < kTests.size(); ++i)
            if (tests_[i] == GL_TRUE)
                glEnable(kTests[i]);
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
        glUseProgram(static_cast<GLuint>(program_));
    }

private:
    GLint program_ = 0;
    GLint draw_framebuffer_ = 0;
    GLint read_framebuffer_ = 0;
    std::array<GLint, 4> viewport_{};
    std::array<GLboolean, kTests.size()> tests_{};
};

} // namespace

void ScreenPass::draw(const Program& program, const Framebuffer& target) const
{
    const SavedDrawing saved;
    target.bind();
    program.use();
    vertices_.draw(VertexArray::Shape::triangles, 0, 3);
}

ProgramDescription screen_program(const char* fragment_stage, std::vector<ShaderDefine> defines)
{
    return {{"full_screen.vert.glsl", fragment_stage}, std::move(defines)};
}

} // namespace duskline::gl
