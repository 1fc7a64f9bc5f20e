#include "window.h"

#include "app_window.h"
#include "free_name.h"
#include "panel.h"
#include "raster_site.h"
#include "scene.h"
#include "sitting.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/raster_io/write_picture.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace duskline::viewer {
namespace {

using window::free_name;

constexpr double kPosesPerSecond = 10.0; // of a recorded flight

// One sitting before the viewer.
class ViewerSitting : public window::Sitting {
public:
    ViewerSitting(const ViewerOptions& options, const window::AppWindow& window, ViewedTerrain& viewed,
                  const SunClock& clock, const gl::ShaderSources& sources)
        : Sitting(window), clock_(clock), scene_(viewed, clock, sources),
          state_(first_state(options, viewed, clock))
    {
        if (!options.flight.empty())
            activity_.flight = read_flight(options.flight);
        const CellSize cell_m = scene_.field().cell_size_m;
        activity_.brush.radius_m = 30.0 * std::max(cell_m.x, cell_m.y);
        activity_.brush.amount_m = 0.5 * activity_.brush.radius_m;
    }

private:
    bool moves() const override
    {
        return activity_.clock_runs || activity_.replays || activity_.records || is_animated()
               || scene_.done() < 1.0;
    }

    bool is_animated() const
    {
        return (state_.animation != kNoMotion || state_.objects) && state_.animation_speed != 0.0;
    }

    void draw_frame() override
    {
        const auto [width, height] = window_.size();
        aspect_ = static_cast<double>(width) / static_cast<double>(height);
        advance(static_cast<double>(ImGui::GetIO().DeltaTime));
        take_keys();
        take_mouse();
        keep_camera_sensible();

        gl::bind_window(width, height);
        gl::clear_window();
        const FrameCost cast = scene_.cast(state_, width, height);
        note(cast, scene_.draw(state_, width, height));
        if (activity_.wants_screenshot)
            save_screenshot(width, height);
        do_wishes();
        figures_.frame_ms = frame_ms_;
        draw_panel(state_, activity_, clock_, figures_, message_);
    }

    void advance(double seconds)
    {
        if (activity_.clock_runs) {
            window::advance_clock(state_.light.time, seconds * state_.clock_s_per_s);
            clock_.bring_up_to_date(state_.light);
        }
        if (is_animated())
            state_.animation_s += seconds * state_.animation_speed;
        if (activity_.replays && activity_.flight.poses.empty())
            activity_.flight = usual_flight(scene_.field(), aspect_);
        if (activity_.replays) {
            state_.camera = pose_at(activity_.flight, activity_.replayed);
            activity_.replayed += seconds * kPosesPerSecond
                                  / std::max(1.0, static_cast<double>(activity_.flight.poses.size() - 1));
            activity_.replays = activity_.replayed <= 1.0;
        }
        since_pose_s_ += seconds;
        if (activity_.records && since_pose_s_ >= 1.0 / kPosesPerSecond) {
            activity_.flight.poses.push_back(state_.camera);
            since_pose_s_ = 0.0;
        }
    }

    void take_keys()
    {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureKeyboard)
            return;
        const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
        if (pressed(GLFW_KEY_ESCAPE))
            leave();
        if (pressed(GLFW_KEY_TAB))
            next_technique();
        if (pressed(GLFW_KEY_X))
            state_.difference = !state_.difference;
        if (pressed(GLFW_KEY_M))
            next_animation();
        if (pressed(GLFW_KEY_O))
            state_.objects = !state_.objects;
        if (pressed(GLFW_KEY_SPACE))
            activity_.clock_runs = !activity_.clock_runs;
        if (pressed(GLFW_KEY_F1))
            activity_.help = !activity_.help;
        if (pressed(GLFW_KEY_F10))
            activity_.panel = !activity_.panel;
        if (pressed(GLFW_KEY_F5))
            reload_shaders();
        if (pressed(GLFW_KEY_R))
            toggle_recording();
        activity_.wants_state_saved = activity_.wants_state_saved || pressed(GLFW_KEY_F2);
        activity_.wants_screenshot = activity_.wants_screenshot || pressed(GLFW_KEY_F12);
        activity_.wants_overview = activity_.wants_overview || pressed(GLFW_KEY_HOME);
        fly();
    }

    void toggle_recording()
    {
        activity_.records = !activity_.records;
        if (activity_.records)
            activity_.flight.poses.clear();
    }

    // Faster the higher up.
    void fly()
    {
        const window::FlightByKeys flight = window::flight_by_keys();
        if (flight.share == 0.0)
            return;
        const double height_m = std::max(10.0 * scene_.field().cell_size_m.x,
                                         clearance_m(state_.camera.position_m, scene_.field()));
        const double step_m = flight.share * height_m;
        state_.camera =
            flown(state_.camera, flight.right * step_m, flight.ahead * step_m, flight.up * step_m);
        activity_.replays = false;
    }

    Vector3 under_pointer() const
    {
        const ImGuiIO& io = ImGui::GetIO();
        const double right = 2.0 * static_cast<double>(io.MousePos.x / io.DisplaySize.x) - 1.0;
        const double up = 1.0 - 2.0 * static_cast<double>(io.MousePos.y / io.DisplaySize.y);
        return picked_m(state_.camera, aspect_, right, up, scene_.field());
    }

