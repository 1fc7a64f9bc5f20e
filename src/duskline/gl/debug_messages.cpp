#include <duskline/gl/debug_messages.h>

#include <epoxy/gl.h>

#include <stdexcept>
#include <utility>

namespace duskline::gl {

struct DebugMessages::Listener {
    std::vector<std::string> messages;
    GLDEBUGPROC earlier = nullptr;
    const void* earlier_user = nullptr;
    bool output = false;
    bool synchronous = false;

    Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    ~Listener();
};

namespace {

void hear(GLenum source, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text, const void* user)
{
    const bool matters = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR
                         || type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR;
    if (!matters || source == GL_DEBUG_SOURCE_SHADER_COMPILER) // which a ShaderError tells
        return;
    auto& messages = *static_cast<std::vector<std::string>*>(const_cast<void*>(user));
    messages.push_back(length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length)));
}

void enable(GLenum what, bool on)
{
    (on ? glEnable : glDisable)(what);
}

} // namespace

DebugMessages::Listener::Listener()
    : output(glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE),
      synchronous(glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS) == GL_TRUE)
{
    void* callback = nullptr;
    void* user = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
    earlier = reinterpret_cast<GLDEBUGPROC>(callback);
    earlier_user = user;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // so that only this thread calls `hear`
    glDebugMessageCallback(hear, &messages);
}

DebugMessages::Listener::~Listener()
{
    glDebugMessageCallback(earlier, earlier_user);
    enable(GL_DEBUG_OUTPUT, output);
    enable(GL_DEBUG_OUTPUT_SYNCHRONOUS, synchronous);
}

DebugMessages::DebugMessages() : listener_(std::make_unique<Listener>()) {}
DebugMessages::DebugMessages(DebugMessages&&) noexcept = default;
DebugMessages& DebugMessages::operator=(DebugMessages&&) noexcept = default;
DebugMessages::~DebugMessages() = default;

std::vector<std::string> DebugMessages::take()
{
    return std::exchange(listener_->messages, {});
}

void DebugMessages::throw_if_any(std::string_view doing)
{
    const auto messages = take();
    if (messages.empty())
        return;
    std::string text = std::string(doing) + ": OpenGL says";
    for (const std::string& message : messages)
        text += " '" + message + "'";
    throw std::runtime_error(text);
}

} // namespace duskline::gl
