#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/headless_context.h>
#include <duskline/gl/opengl_library.h>

#include <epoxy/egl.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace duskline::gl {

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    // The display is left initialised: others may use it, and there is one per process.
    ~State()
    {
        if (context == EGL_NO_CONTEXT)
            return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
};

namespace {

bool has_extension(const char* extensions, std::string_view name)
{
    return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

// Displays that need no window system, those on a graphics card's own driver last: Mesa knows the cards as well.
std::vector<EGLDisplay> displays_without_window()
{
    std::vector<EGLDisplay> displays;
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_extension(extensions, "EGL_MESA_platform_surfaceless"))
        displays.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    if (has_extension(extensions, "EGL_EXT_platform_device")
        && has_extension(extensions, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
        for (const EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count)))
            displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    return displays;
}

EGLContext context_on(EGLDisplay display)
{
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE
        || !has_extension(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")
        || eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        return EGL_NO_CONTEXT;
    constexpr std::array<EGLint, 5> config_wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                                     EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    eglChooseConfig(display, config_wanted.data(), &config, 1, &configs);
    std::vector<EGLint> wanted = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_CONTEXT_OPENGL_DEBUG,
                                  EGL_TRUE,
                                  EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                  EGL_LOSE_CONTEXT_ON_RESET,
                                  EGL_NONE};
    const auto create = [&] {
        return eglCreateContext(display, configs > 0 ? config : nullptr, EGL_NO_CONTEXT, wanted.data());
    };
    const EGLContext told_when_lost = create();
    if (told_when_lost != EGL_NO_CONTEXT)
        return told_when_lost;
    wanted.erase(wanted.end() - 3, wanted.end() - 1); // not every driver can tell
    return create();
}

} // namespace

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>())
{
    require_egl_library();
    require_opengl_library();
    for (const EGLDisplay display : displays_without_window()) {
        state_->display = display;
        state_->context = context_on(display);
        if (state_->context == EGL_NO_CONTEXT)
            continue;
        make_current();
        return;
    }
    throw UnsupportedOnThisMachine("no device for OpenGL 4.3 without a window: EGL offers none (Debian: "
                                   "libgl1-mesa-dri brings a software renderer)");
}

HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() const
{
    if (eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) == EGL_FALSE)
        throw UnsupportedOnThisMachine("the OpenGL context cannot be made current without a surface");
}

} // namespace duskline::gl
