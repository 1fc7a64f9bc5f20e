#include "lamp_text.h"

#include "colour_text.h"
#include "exit_code.h"
#include "option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <vector>

namespace duskline::planet_app {
namespace {

using cli::UsageError;

constexpr auto kLamp = "--lamp";
constexpr auto kSearchlight = "--searchlight";

// A number of a lamp: its range, how it is taken, and its value as a text.
struct LampNumber {
    const char* name;
    cli::Range range;
    void (*set)(PlacedLamp& lamp, double value);
    std::string (*text)(const PlacedLamp& lamp);
};

// As many digits as say where something is to a decimetre, and no zeros after them.
std::string degrees(Angle angle)
{
    return fmt::format("{}", std::round(1e6 * angle.degrees()) / 1e6);
}
std::string metres(double value)
{
    return fmt::format("{}", std::round(100.0 * value) / 100.0);
}

const std::array kPlace = {
    LampNumber{"the longitude",
               {.least = -180.0, .most = 360.0},
               [](auto& lamp, double value) { lamp.place.longitude = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees(lamp.place.longitude); }},
    LampNumber{"the latitude",
               {.least = -90.0, .most = 90.0},
               [](auto& lamp, double value) { lamp.place.latitude = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees(lamp.place.latitude); }},
    LampNumber{"the height over the ground",
               {.least = 0.1, .most = 1e7},
               [](auto& lamp, double value) { lamp.clearance_m = value; },
               [](auto& lamp) { return metres(lamp.clearance_m); }},
};

const std::array kBeam = {
    LampNumber{"the azimuth",
               {.least = -360.0, .most = 360.0},
               [](auto& lamp, double value) { lamp.beam->azimuth = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees(lamp.beam->azimuth); }},
    LampNumber{"the altitude",
               {.least = -90.0, .most = 90.0},
               [](auto& lamp, double value) { lamp.beam->altitude = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees(lamp.beam->altitude); }},
    LampNumber{"the half angle",
               {.least = 0.1, .most = 179.0},
               [](auto& lamp, double value) { lamp.beam->half_angle = Angle::from_degrees(value); },
               [](auto& lamp) { return degrees(lamp.beam->half_angle); }},
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
               [](auto& lamp) { return metres(lamp.reach_m); }},
    LampNumber{"range",
               {.least = 1.0, .most = 1e7},
               [](auto& lamp, double value) { lamp.range_m = value; },
               [](auto& lamp) { return metres(lamp.range_m); }},
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

void take(const std::string& option, const LampNumber& number, const std::string& typed, PlacedLamp& lamp)
{
    const std::string name = fmt::format("{} of {}", number.name, option);
    const double value = cli::parse_number(name, typed);
    const bool high_enough = number.range.above ? value > number.range.least : value >= number.range.least;
    if (!(high_enough && value <= number.range.most))
        throw UsageError(fmt::format("{} must be {} {} to {}, got {}", name,
                                     number.range.above ? "above" : "from", number.range.least,
                                     number.range.most, value));
    number.set(lamp, value);
}

void take_named(const std::string& option, const std::string& part, PlacedLamp& lamp)
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

void take_all(const std::string& option, const Parts& parts, std::span<const LampNumber> first,
              std::size_t from, PlacedLamp& lamp)
{
    for (std::size_t i = 0; i < first.size(); ++i)
        take(option, first[i], parts[from + i], lamp);
}

void require_count(const std::string& option, const Parts& parts, std::size_t count, const char* right,
                   const std::string& typed)
{
    const bool enough =
        parts.size() >= count
        && std::none_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                        [](const std::string& part) { return part.find('=') != std::string::npos; });
    if (!enough)
        throw UsageError(fmt::format("{} must be {}, got '{}'", option, right, typed));
}

void add_named(std::string& text, const PlacedLamp& lamp, const PlacedLamp& usual)
{
    for (const LampNumber& number : kNamed)
        if (number.text(lamp) != number.text(usual))
            text += fmt::format(",{}={}", number.name, number.text(lamp));
    if (cli::text_of(lamp.colour) != cli::text_of(usual.colour))
        text += fmt::format(",{}={}", kColour, cli::text_of(lamp.colour));
}

std::string joined(std::span<const LampNumber> numbers, const PlacedLamp& lamp)
{
    std::string text;
    for (const LampNumber& number : numbers)
        text += (text.empty() ? "" : ",") + number.text(lamp);
    return text;
}

} // namespace

PlacedLamp parse_lamp(const std::string& typed)
{
    const Parts parts = parts_of(typed);
    require_count(kLamp, parts, kPlace.size(),
                  "LON,LAT,HEIGHT[,NAME=VALUE...] such as -155.62,20.1,30,strength=4", typed);
    PlacedLamp lamp = usual_lamp({}, 0.0);
    take_all(kLamp, parts, kPlace, 0, lamp);
    for (std::size_t i = kPlace.size(); i < parts.size(); ++i)
        take_named(kLamp, parts[i], lamp);
    return lamp;
}

PlacedLamp parse_searchlight(const std::string& typed)
{
    const Parts parts = parts_of(typed);
    const std::size_t count = kPlace.size() + kBeam.size();
    require_count(kSearchlight, parts, count,
                  "LON,LAT,HEIGHT,AZIMUTH,ALTITUDE,HALF_ANGLE[,NAME=VALUE...] such as "
                  "-155.62,20.1,30,220,-5,8",
                  typed);
    PlacedLamp lamp = usual_searchlight({}, 0.0, {});
    take_all(kSearchlight, parts, kPlace, 0, lamp);
    take_all(kSearchlight, parts, kBeam, kPlace.size(), lamp);
    for (std::size_t i = count; i < parts.size(); ++i)
        take_named(kSearchlight, parts[i], lamp);
    return lamp;
}

std::string option_of(const PlacedLamp& lamp)
{
    std::string text = fmt::format("{} {}", lamp.beam ? kSearchlight : kLamp, joined(kPlace, lamp));
    if (lamp.beam)
        text += "," + joined(kBeam, lamp);
    add_named(text, lamp,
              lamp.beam ? usual_searchlight(lamp.place, lamp.clearance_m, *lamp.beam)
                        : usual_lamp(lamp.place, lamp.clearance_m));
    return text;
}

std::string lamp_help()
{
    return "strength=1 (in suns, at its reach; it falls with the square of distance), reach=100 (metres), "
           "range=5000 (metres, beyond which it lights nothing), colour=#ffffff";
}

std::string searchlight_help()
{
    return "reach=1000, range=20000, and edge=0.2 (share of that angle in which the beam fades)";
}

} // namespace duskline::planet_app
