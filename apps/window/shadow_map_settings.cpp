#include "shadow_map_settings.h"

#include "exit_code.h"

#include <duskline/geometry/invalid_input.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

namespace duskline::window {
namespace {

// As typed, in the order of their types.
constexpr const char* kFilterNames[] = {"none", "kernels", "disc", "moments"};
constexpr const char* kOverlayNames[] = {"none", "kernels", "fade", "penumbra", "box"};

[[noreturn]] void refuse(const std::string& name, const std::string& value, const std::string& right)
{
    throw InvalidInput(fmt::format("the shadow map's {} must be {}, got '{}'", name, right, value));
}

double number(const std::string& name, const std::string& value, double low, double high)
{
    double result = 0.0;
    const char* end = value.data() + value.size();
    const auto [stopped, error] = std::from_chars(value.data(), end, result);
    if (error != std::errc() || stopped != end || !(result >= low && result <= high))
        refuse(name, value, fmt::format("{} to {}", low, high));
    return result;
}

std::size_t count(const std::string& name, const std::string& value, double low, double high)
{
    const double result = number(name, value, low, high);
    if (result != static_cast<double>(static_cast<std::size_t>(result)))
        refuse(name, value, "a whole number");
    return static_cast<std::size_t>(result);
}

template <typename Choice, std::size_t kCount>
Choice choice(const std::string& name, const std::string& value, const char* const (&names)[kCount])
{
    const auto* found = std::find(std::begin(names), std::end(names), value);
    if (found == std::end(names))
        refuse(name, value, fmt::format("one of {}", fmt::join(names, ", ")));
    return static_cast<Choice>(found - std::begin(names));
}

constexpr const char* kOffOn[] = {"off", "on"};
constexpr const char* kFaceNames[] = {"all", "away"};

// A setting: how it is read, and its value as a text.
struct Setting {
    const char* name;
    void (*read)(ShadowMapSettings& settings, const std::string& name, const std::string& value);
    std::string (*text)(const ShadowMapSettings& settings);
};

const std::array kSettings = {
    Setting{"size", [](auto& s, auto& n, auto& v) { s.options.size = count(n, v, 64, 16384); },
            [](auto& s) { return fmt::format("{}", s.options.size); }},
    Setting{
        "filter",
        [](auto& s, auto& n, auto& v) { s.options.filter = choice<gl::ShadowMapFilter>(n, v, kFilterNames); },
        [](auto& s) -> std::string { return kFilterNames[static_cast<std::size_t>(s.options.filter)]; }},
    Setting{"linear",
            [](auto& s, auto& n, auto& v) { s.options.linear_compare = choice<int>(n, v, kOffOn) == 1; },
            [](auto& s) -> std::string { return kOffOn[s.options.linear_compare ? 1 : 0]; }},
    Setting{"penumbra",
            [](auto& s, auto& n, auto& v) { s.options.penumbra_only = choice<int>(n, v, kOffOn) == 1; },
            [](auto& s) -> std::string { return kOffOn[s.options.penumbra_only ? 1 : 0]; }},
    Setting{"samples", [](auto& s, auto& n, auto& v) { s.options.samples = count(n, v, 4, 16); },
            [](auto& s) { return fmt::format("{}", s.options.samples); }},
    Setting{"spread", [](auto& s, auto& n, auto& v) { s.options.spread = number(n, v, 0.01, 10); },
            [](auto& s) { return fmt::format("{}", s.options.spread); }},
    Setting{"offset", [](auto& s, auto& n, auto& v) { s.options.slope_offset = number(n, v, 0, 100); },
            [](auto& s) { return fmt::format("{}", s.options.slope_offset); }},
    Setting{"faces",
            [](auto& s, auto& n, auto& v) { s.options.faces = choice<gl::CasterFaces>(n, v, kFaceNames); },
            [](auto& s) -> std::string { return kFaceNames[static_cast<std::size_t>(s.options.faces)]; }},
    Setting{"reach", [](auto& s, auto& n, auto& v) { s.options.reach = number(n, v, 1, 1000); },
            [](auto& s) { return fmt::format("{}", s.options.reach); }},
    Setting{"wide", [](auto& s, auto& n, auto& v) { s.options.wide_reach = number(n, v, 0, 10000); },
            [](auto& s) { return fmt::format("{}", s.options.wide_reach); }},
    Setting{"overcast", [](auto& s, auto& n, auto& v) { s.look.overcast = number(n, v, 0, 1); },
            [](auto& s) { return fmt::format("{}", s.look.overcast); }},
    Setting{
        "overlay",
        [](auto& s, auto& n, auto& v) { s.look.overlay = choice<gl::ShadowMapOverlay>(n, v, kOverlayNames); },
        [](auto& s) -> std::string { return kOverlayNames[static_cast<std::size_t>(s.look.overlay)]; }},
};

} // namespace

ShadowMapSettings parse_shadow_map(const std::string& text)
{
    ShadowMapSettings settings;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::size_t equals = part.find('=');
        const std::string name = part.substr(0, equals);
        const auto* setting =
            std::ranges::find_if(kSettings, [&](const Setting& s) { return s.name == name; });
        if (setting == kSettings.end() || equals == std::string::npos)
            throw InvalidInput(
                fmt::format("a shadow map has no setting '{}'; there are: {}", part, shadow_map_help()));
        setting->read(settings, name, part.substr(equals + 1));
    }
    if (settings.options.wide_reach != 0.0 && settings.options.wide_reach <= settings.options.reach)
        throw InvalidInput(fmt::format("the shadow map's wide reach must be above its reach of {}, got {}",
                                       settings.options.reach, settings.options.wide_reach));
    return settings;
}

ShadowMapSettings parse_shadow_map_option(const std::string& typed)
{
    try {
        return parse_shadow_map(typed);
    } catch (const InvalidInput& error) {
        throw cli::UsageError(std::string("--shadow-map: ") + error.what());
    }
}

std::string text_of(const ShadowMapSettings& settings)
{
    const ShadowMapSettings usual;
    std::string text;
    for (const Setting& setting : kSettings)
        if (setting.text(settings) != setting.text(usual))
            text += fmt::format("{}{}={}", text.empty() ? "" : ",", setting.name, setting.text(settings));
    return text;
}

std::string shadow_map_help()
{
    return "size=4096, filter=kernels (none, disc, moments), linear=on, penumbra=off, samples=8, spread=1, "
           "offset=1, faces=all (away), reach=12, wide=0, overcast=0, overlay=none (kernels, fade, penumbra, "
           "box)";
}

} // namespace duskline::window
