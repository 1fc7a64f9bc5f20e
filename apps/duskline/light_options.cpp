#include "light_options.h"

#include "exit_code.h"
#include "option_values.h"

#include <fmt/format.h>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";

void require_one_light(const LightOptions& options)
{
    const bool by_angles = options.azimuth_deg || options.altitude_deg;
    if (by_angles && !options.time.empty())
        throw UsageError("give --azimuth and --altitude, or --time, not both");
    if (options.at && options.time.empty())
        throw UsageError("--at says where the sun of --time is seen from: give --time too");
    if (!by_angles && options.time.empty())
        throw UsageError("give the light: --azimuth DEG and --altitude DEG, or --time such as "
                         "2026-06-21T18:30-10:00");
    if (by_angles && !options.azimuth_deg)
        throw UsageError("--altitude needs --azimuth");
    if (by_angles && !options.altitude_deg)
        throw UsageError("--azimuth needs --altitude");
}

} // namespace

void add_light_options(CLI::App& app, LightOptions& options)
{
    add_number(app,
               {.names = "--azimuth",
                .unit = "DEG",
                .text = "towards the light, clockwise from the raster's north; taken modulo 360"},
               options.azimuth_deg)
        ->group(kGroup);
    add_number(app,
               {.names = "--altitude",
                .unit = "DEG",
                .text = "of the light above the horizontal; at or below 0 all is dark",
                .range = {.least = -90.0, .most = 90.0}},
               options.altitude_deg)
        ->group(kGroup);
    app.add_option("--time", options.time,
                   "the sun at this moment, ISO 8601 with its offset from UTC or Z: 2026-06-21T18:30-10:00")
        ->type_name("TIME")
        ->group(kGroup);
    const auto read_place = [&options](const std::string& typed) { options.at = parse_place(typed); };
    app.add_option_function<std::string>(
           "--at", read_place, "place of --time in degrees east and north; else the raster's centre")
        ->type_name("LON,LAT")
        ->group(kGroup);
    add_number(app,
               {.names = "--sun-size",
                .unit = "DEG",
                .text = "diameter of the light's disc",
                .range = {.least = 0.0, .most = 180.0}},
               options.sun_size_deg)
        ->group(kGroup);
}

ChosenLight choose_light(const LightOptions& options, const LightSite&, Report& report)
{
    require_one_light(options);
    if (!options.time.empty())
        throw UsageError("--time is not possible yet: give --azimuth and --altitude");
    ChosenLight chosen;
    chosen.light.azimuth = wrapped_to_circle(Angle::from_degrees(*options.azimuth_deg));
    chosen.light.altitude = Angle::from_degrees(*options.altitude_deg);
    chosen.light.angular_diameter = Angle::from_degrees(options.sun_size_deg);
    if (chosen.light.azimuth.degrees() != *options.azimuth_deg)
        report.note(
            fmt::format("azimuth {} is taken as {}", *options.azimuth_deg, chosen.light.azimuth.degrees()));
    if (!(chosen.light.altitude.degrees() > 0.0))
        report.note("the light is not above the horizon: everything is dark");
    return chosen;
}

Place parse_place(std::string_view text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos)
        throw UsageError(
            fmt::format("--at must be longitude,latitude in degrees such as -155.47,19.82, got '{}'", text));
    const double longitude = parse_number("--at longitude", text.substr(0, comma));
    const double latitude = parse_number("--at latitude", text.substr(comma + 1));
    if (!(longitude >= -180.0 && longitude <= 360.0))
        throw UsageError(fmt::format("--at longitude must be from -180 to 360 degrees, got {}", longitude));
    if (!(latitude >= -90.0 && latitude <= 90.0))
        throw UsageError(fmt::format(
            "--at latitude (the second number) must be from -90 to 90 degrees, got {}", latitude));
    return {.longitude = Angle::from_degrees(longitude), .latitude = Angle::from_degrees(latitude)};
}

} // namespace duskline::cli
