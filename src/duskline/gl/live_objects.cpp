#include <duskline/gl/live_objects.h>

#include <epoxy/gl.h>

namespace duskline::gl {

namespace {

// Drivers may keep a program for a while after it was deleted.
bool is_deleted_program(GLuint name)
{
    GLint deleted = GL_FALSE;
    glGetProgramiv(name, GL_DELETE_STATUS, &deleted);
    return deleted == GL_TRUE;
}

} // namespace

LiveObjects live_objects()
{
    constexpr GLuint last_name = 10000;
    LiveObjects live;
    for (GLuint name = 1; name <= last_name; ++name) {
        live.textures += glIsTexture(name) == GL_TRUE ? 1U : 0U;
        live.buffers += glIsBuffer(name) == GL_TRUE ? 1U : 0U;
        live.framebuffers += glIsFramebuffer(name) == GL_TRUE ? 1U : 0U;
        live.vertex_arrays += glIsVertexArray(name) == GL_TRUE ? 1U : 0U;
        live.programs += glIsShader(name) == GL_TRUE ? 1U : 0U;
        live.programs += glIsProgram(name) == GL_TRUE && !is_deleted_program(name) ? 1U : 0U;
        live.queries += glIsQuery(name) == GL_TRUE ? 1U : 0U;
    }
    return live;
}

} // namespace duskline::gl
