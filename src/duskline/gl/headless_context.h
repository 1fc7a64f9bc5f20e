#pragma once

#include <duskline/gl/context.h>

#include <memory>

namespace duskline::gl {

/// An OpenGL 4.3 core context without a window, for servers, tests and pictures: by EGL, on a graphics card or on
/// Mesa's software renderer, and where the driver can, one that is told when it is lost. It has no default framebuffer; draw into a Framebuffer.
///
/// Current on the thread that made it until that thread makes another current or the object goes. Cost: some 50 ms.
class HeadlessContext {
public:
    /// Throws UnsupportedOnThisMachine, saying what is missing, where there is no EGL, no device or no OpenGL 4.3.
    HeadlessContext();
    HeadlessContext(HeadlessContext&&) noexcept;
    HeadlessContext& operator=(HeadlessContext&&) noexcept;
    ~HeadlessContext();

    void make_current() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace duskline::gl
