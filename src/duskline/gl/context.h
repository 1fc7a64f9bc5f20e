#pragma once

#include <string>

namespace duskline::gl {

// Everything in this folder works on the OpenGL context that is current on the calling thread: one of yours (a
// window, an engine) or a HeadlessContext. It must be OpenGL 4.3 core or later. Objects belong to the context they
// were made in and are used by one thread at a time.
//
// Functions leave bindings and the current program as they found them, unless they are called bind or use; a technique
// says which texture, image and buffer units it takes.

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

/// Throws UnsupportedOnThisMachine when the driver says that the current context is lost: reset after a hang, or the card
/// gone. Everything that was in it is lost then, and nothing more will be drawn. Only contexts that were made to be told
/// know (`HeadlessContext` is, and by GLFW those with GLFW_LOSE_CONTEXT_ON_RESET); of others it says nothing.
void require_context_kept();

/// Waits until everything that was asked of the graphics card is done.
void wait_until_done();

} // namespace duskline::gl
