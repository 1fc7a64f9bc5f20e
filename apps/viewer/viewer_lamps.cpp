#include "viewer_lamps.h"

#include "colour_text.h"
#include "exit_code.h"
#include "option_values.h"
#include "viewer_files.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/map_place.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/view/camera.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace duskline::viewer {
namespace {

using cli::UsageError;

// A kind of option, and how many numbers come first.
struct LampOption {
    const char* name;
    std::size_t numbers;
    const char* right;
    SceneLamp usual;
};

LampOption lamp_option()
{
    return {"--lamp", 3, "X,Y,Z[,NAME=VALUE...] such as 243500,2193200,+30,reach=300", usual_lamp()};
}

LampOption searchlight_option()
{
    return {"--searchlight", 6,
            "X,Y,Z,AZIMUTH,ALTITUDE,HALF_ANGLE[,NAME=VALUE...] such as 243500,2193200,+30,120,-10,8",
            usual_searchlight()};
}

// What was typed, its place still on the map.
struct TypedLamp {
    double x = 0.0;
    double y = 0.0;
    double z_m = 0.0;
    bool above_ground = false;
    SceneLamp light;
};

std::vector<std::string> parts_of(const std::string& typed)
{
    std::vector<std::string> parts;
    std::istringstream text(typed);
    for (std::string part; std::getline(text, part, ',');)
        parts.push_back(part);
    return parts;
}

struct NamedNumber {
    const char* name;
    double SceneLamp::*value;
};
constexpr std::array kNamed = {NamedNumber{"reach", &SceneLamp::bright_m},
                               NamedNumber{"range", &SceneLamp::range_m},
                               NamedNumber{"edge", &SceneLamp::soft_edge}};

void take_named(const LampOption& option, const std::string& part, SceneLamp& lamp)
{
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    if (equals != std::string::npos && name == "colour") {
        const Colour colour =
            cli::parse_colour(fmt::format("colour of {}", option.name), part.substr(equals + 1));
        lamp.colour = {colour.red, colour.green, colour.blue};
        return;
    }
    const auto* known =
        std::ranges::find_if(kNamed, [&](const NamedNumber& number) { return name == number.name; });
    if (equals == std::string::npos || known == kNamed.end())
        throw UsageError(
            fmt::format("{} has no '{}'; there are: reach, range, edge and colour, each as NAME=VALUE",
                        option.name, part));
    lamp.*(known->value) =
        cli::parse_number(fmt::format("{} of {}", name, option.name), part.substr(equals + 1));
}

void take_beam(const LampOption& option, const std::vector<double>& numbers, SceneLamp& lamp)
{
    if (!(std::abs(numbers[4]) <= 90.0))
        throw UsageError(
            fmt::format("the altitude of {} must be -90 to 90 degrees, got {}", option.name, numbers[4]));
    lamp.direction = beam_towards(Angle::from_degrees(numbers[3]), Angle::from_degrees(numbers[4]));
    lamp.half_angle = Angle::from_degrees(numbers[5]);
}

TypedLamp parse(const LampOption& option, const std::string& typed)
{
    const std::vector<std::string> parts = parts_of(typed);
    if (parts.size() < option.numbers)
        throw UsageError(fmt::format("{} must be {}, got '{}'", option.name, option.right, typed));
    std::vector<double> numbers;
    for (std::size_t i = 0; i < option.numbers; ++i)
        numbers.push_back(cli::parse_number(option.name, parts[i]));
    TypedLamp lamp = {numbers[0], numbers[1], numbers[2], parts[2].starts_with('+'), option.usual};
    if (option.numbers > 3)
        take_beam(option, numbers, lamp.light);
    for (std::size_t i = option.numbers; i < parts.size(); ++i)
        take_named(option, parts[i], lamp.light);
    try {
        require_valid(lamp.light);
    } catch (const InvalidInput& error) {
        throw UsageError(fmt::format("{} {}: {}", option.name, typed, error.what()));
    }
    return lamp;
}

ViewerLamp place(const LampOption& option, const std::string& typed, const ViewedTerrain& viewed)
{
    const TypedLamp lamp = parse(option, typed);
    const GridPlace at = grid_place(viewed.file.facts(), lamp.x, lamp.y);
    const HeightField seen = viewed.ground->terrain();
    const std::optional<double> ground_m = ground_height_m(seen, at.row, at.column);
    const std::optional<double> at_rest_m = ground_height_m(viewed.ground->at_rest(), at.row, at.column);
    if (!ground_m || !at_rest_m)
        throw UsageError(fmt::format(
            "{} {}: there is no ground at that place (outside the raster, or no data)", option.name, typed));
    // Over the ground as it is seen, lowered by the earth's curvature.
    const double over_m = lamp.above_ground ? lamp.z_m : lamp.z_m - viewed.file.facts().base_m - *at_rest_m;
    ViewerLamp placed = {lamp.light};
    placed.light.position_m = position_m({at.row, at.column, *ground_m + over_m}, seen.cell_size_m);
    return placed;
}

} // namespace

std::vector<SceneLamp> shining(std::span<const ViewerLamp> lamps)
{
    std::vector<SceneLamp> on;
    for (const ViewerLamp& lamp : lamps)
        if (lamp.on)
            on.push_back(lamp.light);
    return on;
}

SceneLamp usual_lamp()
{
    return {.bright_m = 300.0, .range_m = 20000.0};
}

SceneLamp usual_searchlight()
{
    return {.half_angle = Angle::from_degrees(8.0), .bright_m = 2000.0, .range_m = 50000.0};
}

Vector3 beam_towards(Angle azimuth, Angle altitude)
{
    const auto [east, north] = sine_cosine(azimuth);
    const auto [up, ahead] = sine_cosine(altitude);
    return {east * ahead, north * ahead, up};
}

BeamAngles angles_of_beam(const SceneLamp& lamp)
{
    const auto [x, y, z] = lamp.direction;
    return {wrapped_to_circle(Angle::from_radians(std::atan2(x, y))),
            Angle::from_radians(std::atan2(z, std::hypot(x, y)))};
}

ViewerLamp typed_lamp(const std::string& typed, const ViewedTerrain& viewed)
{
    return place(lamp_option(), typed, viewed);
}

ViewerLamp typed_searchlight(const std::string& typed, const ViewedTerrain& viewed)
{
    return place(searchlight_option(), typed, viewed);
}

void require_lamp(const std::string& typed)
{
    parse(lamp_option(), typed);
}

void require_searchlight(const std::string& typed)
{
    parse(searchlight_option(), typed);
}

std::string lamp_settings_help()
{
    const SceneLamp lamp = usual_lamp();
    const SceneLamp beam = usual_searchlight();
    return fmt::format("reach={:g} (metres, where it is as bright as the sun; searchlights {:g}), range={:g} "
                       "(metres, beyond which it lights nothing; {:g}), edge={:g} (share of a beam that "
                       "fades), colour=#ffffff",
                       lamp.bright_m, beam.bright_m, lamp.range_m, beam.range_m, beam.soft_edge);
}

} // namespace duskline::viewer
