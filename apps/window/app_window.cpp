#include "app_window.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/context.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>

namespace duskline::window {
namespace {

std::string last_glfw_error()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

} // namespace

AppWindow::AppWindow(std::size_t width, std::size_t height, const std::string& title,
                     const std::string& instead)
{
    if (glfwInit() != GLFW_TRUE)
        throw UnsupportedOnThisMachine("no window can be opened: " + last_glfw_error() + "; " + instead
                                       + " need no display");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET); // where the driver can tell
    glfwWindowHint(GLFW_SAMPLES, 4);
    window_ =
        glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw UnsupportedOnThisMachine("no window with OpenGL 4.3 can be opened: " + reason + "; " + instead
                                       + " can use Mesa's software renderer");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    gl::current_context();
}

AppWindow::~AppWindow()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::pair<std::size_t, std::size_t> AppWindow::size() const
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::size_t>(std::max(width, 1)), static_cast<std::size_t>(std::max(height, 1))};
}

UserInterface::UserInterface(const AppWindow& window)
{
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // leaves no files about
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4.0f;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 430");
}

UserInterface::~UserInterface()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void UserInterface::begin()
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void UserInterface::end()
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace duskline::window
