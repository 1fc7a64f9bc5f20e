#include "window.h"

#include "app_window.h"
#include "free_name.h"
#include "panel.h"
#include "picture_target.h"
#include "planet_files.h"
#include "planet_frame.h"
#include "sitting.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/raster_io/write_picture.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace duskline::planet_app {
namespace {

constexpr double kLeastClearance_m = 1.0;
constexpr double kMostClearance = 20.0; // in radii

// On machines with many cores more tiles are done in that time.
constexpr FrameBudget kBudget = {.shadows = {.tiles = 24, .ms = 8.0}};

// One sitting before a planet.
class PlanetSitting : public window::Sitting {
public:
    PlanetSitting(const PlanetOptions& options, const window::AppWindow& window, const ViewedPlanet& viewed,
                  const gl::ShaderSources& sources)
        : Sitting(window), viewed_(viewed), state_(first_state(options, *viewed.terrain)),
          scene_(viewed, sources, state_.square_pixels, {.threads = options.run.threads, .progress = {}}),
          shadowing_(scene_)
    {}

private:
    // While tiles still come, too.
    bool moves() const override { return activity_.clock_runs || !settled_; }

    void draw_frame() override
    {
        const auto [width, height] = window_.size();
        advance(static_cast<double>(ImGui::GetIO().DeltaTime));
        take_keys();
        take_mouse();
        keep_camera_sensible();

        if (!target_ || target_->width() != width || target_->height() != height)
            target_ = std::make_unique<window::PictureTarget>(width, height);
        target_->begin();
        note(planet_app::draw_frame(scene_, shadowing_, state_, width, height, kBudget));
        if (activity_.wants_screenshot)
            save_screenshot();
        gl::bind_window(width, height);
        target_->show_in_window();
        figures_.frame_ms = frame_ms_;
        draw_panel(state_, activity_, viewed_, figures_, message_);
    }

    void advance(double seconds)
    {
        if (activity_.clock_runs)
            window::advance_clock(state_.sun.time, seconds * state_.sun.clock_s_per_s);
        bring_up_to_date(state_.sun);
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
        if (pressed(GLFW_KEY_L))
            change_lamps(io.KeyShift);
        if (pressed(GLFW_KEY_M))
            state_.show_made = !state_.show_made;
        if (pressed(GLFW_KEY_SPACE))
            activity_.clock_runs = !activity_.clock_runs;
        if (pressed(GLFW_KEY_F1))
            activity_.help = !activity_.help;
        if (pressed(GLFW_KEY_F10))
            activity_.panel = !activity_.panel;
        if (pressed(GLFW_KEY_F5))
            reload_shaders();
        if (pressed(GLFW_KEY_HOME))
            see_all();
        activity_.wants_screenshot = activity_.wants_screenshot || pressed(GLFW_KEY_F12);
        fly();
    }

    double clearance() const
    {
        return std::max(kLeastClearance_m, clearance_m(state_.camera, *viewed_.terrain));
    }

    // Faster the higher up.
    void fly()
    {
        const window::FlightByKeys flight = window::flight_by_keys();
        if (flight.share == 0.0)
            return;
        const double step_m = flight.share * std::max(5.0, clearance());
        move(flight.right * step_m, flight.ahead * step_m, flight.up * step_m);
    }

    void move(double right_m, double ahead_m, double up_m)
    {
        state_.camera = flown(viewed_.terrain->globe(), state_.camera, right_m, ahead_m, up_m);
    }

