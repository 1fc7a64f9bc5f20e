#include "panel.h"

#include "lamp_controls.h"
#include "panel_parts.h"
#include "state_text.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

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
    if (figures.lamps_ms > 0.005)
        text(fmt::format("{:7.2f} ms to draw maps of lamps", figures.lamps_ms));
    text(fmt::format("{:7.2f} ms to draw", figures.draw_ms));
    text(fmt::format("{} tiles drawn, {} in memory\n{} triangles", figures.drawn.tiles,
                     figures.tiles_in_memory, figures.drawn.triangles));
}

void draw_place(const ViewedPlanet& viewed, const PlanetState& state)
{
    ImGui::PushTextWrapPos(window::kPanelWidth);
    text(pose_options(pose_of(*viewed.terrain, state.camera)));
    ImGui::PopTextWrapPos();
    if (ImGui::Button("Copy options"))
        ImGui::SetClipboardText(options_of(*viewed.terrain, state).c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("of this view with its sun, shadows and lamps, for --render");
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

void draw_lamps(PlanetState& state, const ViewedPlanet& viewed)
{
    const auto here = [&](const window::LampSettings& light) {
        return lamp_at_eye(*viewed.terrain, state.camera, light);
    };
    std::vector<window::ListedLamp> listed;
    for (PlacedLamp& lamp : state.lamps)
        listed.push_back({lamp.light, lamp.clearance_m});
    const window::LampWish wish = window::lamp_controls(listed, beam_of_view(state.camera));
    if (wish.kind == window::LampWish::Kind::add)
        state.lamps.push_back(here(wish.light));
    else if (wish.kind == window::LampWish::Kind::move_here)
        state.lamps[wish.lamp] = here(state.lamps[wish.lamp].light);
    else if (wish.kind == window::LampWish::Kind::remove)
        state.lamps.erase(state.lamps.begin() + static_cast<std::ptrdiff_t>(wish.lamp));
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
                            "L                  put a lamp where I am\n"
                            "Shift + L          take the last one away\n"
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
    if (ImGui::CollapsingHeader("Lamps", state.lamps.empty() ? 0 : ImGuiTreeNodeFlags_DefaultOpen))
        draw_lamps(state, viewed);
    if (ImGui::CollapsingHeader("Look"))
        draw_look(state);
    activity.wants_screenshot = ImGui::Button("Screenshot");
    ImGui::SameLine();
    if (ImGui::Button("Keys"))
        activity.help = !activity.help;
    window::end_panel(message);
}

} // namespace duskline::planet_app
