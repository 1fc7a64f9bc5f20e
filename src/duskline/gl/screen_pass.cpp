#include <duskline/gl/saved_drawing.h>
#include <duskline/gl/screen_pass.h>

namespace duskline::gl {

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