    void take_mouse()
    {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse)
            return;
        if (io.MouseWheel != 0.0f)
            move(0.0, 0.0, clearance() * (std::pow(0.85, static_cast<double>(io.MouseWheel)) - 1.0));
        const double right_px = static_cast<double>(io.MouseDelta.x);
        const double down_px = static_cast<double>(io.MouseDelta.y);
        if (right_px == 0.0 && down_px == 0.0)
            return;
        const double height_px = static_cast<double>(io.DisplaySize.y);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyShift)
            drag_sun(right_px, -down_px, height_px);
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
            drag_ground(right_px, down_px, height_px);
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
            state_.camera = turned(state_.camera, Angle::from_degrees(0.125 * right_px),
                                   Angle::from_degrees(-0.125 * down_px));
        else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle))
            orbit(Angle::from_degrees(0.25 * right_px), Angle::from_degrees(-0.25 * down_px));
    }

    void drag_sun(double right_px, double up_px, double height_px)
    {
        const Globe& globe = viewed_.terrain->globe();
        const LonLat place = lon_lat_of(globe, normalized(state_.camera.eye_m));
        SunAngles angles = sun_angles(globe, state_.sun.direction, place);
        const double degrees = 90.0 / height_px;
        angles.azimuth = angles.azimuth + Angle::from_degrees(2.0 * degrees * right_px);
        angles.altitude =
            Angle::from_degrees(std::clamp(angles.altitude.degrees() + degrees * up_px, -89.0, 89.0));
        state_.sun.direction = sun_direction(globe, angles, place);
        state_.sun.time = std::nullopt;
    }

    double distance_ahead() const
    {
        const double down = -sine_cosine(state_.camera.pitch).sine;
        return clearance() / std::max(0.1, down);
    }

    // The ground stays under the pointer where it is as far away as in the middle of the picture.
    void drag_ground(double right_px, double down_px, double height_px)
    {
        const double half_view = tangent(Angle::from_degrees(state_.camera.vertical_view.degrees() / 2.0));
        const double metre_per_pixel =
            std::min(distance_ahead(), viewed_.terrain->globe().equatorial_radius_m) * 2.0 * half_view
            / height_px;
        move(-right_px * metre_per_pixel, down_px * metre_per_pixel, 0.0);
    }

    // Turns around the point that far ahead, which stays in the middle.
    void orbit(Angle by_heading, Angle by_pitch)
    {
        const Globe& globe = viewed_.terrain->globe();
        const double distance_m = distance_ahead();
        const Vector3 pivot_m = state_.camera.eye_m + axes_of(globe, state_.camera).forward * distance_m;
        PlanetCamera camera = turned(state_.camera, by_heading, by_pitch);
        camera.eye_m = pivot_m - axes_of(globe, camera).forward * distance_m;
        const LocalFrame here = local_frame(globe, normalized(camera.eye_m));
        const Vector3 to_pivot = normalized(pivot_m - camera.eye_m);
        camera.heading = Angle::from_radians(std::atan2(dot(to_pivot, here.east), dot(to_pivot, here.north)));
        camera.pitch = Angle::from_radians(std::asin(std::clamp(dot(to_pivot, here.up), -1.0, 1.0)));
        state_.camera = camera;
    }

    void see_all()
    {
        const double radius_m = viewed_.terrain->globe().equatorial_radius_m;
        move(0.0, 0.0, 3.0 * radius_m - clearance());
        state_.camera.pitch = Angle::from_degrees(-90.0);
    }

    void keep_camera_sensible()
    {
        const double most_m = kMostClearance * viewed_.terrain->globe().equatorial_radius_m;
        if (clearance() > most_m)
            move(0.0, 0.0, most_m - clearance());
        state_.camera = kept_above_ground(state_.camera, *viewed_.terrain, kLeastClearance_m);
    }

    void next_technique()
    {
        const auto& all = planet_techniques();
        const auto found = std::ranges::find(all, state_.technique, &TechniqueName::technique);
        state_.technique = all[static_cast<std::size_t>(found - all.begin() + 1) % all.size()].technique;
        message_ = fmt::format("Shadows: {}", name_of(state_.technique));
    }

    void change_lamps(bool take_away)
    {
        if (take_away && !state_.lamps.empty())
            state_.lamps.pop_back();
        else if (!take_away && state_.lamps.size() < kMostLamps)
            state_.lamps.push_back(lamp_at_eye(*viewed_.terrain, state_.camera, window::usual_lamp()));
        message_ = fmt::format("Lamps: {}", state_.lamps.size());
    }

    void note(const FrameCost& cost)
    {
        window::smooth(figures_.load_ms, cost.load_ms);
        window::smooth(figures_.cast_ms, cost.cast_ms);
        window::smooth(figures_.lamps_ms, state_.lamps.empty() ? 0.0 : cost.lamps_ms);
        window::smooth(figures_.draw_ms, cost.draw_ms);
        figures_.drawn = cost.drawn;
        figures_.tiles_in_memory = scene_.quadtree().tiles().size();
        settled_ = cost.settled;
    }

    void save_screenshot()
    {
        activity_.wants_screenshot = false;
        attempt([&] {
            const std::string path = window::free_name("duskline-planet", ".png");
            write_picture(path, target_->picture().view());
            return "Written: " + path;
        });
    }

    void reload_shaders()
    {
        attempt([&] {
            return std::string(scene_.reload_shaders() ? "Shaders read anew" : "No shader has changed");
        });
    }

    const ViewedPlanet& viewed_;
    PlanetState state_;
    PlanetScene scene_;
    PlanetShadowing shadowing_;
    Activity activity_;
    FrameFigures figures_;
    std::unique_ptr<window::PictureTarget> target_; ///< of the window's size, with depth that can be reversed
    bool settled_ = false;
};

} // namespace

void show_window(const PlanetOptions& options, cli::Report& report)
{
    const window::AppWindow window(options.width, options.height, "Duskline: planet",
                                   "--render and --flydown");
    const ViewedPlanet viewed = read_viewed_planet(options, report);
    const gl::ShaderSources sources = window::shader_sources_of_environment();
    const window::UserInterface user_interface(window);
    PlanetSitting sitting(options, window, viewed, sources);
    sitting.run();
}

} // namespace duskline::planet_app
