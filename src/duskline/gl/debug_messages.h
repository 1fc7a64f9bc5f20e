#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace duskline::gl {

/// Collects what the driver has to say (KHR_debug, part of OpenGL 4.3) about the current context while the object
/// lives: errors, and with them undefined and deprecated use. Advice on speed is left out, and what a
/// ShaderError tells. In a context that was not
/// made for debugging a driver may keep silent; a HeadlessContext is.
///
/// One at a time and context: the context has one place for such a listener, and what was there before is back when
/// the object goes.
class DebugMessages {
public:
    DebugMessages();
    DebugMessages(DebugMessages&&) noexcept;
    DebugMessages& operator=(DebugMessages&&) noexcept;
    ~DebugMessages();

    /// What was said since the last call, oldest first.
    std::vector<std::string> take();

    /// Throws std::runtime_error with all of them, `doing` in front, if there are any.
    void throw_if_any(std::string_view doing);

private:
    struct Listener;
    std::unique_ptr<Listener> listener_;
};

} // namespace duskline::gl
