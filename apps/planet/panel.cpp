#include "panel.h"

#include "panel_parts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace duskline::planet_app {
namespace {

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
        window::clock_controls(state.sun.time, activity.clock_runs, state.sun.clock_s_per_s);
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
    if (state.technique == PlanetTechnique::fronts) {
        ImGui::Checkbox("Sun's disc", &state.soft);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("half-shadows: the sun may be seen in part");
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
    window::show_keys(open, "Left drag          move over the ground\n"
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
}

} // namespace

void draw_panel(PlanetState& state, Activity& activity, const ViewedPlanet& viewed,
                const FrameFigures& figures, const std::string& message)
{
    if (activity.help)
        draw_help(activity.help);
    if (!activity.panel)
        return;
    window::begin_panel();
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
    window::end_panel(message);
}

} // namespace duskline::planet_app
