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

void wait_until_done()
{
    glFinish();
}

} // namespace duskline::gl
