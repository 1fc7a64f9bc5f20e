#include "panel.h"

#include "panel_parts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>

namespace duskline::planet_app {
namespace {

constexpr float kWidth = 300.0f;

using window::slider;
using window::text;

void draw_figures(const FrameFigures& figures)
{
    text(fmt::format("{:7.2f} ms a frame ({:.0f} a second)", figures.frame_ms,
                     1000.0 / std::max(0.01, figures.frame_ms)));
    text(fmt::format("{:7.2f} ms to choose and read tiles", figures.load_ms));
    text(fmt::format("{:7.2f} ms to find shadows", figures.cast_ms));
    text(fmt::format("{:7.2f} ms to draw", figures.draw_ms));
    text(fmt::format("{} tiles drawn, {} in memory\n{} triangles", figures.drawn.tiles,
                     figures.tiles_in_memory, figures.drawn.triangles));
}

void draw_place(const ViewedPlanet& viewed, const PlanetState& state)
{
    const PlanetPose pose = pose_of(*viewed.terrain, state.camera);
    text(fmt::format("--at {:.5f},{:.5f},{:.1f}\n--heading {:.1f} --pitch {:.1f}",
                     pose.place.longitude.degrees(), pose.place.latitude.degrees(), pose.clearance_m,
                     pose.heading.degrees(), pose.pitch.degrees()));
}

void draw_clock(PlanetSun& sun, Activity& activity)
{
    using namespace std::chrono;
    if (!sun.time) {
        if (ImGui::Button("By date and time"))
            sun.time = DateTime{floor<microseconds>(system_clock::now())};
        return;
    }
    text(to_iso8601(*sun.time));
    const auto midnight = floor<days>(sun.time->utc);
    int minute = static_cast<int>(duration_cast<minutes>(sun.time->utc - midnight).count());
    if (ImGui::SliderInt("UTC", &minute, 0, 24 * 60 - 1,
                         fmt::format("{:02}:{:02}", minute / 60, minute % 60).c_str()))
        sun.time->utc = midnight + minutes(minute);
    const auto first_day = sys_days(year_month_day(midnight).year() / January / 1);
    const int today = static_cast<int>((midnight - first_day).count());
    int day = today;
    if (ImGui::SliderInt("Day of year", &day, 0, 364))
        sun.time->utc += days(day - today);
    ImGui::Checkbox("Running", &activity.clock_runs);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110.0f);
    slider("s per s", sun.clock_s_per_s, -7200.0, 7200.0, "%.0f");
    if (ImGui::Button("By angles"))
        sun.time = std::nullopt;
}

void draw_sun(PlanetState& state, Activity& activity, const ViewedPlanet& viewed)
{
    const Globe& globe = viewed.terrain->globe();
    const LonLat place = lon_lat_of(globe, normalized(state.camera.eye_m));
    const SunAngles angles = sun_angles(globe, state.sun.direction, place);
    double azimuth_deg = angles.azimuth.degrees();
    double altitude_deg = angles.altitude.degrees();
    bool turned = slider("Azimuth", azimuth_deg, 0.0, 360.0, "%.1f");
    turned = slider("Altitude", altitude_deg, -89.0, 89.0, "%.1f") || turned;
    if (turned) {
        state.sun.time = std::nullopt;
        state.sun.direction = sun_direction(
            globe, {Angle::from_degrees(azimuth_deg), Angle::from_degrees(altitude_deg)}, place);
    }
    if (viewed.living)
        draw_clock(state.sun, activity);
    bring_up_to_date(state.sun);
}

void draw_shadows(PlanetState& state)
{
    if (ImGui::BeginCombo("Technique", std::string(name_of(state.technique)).c_str())) {
        for (const TechniqueName& known : planet_techniques()) {
            if (ImGui::Selectable(std::string(known.name).c_str(), known.technique == state.technique))
                state.technique = known.technique;
            if (ImGui::IsItemHovered())
                ImGui::SetTooltip("%s", std::string(known.description).c_str());
        }
        ImGui::EndCombo();
    }
    if (state.technique == PlanetTechnique::shadow_map)
        window::shadow_map_controls(state.shadow_map, state.shadow_look);
}

void draw_look(PlanetState& state)
{
    ImGui::SliderFloat("Ambient", &state.ambient, 0.0f, 0.9f, "%.2f");
    ImGui::SliderFloat("Exposure", &state.exposure, 0.25f, 4.0f, "%.2f", ImGuiSliderFlags_Logarithmic);
    double view_deg = state.camera.vertical_view.degrees();
    if (slider("Field of view", view_deg, 10.0, 100.0, "%.0f"))
        state.camera.vertical_view = Angle::from_degrees(view_deg);
    ImGui::Checkbox("Mark made-up detail", &state.show_made);
}

void draw_help(bool& open)
{
    if (ImGui::Begin("Keys", &open, ImGuiWindowFlags_AlwaysAutoResize))
        text("Left drag          move over the ground\n"
             "Shift + left drag  move the sun\n"
             "Right drag         look elsewhere\n"
             "Middle drag        turn around what is in the middle\n"
             "Wheel              down, up\n"
             "W A S D, Q E       fly; with Shift faster\n"
             "Home               the whole planet\n"
             "Tab                next technique\n"
             "M                  mark made-up detail\n"
             "Space              let the clock run\n"
             "F1                 these keys\n"
             "F5                 read changed shaders\n"
             "F10                hide the panel\n"
             "F12                screenshot\n"
             "Escape             leave");
    ImGui::End();
}

} // namespace

void draw_panel(PlanetState& state, Activity& activity, const ViewedPlanet& viewed,
                const FrameFigures& figures)
{
    if (activity.help)
        draw_help(activity.help);
    if (!activity.panel)
        return;
    ImGui::SetNextWindowPos({10.0f, 10.0f}, ImGuiCond_FirstUseEver);
    ImGui::Begin("Duskline", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(0.6f * kWidth);
    draw_figures(figures);
    draw_place(viewed, state);
    if (ImGui::CollapsingHeader("Sun", ImGuiTreeNodeFlags_DefaultOpen))
        draw_sun(state, activity, viewed);
    if (ImGui::CollapsingHeader("Shadows", ImGuiTreeNodeFlags_DefaultOpen))
        draw_shadows(state);
    if (ImGui::CollapsingHeader("Look"))
        draw_look(state);
    activity.wants_screenshot = ImGui::Button("Screenshot");
    ImGui::SameLine();
    if (ImGui::Button("Keys"))
        activity.help = !activity.help;
    ImGui::PushTextWrapPos(kWidth);
    if (!activity.message.empty())
        text(activity.message);
    ImGui::PopTextWrapPos();
    ImGui::PopItemWidth();
    ImGui::End();
}

} // namespace duskline::planet_app
