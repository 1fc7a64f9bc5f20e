#pragma once

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/vertex_array.h>

namespace duskline::gl {

/// Runs fragment programs (with full_screen.vert.glsl) over every texel of a framebuffer, whatever is drawn around it:
/// framebuffer, viewport, program and tests are afterwards what they were before.
class ScreenPass {
public:
    void draw(const Program& program, const Framebuffer& target) const;

private:
    VertexArray vertices_; ///< none: the program makes its own
};

/// The description of such a program.
ProgramDescription screen_program(const char* fragment_stage, std::vector<ShaderDefine> defines = {});

} // namespace duskline::gl
