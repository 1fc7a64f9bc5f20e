#include "lamp_settings.h"

#include "colour_text.h"
#include "exit_code.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <vector>

namespace duskline::window {
namespace {

using cli::UsageError;

// A number of a lamp: its range, how it is taken, and its value as a text.
struct LampNumber {
    const char* name;
    cli::Range range;
    void (*set)(LampSettings& lamp, double value);
    std::string (*text)(const LampSettings& lamp);
};

const std::array kBeam = {
    LampNumber{"the azimuth",
               {.least = -360.0, .most = 360.0},
               [](auto& lamp, double value) { lamp.beam->azimuth = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees_text(lamp.beam->azimuth); }},
    LampNumber{"the altitude",
               {.least = -90.0, .most = 90.0},
               [](auto& lamp, double value) { lamp.beam->altitude = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees_text(lamp.beam->altitude); }},
    LampNumber{"the half angle",
               {.least = 0.5, .most = 179.0},
               [](auto& lamp, double value) { lamp.beam->half_angle = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees_text(lamp.beam->half_angle); }},
};

// What may be said by name besides the colour.
const std::array kNamed = {
    LampNumber{"strength",
               {.least = 0.0, .most = 1e6, .above = true},
               [](auto& lamp, double value) { lamp.strength = value; },
               [](auto& lamp) { return fmt::format("{:g}", lamp.strength); }},
    LampNumber{"reach",
               {.least = 0.01, .most = 1e4},
               [](auto& lamp, double value) { lamp.reach_m = value; },
               [](auto& lamp) { return metres_text(lamp.reach_m); }},
    LampNumber{"range",
               {.least = 1.0, .most = 1e7},
               [](auto& lamp, double value) { lamp.range_m = value; },
               [](auto& lamp) { return metres_text(lamp.range_m); }},
    LampNumber{"edge",
               {.least = 0.0, .most = 1.0},
               [](auto& lamp, double value) { lamp.soft_edge = value; },
               [](auto& lamp) { return fmt::format("{:g}", lamp.soft_edge); }},
};
constexpr auto kColour = "colour";

using Parts = std::vector<std::string>;

Parts parts_of(const std::string& typed)
{
    Parts parts;
    std::istringstream text(typed);
    for (std::string part; std::getline(text, part, ',');)
        parts.push_back(part);
    return parts;
}

void take(const std::string& option, const LampNumber& number, const std::string& typed, LampSettings& lamp)
{
    number.set(lamp, cli::parse_number(fmt::format("{} of {}", number.name, option), typed, number.range));
}

void take_named(const std::string& option, const std::string& part, LampSettings& lamp)
{
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const auto* known = std::ranges::find_if(kNamed, [&](const LampNumber& it) { return it.name == name; });
    if (equals != std::string::npos && (name == kColour || name == "color"))
        lamp.colour = cli::parse_colour("the colour of " + option, value);
    else if (equals != std::string::npos && known != kNamed.end())
        take(option, *known, value, lamp);
    else
        throw UsageError(
            fmt::format("{} has no '{}'; there are: strength, reach, range, edge and colour, each "
                        "as NAME=VALUE",
                        option, part));
}

void require_count(const Parts& parts, std::size_t count, const std::string& option, const std::string& right,
                   const std::string& typed)
{
    const bool enough =
        parts.size() >= count
        && std::none_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                        [](const std::string& part) { return part.find('=') != std::string::npos; });
    if (!enough)
        throw UsageError(fmt::format("{} must be {}, got '{}'", option, right, typed));
}

// What follows the numbers of the place: those of `beam`, then names.
TypedLamp parse(TypedLamp lamp, std::span<const LampNumber> beam, const std::string& right,
                const std::string& typed)
{
    const Parts parts = parts_of(typed);
    const std::size_t numbers = lamp.place.size() + beam.size();
    require_count(parts, numbers, lamp.option, right, typed);
    std::copy_n(parts.begin(), lamp.place.size(), lamp.place.begin());
    for (std::size_t i = 0; i < beam.size(); ++i)
        take(lamp.option, beam[i], parts[lamp.place.size() + i], lamp.light);
    for (std::size_t i = numbers; i < parts.size(); ++i)
        take_named(lamp.option, parts[i], lamp.light);
    return lamp;
}

std::string lamp_form(const LampPlaceForm& form)
{
    return fmt::format("{}[,NAME=VALUE...]", form.numbers);
}

std::string searchlight_form(const LampPlaceForm& form)
{
    return fmt::format("{},AZIMUTH,ALTITUDE,HALF_ANGLE[,NAME=VALUE...]", form.numbers);
}

using ParseLamp = TypedLamp (*)(const LampPlaceForm& form, const std::string& typed);

CLI::Option* add_option(CLI::App& app, const LampPlaceForm& form, const std::string& name, ParseLamp parse,
                        const std::string& text, const std::function<void(const TypedLamp&)>& take)
{
    const auto take_all = [form, parse, take](const std::vector<std::string>& all) {
        for (const std::string& typed : all)
            take(parse(form, typed));
    };
    return app.add_option_function<std::vector<std::string>>(name, take_all, text)->allow_extra_args(false);
}

} // namespace

