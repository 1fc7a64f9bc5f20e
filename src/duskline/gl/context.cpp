#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/context.h>
#include <duskline/gl/opengl_library.h>

#include <epoxy/gl.h>

namespace duskline::gl {

static std::string text_of(GLenum name)
{
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

ContextInfo current_context()
{
    require_opengl_library();
    ContextInfo info;
    info.version = text_of(GL_VERSION);
    if (info.version.empty())
        throw UnsupportedOnThisMachine("no OpenGL context is current on this thread: make one current first");
    glGetIntegerv(GL_MAJOR_VERSION, &info.major_version);
    glGetIntegerv(GL_MINOR_VERSION, &info.minor_version);
    info.vendor = text_of(GL_VENDOR);
    info.renderer = text_of(GL_RENDERER);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &info.largest_texture);
    if (info.major_version * 10 + info.minor_version < 43)
        throw UnsupportedOnThisMachine("OpenGL 4.3 is needed, and the current context is " + info.version
                                       + " on " + info.renderer);
    return info;
}

static const char* why_lost(GLenum status)
{
    switch (status) {
    case GL_GUILTY_CONTEXT_RESET:
        return "what this program asked for took too long or went wrong on the card";
    case GL_INNOCENT_CONTEXT_RESET:
        return "another program made the card start again";
    default:
        return "the driver does not say why";
    }
}

void require_context_kept()
{
    const bool can_tell = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
    const GLenum status = can_tell ? glGetGraphicsResetStatus() : GL_NO_ERROR;
    if (status != GL_NO_ERROR)
        throw UnsupportedOnThisMachine(std::string("the OpenGL context was lost (") + why_lost(status)
                                       + "): start again");
}

void wait_until_done()
{
    glFinish();
}

} // namespace duskline::gl
