#include "panel_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace duskline::window {
namespace {

template <typename Enum>
void choice(const char* label, Enum& value, const char* names)
{
    int index = static_cast<int>(value);
    if (ImGui::Combo(label, &index, names))
        value = static_cast<Enum>(index);
}

} // namespace

void begin_panel()
{
    ImGui::SetNextWindowPos({10.0f, 10.0f}, ImGuiCond_FirstUseEver);
    ImGui::Begin("Duskline", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(0.6f * kPanelWidth);
}

void end_panel(const std::string& message)
{
    ImGui::PushTextWrapPos(kPanelWidth);
    if (!message.empty())
        text(message);
    ImGui::PopTextWrapPos();
    ImGui::PopItemWidth();
    ImGui::End();
}

void show_keys(bool& open, const std::string& keys)
{
    if (ImGui::Begin("Keys", &open, ImGuiWindowFlags_AlwaysAutoResize))
        text(keys);
    ImGui::End();
}

void text(const std::string& line)
{
    ImGui::TextUnformatted(line.c_str());
}

bool slider(const char* label, double& value, double least, double most, const char* format,
            ImGuiSliderFlags flags)
{
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format, flags);
}

void clock_controls(std::optional<DateTime>& time, bool& runs, double& seconds_per_second)
{
    using namespace std::chrono;
    if (!time) {
        if (ImGui::Button("By date and time"))
            time = DateTime{floor<microseconds>(system_clock::now())};
        return;
    }
    text(to_iso8601(*time));
    const auto local = time->utc + time->utc_offset;
    const auto midnight = floor<days>(local);
    int minute = static_cast<int>(duration_cast<minutes>(local - midnight).count());
    if (ImGui::SliderInt("Time", &minute, 0, 24 * 60 - 1,
                         fmt::format("{:02}:{:02}", minute / 60, minute % 60).c_str()))
        time->utc = midnight + minutes(minute) - time->utc_offset;
    const auto first_day = sys_days(year_month_day(midnight).year() / January / 1);
    const int today = static_cast<int>((midnight - first_day).count());
    int day = today;
    if (ImGui::SliderInt("Day of year", &day, 0, 364))
        time->utc += days(day - today);
    ImGui::Checkbox("Running", &runs);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110.0f);
    slider("s per s", seconds_per_second, -7200.0, 7200.0, "%.0f");
    if (ImGui::Button("By angles"))
        time = std::nullopt;
}

void shadow_map_controls(gl::ShadowMapOptions& options, gl::ShadowMapLook& look)
{
    constexpr std::array<std::size_t, 4> sizes = {1024, 2048, 4096, 8192};
    int size = static_cast<int>(std::ranges::find(sizes, options.size) - sizes.begin());
    if (ImGui::Combo("Texels a side", &size, "1024\0002048\0004096\0008192\0"))
        options.size = sizes.at(static_cast<std::size_t>(size));
    choice("Filter", options.filter, "one tap\0kernels by distance\0Poisson disc\0moments, separable\0");
    if (options.filter != gl::ShadowMapFilter::moments)
        ImGui::Checkbox("Hardware compares four", &options.linear_compare);
    if (options.filter == gl::ShadowMapFilter::kernels || options.filter == gl::ShadowMapFilter::disc) {
        ImGui::Checkbox("Filter penumbras only", &options.penumbra_only);
        slider("Texels from tap to tap", options.spread, 0.25, 3.0, "%.2f");
    }
    if (options.filter == gl::ShadowMapFilter::disc) {
        int samples = static_cast<int>(options.samples);
        if (ImGui::SliderInt("Samples", &samples, 4, 16))
            options.samples = static_cast<std::size_t>(samples);
    }
    slider("Slope offset", options.slope_offset, 0.0, 8.0, "%.1f");
    choice("Casters", options.faces, "all faces\0reversed winding\0");
    slider("Reach, clearances", options.reach, 2.0, 100.0, "%.0f", ImGuiSliderFlags_Logarithmic);
    bool wide = options.wide_reach > 0.0;
    if (ImGui::Checkbox("Wide map around it", &wide))
        options.wide_reach = wide ? 8.0 * options.reach : 0.0;
    slider("Overcast", look.overcast, 0.0, 1.0, "%.2f");
    choice("Show", look.overlay, "shadows\0kernels\0fade at the border\0penumbras\0the box\0");
}

} // namespace duskline::window
