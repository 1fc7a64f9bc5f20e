#include "sitting.h"

#include "interruption.h"
#include "stopwatch.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace duskline::window {
namespace {

constexpr double kIdleSeconds = 0.25;
constexpr int kStillFrames = 3; // before hands count as still
constexpr double kSmoothing = 0.1;

} // namespace

void Sitting::run()
{
    while (glfwWindowShouldClose(window_.handle()) == GLFW_FALSE) {
        cli::stop_if_interrupted();
        if (is_idle())
            glfwWaitEventsTimeout(kIdleSeconds);
        else
            glfwPollEvents();
        frame();
    }
}

void Sitting::attempt(const std::function<std::string()>& work)
{
    try {
        message_ = work();
    } catch (const std::exception& error) {
        message_ = error.what();
    }
}

void Sitting::leave()
{
    glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
}

bool Sitting::is_idle()
{
    const ImGuiIO& io = ImGui::GetIO();
    const bool held =
        ImGui::IsAnyMouseDown() || std::ranges::any_of(io.KeysDown, [](bool down) { return down; });
    still_frames_ = moves() || held ? 0 : still_frames_ + 1;
    return still_frames_ > kStillFrames;
}

void Sitting::frame()
{
    double seconds = 0.0;
    {
        const cli::Stopwatch watch(seconds);
        UserInterface::begin();
        draw_frame();
        UserInterface::end();
        glfwSwapBuffers(window_.handle());
    }
    smooth(frame_ms_, 1000.0 * seconds);
}

void smooth(double& figure, double value)
{
    figure += kSmoothing * (value - figure);
}

FlightByKeys flight_by_keys()
{
    const auto along = [](int forwards, int backwards) {
        return (ImGui::IsKeyDown(forwards) ? 1.0 : 0.0) - (ImGui::IsKeyDown(backwards) ? 1.0 : 0.0);
    };
    const ImGuiIO& io = ImGui::GetIO();
    FlightByKeys flight = {along(GLFW_KEY_D, GLFW_KEY_A), along(GLFW_KEY_W, GLFW_KEY_S),
                           along(GLFW_KEY_E, GLFW_KEY_Q)};
    if (flight.right != 0.0 || flight.ahead != 0.0 || flight.up != 0.0)
        flight.share = static_cast<double>(io.DeltaTime) * (io.KeyShift ? 3.0 : 0.8);
    return flight;
}

void advance_clock(std::optional<DateTime>& time, double seconds)
{
    if (time)
        time->utc +=
            std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::duration<double>(seconds));
}

gl::ShaderSources shader_sources_of_environment()
{
    const char* folder = std::getenv("DUSKLINE_SHADER_DIR"); // NOLINT(concurrency-mt-unsafe): nothing sets it
    return folder != nullptr ? gl::ShaderSources(folder) : gl::ShaderSources();
}

} // namespace duskline::window