LampSettings usual_lamp()
{
    return {};
}

LampSettings usual_searchlight(const LampBeam& beam)
{
    return {.beam = beam, .reach_m = 1000.0, .range_m = 20000.0};
}

SceneLamp scene_lamp(const LampSettings& lamp, const Vector3& position_m, const Vector3& beam_direction)
{
    SceneLamp scene;
    scene.position_m = position_m;
    if (lamp.beam) {
        scene.direction = beam_direction;
        scene.half_angle = lamp.beam->half_angle;
    }
    scene.soft_edge = lamp.soft_edge;
    scene.colour = {lamp.colour.red, lamp.colour.green, lamp.colour.blue};
    scene.bright_m = lamp.reach_m * std::sqrt(lamp.strength);
    scene.range_m = lamp.range_m;
    return scene;
}

void add_lamp_options(CLI::App& app, const LampPlaceForm& form, const std::string& group,
                      const std::function<void(const TypedLamp&)>& take)
{
    add_option(
        app, form, "--lamp", &parse_lamp,
        fmt::format("a lamp {}, with shadows from depth maps, and by commas what is not strength=1 (in "
                    "suns, at its reach; it falls with the square of distance), reach=100 (metres), "
                    "range=5000 (metres, beyond which it lights nothing), colour=#ffffff; may be "
                    "repeated",
                    form.text),
        take)
        ->type_name(lamp_form(form))
        ->group(group);
    add_option(app, form, "--searchlight", &parse_searchlight,
               "a lamp with a beam: its azimuth, its altitude over the horizontal and the angle from its "
               "middle to its border, degrees; as --lamp, but reach=1000, range=20000, and edge=0.2 (share "
               "of that angle in which the beam fades)",
               take)
        ->type_name(searchlight_form(form))
        ->group(group);
}

TypedLamp parse_lamp(const LampPlaceForm& form, const std::string& typed)
{
    const std::string right = fmt::format("{} such as {},strength=4", lamp_form(form), form.example);
    return parse({"--lamp", {}, usual_lamp()}, {}, right, typed);
}

TypedLamp parse_searchlight(const LampPlaceForm& form, const std::string& typed)
{
    const std::string right = fmt::format("{} such as {},220,-5,8", searchlight_form(form), form.example);
    return parse({"--searchlight", {}, usual_searchlight({})}, kBeam, right, typed);
}

std::string option_of(const std::string& place, const LampSettings& lamp)
{
    std::string text = fmt::format("{} {}", lamp.beam ? "--searchlight" : "--lamp", place);
    if (lamp.beam)
        for (const LampNumber& number : kBeam)
            text += "," + number.text(lamp);
    const LampSettings usual = lamp.beam ? usual_searchlight(*lamp.beam) : usual_lamp();
    for (const LampNumber& number : kNamed)
        if (number.text(lamp) != number.text(usual))
            text += fmt::format(",{}={}", number.name, number.text(lamp));
    if (cli::text_of(lamp.colour) != cli::text_of(usual.colour))
        text += fmt::format(",{}={}", kColour, cli::text_of(lamp.colour));
    return text;
}

void require_lamps_fit(std::size_t lamps)
{
    if (lamps > kMostLamps)
        throw UsageError(
            fmt::format("at most {} lamps and searchlights may shine, got {}", kMostLamps, lamps));
}

std::string degrees_text(Angle angle)
{
    return fmt::format("{}", std::round(1e6 * angle.degrees()) / 1e6);
}

std::string metres_text(double value_m)
{
    return fmt::format("{}", std::round(100.0 * value_m) / 100.0);
}

} // namespace duskline::window
