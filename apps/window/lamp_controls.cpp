#include "lamp_controls.h"

#include "panel_parts.h"

#include <fmt/format.h>

#include <array>

namespace duskline::window {
namespace {

void logarithmic(const char* label, double& value, double least, double most, const char* format)
{
    slider(label, value, least, most, format, ImGuiSliderFlags_Logarithmic);
}

void angle(const char* label, Angle& value, double least, double most)
{
    double degrees = value.degrees();
    if (slider(label, degrees, least, most, "%.1f"))
        value = Angle::from_degrees(degrees);
}

void light_controls(LampSettings& lamp)
{
    logarithmic("Strength", lamp.strength, 0.01, 1000.0, "%.2f suns");
    logarithmic("at", lamp.reach_m, 1.0, 1e4, "%.0f m");
    logarithmic("Range", lamp.range_m, 10.0, 1e6, "%.0f m");
    std::array<float, 3> colour = {lamp.colour.red, lamp.colour.green, lamp.colour.blue};
    if (ImGui::ColorEdit3("Colour", colour.data(), ImGuiColorEditFlags_NoInputs))
        lamp.colour = {colour[0], colour[1], colour[2]};
}

void beam_controls(LampBeam& beam, double& soft_edge, const LampBeam& of_view)
{
    beam.azimuth = wrapped_to_circle(beam.azimuth);
    angle("Azimuth", beam.azimuth, 0.0, 360.0);
    angle("Altitude", beam.altitude, -90.0, 90.0);
    angle("Half angle", beam.half_angle, 0.5, 90.0);
    slider("Soft edge", soft_edge, 0.0, 1.0, "%.2f");
    if (ImGui::Button("Aim where I look"))
        beam = {of_view.azimuth, of_view.altitude, beam.half_angle};
    ImGui::SameLine();
}

LampWish controls_of(const ListedLamp& lamp, std::size_t number, const LampBeam& beam_of_view)
{
    light_controls(lamp.light);
    logarithmic("Height", lamp.height_m, 0.1, 1e5, "%.1f m");
    if (lamp.light.beam)
        beam_controls(*lamp.light.beam, lamp.light.soft_edge, beam_of_view);
    LampWish wish;
    if (ImGui::Button("Move here"))
        wish = {LampWish::Kind::move_here, number};
    ImGui::SameLine();
    if (ImGui::Button("Remove"))
        wish = {LampWish::Kind::remove, number};
    return wish;
}

LampWish new_lamp_buttons(bool room, const LampBeam& beam_of_view)
{
    LampWish wish;
    ImGui::BeginDisabled(!room);
    if (ImGui::Button("Lamp here"))
        wish = {LampWish::Kind::add, 0, usual_lamp()};
    ImGui::SameLine();
    if (ImGui::Button("Searchlight here"))
        wish = {LampWish::Kind::add, 0, usual_searchlight(beam_of_view)};
    ImGui::EndDisabled();
    return wish;
}

} // namespace

LampWish lamp_controls(std::span<const ListedLamp> lamps, const LampBeam& beam_of_view)
{
    LampWish wish = new_lamp_buttons(lamps.size() < kMostLamps, beam_of_view);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        LampSettings& light = lamps[i].light;
        ImGui::PushID(static_cast<int>(i));
        ImGui::Checkbox("##on", &light.on);
        ImGui::SameLine();
        if (ImGui::TreeNode(fmt::format("{} {}", light.beam ? "Searchlight" : "Lamp", i + 1).c_str())) {
            const LampWish its = controls_of(lamps[i], i, beam_of_view);
            if (its.kind != LampWish::Kind::none)
                wish = its;
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    return wish;
}

} // namespace duskline::window
