#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/opengl_library.h>

#include <dlfcn.h>

namespace duskline::gl {

// Stays loaded: libepoxy is about to load it as well.
static bool can_load(const char* library)
{
    return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr;
}

void require_opengl_library()
{
    static const bool found = can_load("libOpenGL.so.0") || can_load("libGL.so.1");
    if (!found)
        throw UnsupportedOnThisMachine(
            "no OpenGL on this machine: libOpenGL.so.0 is missing (Debian: libopengl0)");
}

void require_egl_library()
{
    static const bool found = can_load("libEGL.so.1");
    if (!found)
        throw UnsupportedOnThisMachine("no EGL on this machine: libEGL.so.1 is missing (Debian: libegl1)");
}

} // namespace duskline::gl