    void take_mouse()
    {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse)
            return;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
            pivot_m_ = under_pointer();
        if (io.MouseWheel != 0.0f)
            state_.camera = approached(state_.camera, under_pointer(),
                                       std::pow(0.85, static_cast<double>(io.MouseWheel)));
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyCtrl)
            return stroke_ground(static_cast<double>(io.DeltaTime));
        const double right_px = static_cast<double>(io.MouseDelta.x);
        const double down_px = static_cast<double>(io.MouseDelta.y);
        if (right_px == 0.0 && down_px == 0.0)
            return;
        const double height_px = static_cast<double>(io.DisplaySize.y);
        const double degrees = 0.25;
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyShift)
            state_.light = dragged(state_.light, right_px, -down_px, height_px);
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
            state_.camera = orbited(state_.camera, pivot_m_, Angle::from_degrees(degrees * right_px),
                                    Angle::from_degrees(-degrees * down_px));
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
            state_.camera = turned(state_.camera, Angle::from_degrees(0.5 * degrees * right_px),
                                   Angle::from_degrees(-0.5 * degrees * down_px));
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle))
            shift(right_px, down_px, height_px);
    }

    // Shadows follow before the frame is drawn.
    void stroke_ground(double seconds)
    {
        Brush brush = activity_.brush;
        brush.amount_m *= seconds;
        scene_.stroke(grid_point(under_pointer(), scene_.field().cell_size_m), brush);
    }

    // What was clicked on stays under the pointer.
    void shift(double right_px, double down_px, double height_px)
    {
        const CameraAxes axes = axes_of(state_.camera);
        const double ahead_m = dot(pivot_m_ - state_.camera.position_m, axes.forward);
        const double metre_per_pixel = std::abs(ahead_m) / pixels_per_radian(state_.camera, height_px);
        state_.camera.position_m = state_.camera.position_m + axes.right * (-right_px * metre_per_pixel)
                                   + axes.up * (down_px * metre_per_pixel);
    }

    void keep_camera_sensible()
    {
        const double cell_m = std::max(scene_.field().cell_size_m.x, scene_.field().cell_size_m.y);
        state_.camera = kept_above_ground(state_.camera, scene_.field(), 0.5 * cell_m);
    }

    void next_technique()
    {
        const auto kinds = gl::shadow_techniques();
        const auto found = std::ranges::find(kinds, state_.technique, &gl::ShadowTechniqueKind::name);
        const auto next = static_cast<std::size_t>(found - kinds.begin() + 1) % kinds.size();
        state_.technique = kinds[next].name;
        message_ = "Shadows: " + state_.technique;
    }

    // None after the last.
    void next_animation()
    {
        const auto kinds = ground_motions();
        const auto found = std::ranges::find(kinds, state_.animation, &GroundMotionKind::name);
        const auto next = found == kinds.end() ? 0 : static_cast<std::size_t>(found - kinds.begin()) + 1;
        state_.animation = next < kinds.size() ? kinds[next].name : kNoMotion;
        state_.animation_s = 0.0;
        message_ = "Ground in motion: " + state_.animation;
    }

    void note(const FrameCost& cast, const FrameCost& drawn)
    {
        if (cast.cast_ms > 0.0)
            figures_.cast_ms = cast.cast_ms;
        figures_.ground_ms = cast.ground_ms;
        figures_.cast_gpu_ms = cast.cast_gpu_ms.value_or(figures_.cast_gpu_ms);
        figures_.draw_gpu_ms = drawn.draw_gpu_ms.value_or(figures_.draw_gpu_ms);
        figures_.mesh = drawn.mesh;
        figures_.done = scene_.done();
    }

    void save_screenshot(std::size_t width, std::size_t height)
    {
        activity_.wants_screenshot = false;
        attempt([&] {
            const std::string path = free_name("duskline", ".png");
            Picture picture = gl::read_back_picture(width, height);
            for (Rgba8& pixel : picture.values())
                pixel[3] = 255;
            write_picture(path, picture.view());
            return "Written: " + path;
        });
    }

    void do_wishes()
    {
        if (activity_.wants_state_saved)
            attempt([&] {
                const std::string path = free_name("duskline-state", ".json");
                write_state(path, state_);
                return "Written: " + path + " (for --state)";
            });
        if (activity_.wants_flight_saved)
            attempt([&] {
                const std::string path = free_name("duskline-flight", ".json");
                write_flight(path, activity_.flight);
                return "Written: " + path + " (for --flight)";
            });
        if (activity_.wants_count)
            attempt([&] {
                activity_.counted = mask_difference(scene_.true_mask(), scene_.lit_mask());
                activity_.black_share = scene_.black_share();
                return std::string();
            });
        if (activity_.wants_overview)
            state_.camera = overview(scene_.field(), aspect_);
        activity_.wants_state_saved = false;
        activity_.wants_flight_saved = false;
        activity_.wants_count = false;
        activity_.wants_overview = false;
    }

    void reload_shaders()
    {
        attempt([&] {
            return std::string(scene_.reload_shaders() ? "Shaders read anew" : "No shader has changed");
        });
    }

    const SunClock& clock_;
    Scene scene_;
    ViewerState state_;
    Activity activity_;
    FrameFigures figures_;
    Vector3 pivot_m_;
    double aspect_ = 1.0;
    double since_pose_s_ = 0.0;
};

} // namespace

void show_window(const ViewerOptions& options, cli::Report& report)
{
    const window::AppWindow window(options.width, options.height, "Duskline: " + options.input.path,
                                   "--render and --flyby");
    ViewedTerrain viewed = read_viewed_terrain(options, report);
    const SunClock clock(cli::light_site(viewed.file.ground()), options.light.sun,
                         options.light.sun_size_deg);
    const gl::ShaderSources sources = window::shader_sources_of_environment();
    const window::UserInterface user_interface(window);
    ViewerSitting sitting(options, window, viewed, clock, sources);
    sitting.run();
}

} // namespace duskline::viewer
