#include "panel.h"

#include "lamp_controls.h"
#include "panel_parts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

namespace duskline::viewer {
namespace {

using window::slider;
using window::text;

void draw_light(ViewerState& state, Activity& activity, const SunClock& clock)
{
    bool turned = slider("Azimuth", state.light.azimuth_deg, 0.0, 360.0, "%.1f");
    turned = slider("Altitude", state.light.altitude_deg, -5.0, 90.0, "%.1f") || turned;
    if (turned)
        state.light.time = std::nullopt;
    if (!clock.knows_times())
        return;
    window::clock_controls(state.light.time, activity.clock_runs, state.clock_s_per_s);
    clock.bring_up_to_date(state.light);
}

void draw_shadows(ViewerState& state, Activity& activity, double done)
{
    if (ImGui::BeginCombo("Technique", state.technique.c_str())) {
        for (const gl::ShadowTechniqueKind& kind : gl::shadow_techniques()) {
            const std::string name(kind.name);
            if (ImGui::Selectable(name.c_str(), name == state.technique))
                state.technique = name;
            if (ImGui::IsItemHovered())
                ImGui::SetTooltip("%s", std::string(kind.description).c_str());
        }
        ImGui::EndCombo();
    }
    if (gl::shadow_technique_named(state.technique).has_soft_edges)
        ImGui::Checkbox("Soft edges", &state.soft);
    if (gl::shadow_technique_named(state.technique).follows_course) {
        int maps = static_cast<int>(state.light_maps);
        ImGui::SliderInt("Shadow maps", &maps, 2, 48);
        state.light_maps = static_cast<std::size_t>(std::clamp(maps, 2, 96));
    }
    if (done < 1.0)
        text(fmt::format("{:.0f} % of the shadows made", 100.0 * done));
    if (state.technique == window::kShadowMapTechnique)
        window::shadow_map_controls(state.shadow_map.options, state.shadow_map.look);
    ImGui::Checkbox("Mark what is wrong", &state.difference);
    ImGui::SameLine();
    activity.wants_count = ImGui::SmallButton("Count");
    if (activity.counted)
        text(fmt::format("{} of {} cells wrong ({:.4f} %)\n{} lit, {} dark", activity.counted->differing,
                         activity.counted->cells,
                         100.0 * static_cast<double>(activity.counted->differing)
                             / static_cast<double>(std::max<std::size_t>(1, activity.counted->cells)),
                         activity.counted->false_light, activity.counted->false_shadow));
    if (activity.black_share)
        text(fmt::format("{:.2f} % of the silhouette map is Black", 100.0 * *activity.black_share));
}

void draw_lamps(ViewerState& state)
{
    std::vector<window::ListedLamp> listed;
    for (ViewerLamp& lamp : state.lamps)
        listed.push_back({lamp.light, lamp.position_m.z});
    const window::LampWish wish = window::lamp_controls(listed, beam_of_view(state.camera));
    if (wish.kind == window::LampWish::Kind::add)
        state.lamps.push_back({state.camera.position_m, wish.light});
    else if (wish.kind == window::LampWish::Kind::move_here)
        state.lamps[wish.lamp].position_m = state.camera.position_m;
    else if (wish.kind == window::LampWish::Kind::remove)
        state.lamps.erase(state.lamps.begin() + static_cast<std::ptrdiff_t>(wish.lamp));
}

void draw_look(ViewerState& state)
{
    ImGui::SliderFloat("Ambient", &state.ambient, 0.0f, 0.9f, "%.2f");
    ImGui::SliderFloat("Exposure", &state.exposure, 0.25f, 4.0f, "%.2f", ImGuiSliderFlags_Logarithmic);
    ImGui::SliderFloat("Relief", &state.exaggeration, 0.5f, 6.0f, "%.2f");
    slider("Mesh error, px", state.pixel_error, 0.5, 10.0, "%.1f");
    double view_deg = state.camera.vertical_view.degrees();
    if (slider("Field of view", view_deg, 10.0, 100.0, "%.0f"))
        state.camera.vertical_view = Angle::from_degrees(view_deg);
}

void draw_flight(Activity& activity)
{
    if (ImGui::Button(activity.records ? "Stop" : "Record")) {
        activity.records = !activity.records;
        if (activity.records)
            activity.flight.poses.clear();
    }
    ImGui::SameLine();
    if (ImGui::Button(activity.replays ? "Halt" : "Fly")) {
        activity.replays = !activity.replays && !activity.records;
        activity.replayed = 0.0;
    }
    ImGui::SameLine();
    activity.wants_flight_saved = ImGui::Button("Save flight") && !activity.flight.poses.empty();
    ImGui::SameLine();
    text(fmt::format("{} poses", activity.flight.poses.size()));
}

void draw_brush(Brush& brush)
{
    int effect = static_cast<int>(brush.effect);
    if (ImGui::Combo("Brush", &effect, "raise\0lower\0smooth\0"))
        brush.effect = static_cast<BrushEffect>(effect);
    slider("Radius, m", brush.radius_m, 10.0, 20000.0, "%.0f");
    if (brush.effect == BrushEffect::smooth)
        slider("Smoothing", brush.smoothing, 0.0, 1.0, "%.2f");
    else
        slider("m a second", brush.amount_m, 1.0, 5000.0, "%.0f");
    text("Hold Ctrl and drag over the ground");
}

void draw_motion(ViewerState& state)
{
    const auto entry = [&](std::string_view name, std::string_view description) {
        if (ImGui::Selectable(std::string(name).c_str(), name == state.animation)) {
            state.animation = name;
            state.animation_s = 0.0;
        }
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", std::string(description).c_str());
    };
    if (ImGui::BeginCombo("Animation", state.animation.c_str())) {
        entry(kNoMotion, "the ground keeps still");
        for (const GroundMotionKind& kind : ground_motions())
            entry(kind.name, kind.description);
        ImGui::EndCombo();
    }
    slider("Speed", state.animation_speed, 0.0, 4.0, "%.2f");
    ImGui::Checkbox("Trees, towers, aircraft, clouds", &state.objects);
}

void draw_figures(const FrameFigures& figures)
{
    text(fmt::format("{:7.2f} ms a frame ({:.0f} a second)", figures.frame_ms,
                     1000.0 / std::max(0.01, figures.frame_ms)));
    if (figures.ground_ms > 0.0)
        text(fmt::format("{:7.2f} ms for ground that changed", figures.ground_ms));
    text(fmt::format("{:7.2f} ms to find shadows; {:.2f} on the card", figures.cast_ms, figures.cast_gpu_ms));
    text(fmt::format("{:7.2f} ms to draw and look up, on the card", figures.draw_gpu_ms));
    text(fmt::format("{} patches, {} triangles", figures.mesh.patches, figures.mesh.triangles));
}

void draw_help(bool& open)
{
    window::show_keys(open, "Left drag          turn around what the pointer is on\n"
                            "Shift + left drag  move the sun\n"
                            "Ctrl + left drag   raise, lower or smooth the ground\n"
                            "Right drag         look elsewhere\n"
                            "Middle drag        move sideways\n"
                            "Wheel              nearer, farther\n"
                            "W A S D, Q E       fly; with Shift faster\n"
                            "Home               the whole terrain\n"
                            "Tab                next technique\n"
                            "X                  mark what is wrong\n"
                            "M                  let the ground move, the next way\n"
                            "O                  trees, towers, an aircraft, clouds\n"
                            "Space              let the clock run\n"
                            "R                  record a flight, stop\n"
                            "F1                 these keys\n"
                            "F2                 save the state\n"
                            "F5                 read changed shaders\n"
                            "F10                hide the panel\n"
                            "F12                screenshot\n"
                            "Escape             leave");
}

} // namespace

void draw_panel(ViewerState& state, Activity& activity, const SunClock& clock, const FrameFigures& figures,
                const std::string& message)
{
    if (activity.help)
        draw_help(activity.help);
    if (!activity.panel)
        return;
    window::begin_panel();
    draw_figures(figures);
    if (ImGui::CollapsingHeader("Light", ImGuiTreeNodeFlags_DefaultOpen))
        draw_light(state, activity, clock);
    if (ImGui::CollapsingHeader("Shadows", ImGuiTreeNodeFlags_DefaultOpen))
        draw_shadows(state, activity, figures.done);
    if (ImGui::CollapsingHeader("Lamps"))
        draw_lamps(state);
    if (ImGui::CollapsingHeader("Look"))
        draw_look(state);
    if (ImGui::CollapsingHeader("Flight"))
        draw_flight(activity);
    if (ImGui::CollapsingHeader("Motion"))
        draw_motion(state);
    if (ImGui::CollapsingHeader("Ground"))
        draw_brush(activity.brush);
    activity.wants_screenshot = ImGui::Button("Screenshot");
    ImGui::SameLine();
    activity.wants_state_saved = ImGui::Button("Save state");
    ImGui::SameLine();
    activity.wants_overview = ImGui::Button("Whole");
    ImGui::SameLine();
    if (ImGui::Button("Keys"))
        activity.help = !activity.help;
    window::end_panel(message);
}

} // namespace duskline::viewer
