#pragma once

#include <string>

namespace duskline::gl {

// Everything in this folder works on the OpenGL context that is current on the calling thread: one of yours (a
// window, an engine) or a HeadlessContext. It must be OpenGL 4.3 core or later. Objects belong to the context they
// were made in and are used by one thread at a time.
//
// What is uploaded, drawn or computed leaves bindings that OpenGL needs for it as they were, unless a function is
// called bind, use or clear.

/// What the current context says of itself.
struct ContextInfo {
    int major_version = 0;
    int minor_version = 0;
    std::string vendor;
    std::string renderer;
    std::string version;
    int largest_texture = 0; ///< texels, width and height
};

/// Throws UnsupportedOnThisMachine unless a context of OpenGL 4.3 or later is current on this thread.
ContextInfo current_context();

} // namespace duskline::gl
