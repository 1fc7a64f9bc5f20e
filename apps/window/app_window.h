#pragma once

#include <cstddef>
#include <string>
#include <utility>

struct GLFWwindow;

namespace duskline::window {

/// A window with a context of OpenGL 4.3 or later, current. One at a time.
class AppWindow {
public:
    /// Throws UnsupportedOnThisMachine, with the options that need no window (`instead`), where there is no display or no
    /// such OpenGL.
    AppWindow(std::size_t width, std::size_t height, const std::string& title, const std::string& instead);
    AppWindow(const AppWindow&) = delete;
    AppWindow& operator=(const AppWindow&) = delete;
    ~AppWindow();

    GLFWwindow* handle() const { return window_; }

    /// Width and height in pixels, at least 1.
    std::pair<std::size_t, std::size_t> size() const;

private:
    GLFWwindow* window_ = nullptr;
};

/// Dear ImGui in a window.
class UserInterface {
public:
    explicit UserInterface(const AppWindow& window);
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;
    ~UserInterface();

    /// Before anything of a frame is asked or drawn, and after.
    static void begin();
    static void end();
};

} // namespace duskline::window
