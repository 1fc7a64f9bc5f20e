#include "light_options.h"

#include "exit_code.h"
#include "option_values.h"

#include <duskline/geometry/invalid_input.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";

void add_air(CLI::App& app, Air& air)
{
    add_number(app,
               {.names = "--pressure",
                .unit = "MBAR",
                .text = "of the air at the place, for the refraction of the sun; 0 for none",
                .range = {.least = 0.0, .most = 1200.0}},
               air.pressure_mbar)
        ->group(kGroup);
    add_number(app,
               {.names = "--temperature",
                .unit = "CELSIUS",
                .text = "of the air at the place, for the refraction of the sun",
                .range = {.least = -100.0, .most = 100.0}},
               air.temperature_c)
        ->group(kGroup);
}

ChosenLight light_by_angles(const LightOptions& options, const LightSite& site, Report& report)
{
    const Angle azimuth = Angle::from_degrees(*options.azimuth_deg);
    if (wrapped_to_circle(azimuth) != azimuth)
        report.note(fmt::format("azimuth {} is taken as {}", azimuth.degrees(),
                                wrapped_to_circle(azimuth).degrees()));
    ChosenLight chosen;
    chosen.light.azimuth = wrapped_to_circle(azimuth + site.map_to_grid_north);
    chosen.light.altitude = Angle::from_degrees(*options.altitude_deg);
    return chosen;
}

ChosenLight light_by_time(const SunlightOptions& options, const LightSite& site, Report& report)
{
    ChosenLight chosen;
    chosen.time = options.time;
    chosen.place = choose_place(options, site, report);
    chosen.sun = sun_position(options.time->utc, *chosen.place, {.air = options.air});
    chosen.light = sunlight(*chosen.sun, site.true_to_grid_north);
    report.note(
        fmt::format("sun at {} from {}: azimuth {:.4f} from true north, altitude {:.4f} degrees with {:.4f} "
                    "of refraction ({:g} mbar, {:g} degrees Celsius)",
                    to_iso8601({options.time->utc}), in_words(*chosen.place), chosen.sun->azimuth.degrees(),
                    chosen.sun->apparent_altitude().degrees(), chosen.sun->refraction.degrees(),
                    options.air.pressure_mbar, options.air.temperature_c));
    const double grid_north_deg = std::remainder(-site.true_to_grid_north.degrees(), 360.0);
    if (grid_north_deg != 0.0)
        report.note(
            fmt::format("azimuth {:.4f} from the raster's north, which lies {:.4f} degrees {} of true north",
                        chosen.light.azimuth.degrees(), std::abs(grid_north_deg),
                        grid_north_deg < 0.0 ? "west" : "east"));
    return chosen;
}

double coordinate(std::string_view name, std::string_view typed, double least, double most)
{
    const double number = parse_number(name, typed);
    if (!(number >= least && number <= most))
        throw UsageError(fmt::format("{} must be from {} to {} degrees, got {} (--at takes LON,LAT)", name,
                                     least, most, number));
    return number;
}

} // namespace

void add_sunlight_options(CLI::App& app, SunlightOptions& options)
{
    app.add_option_function<std::string>(
           "--time", [&options](const std::string& typed) { options.time = parse_time(typed); },
           "the sun at this moment, ISO 8601 with its offset from UTC or Z: 2026-06-21T18:30-10:00")
        ->type_name("TIME")
        ->group(kGroup);
    add_sun_view_options(app, options);
}

void add_sun_view_options(CLI::App& app, SunlightOptions& options)
{
    app.add_option_function<std::string>(
           "--at", [&options](const std::string& typed) { options.at = parse_place(typed); },
           "where the sun is seen from, degrees east and north; else the raster's centre")
        ->type_name("LON,LAT")
        ->group(kGroup);
    add_air(app, options.air);
}

void add_light_options(CLI::App& app, LightOptions& options)
{
    add_number(app,
               {.names = "--azimuth",
                .unit = "DEG",
                .text = "towards the light, clockwise from the map's north; taken modulo 360"},
               options.azimuth_deg)
        ->group(kGroup);
    add_number(app,
               {.names = "--altitude",
                .unit = "DEG",
                .text = "of the light above the horizontal; at or below 0 all is dark",
                .range = {.least = -90.0, .most = 90.0}},
               options.altitude_deg)
        ->group(kGroup);
    add_sunlight_options(app, options.sun);
    add_number(app,
               {.names = "--sun-size",
                .unit = "DEG",
                .text = "diameter of the light's disc; else 0.533, or the sun's that day with --time",
                .range = {.least = 0.0, .most = 180.0}},
               options.sun_size_deg)
        ->group(kGroup);
}

void require_one_light(const LightOptions& options)
{
    const bool by_angles = options.azimuth_deg || options.altitude_deg;
    if (by_angles && options.sun.time)
        throw UsageError("give --azimuth and --altitude, or --time, not both");
    if (options.sun.at && !options.sun.time)
        throw UsageError("--at says where the sun of --time is seen from: give --time too");
    if (!by_angles && !options.sun.time)
        throw UsageError("give the light: --azimuth DEG and --altitude DEG, or --time such as "
                         "2026-06-21T18:30-10:00");
    if (by_angles && !options.azimuth_deg)
        throw UsageError("--altitude needs --azimuth");
    if (by_angles && !options.altitude_deg)
        throw UsageError("--azimuth needs --altitude");
}

bool asks_for_light(const LightOptions& options)
{
    return options.azimuth_deg || options.altitude_deg || options.sun.time || options.sun.at;
}

LightOptions with_usual_light(LightOptions options, Report& report)
{
    if (asks_for_light(options))
        return options;
    options.azimuth_deg = 315.0;
    options.altitude_deg = 45.0;
    report.note("no light was given: it comes from azimuth 315, 45 degrees high");
    return options;
}

DateTime parse_time(const std::string& text)
{
    try {
        return parse_date_time(text);
    } catch (const InvalidInput& error) {
        throw UsageError(fmt::format("--time {}", error.what()));
    }
}

ChosenLight choose_light(const LightOptions& options, const LightSite& site, Report& report)
{
    require_one_light(options);
    ChosenLight chosen =
        options.sun.time ? light_by_time(options.sun, site, report) : light_by_angles(options, site, report);
    if (options.sun_size_deg)
        chosen.light.angular_diameter = Angle::from_degrees(*options.sun_size_deg);
    const double radius_deg = chosen.light.angular_diameter.degrees() / 2.0;
    if (!(chosen.light.altitude.degrees() + (options.disc_counts ? radius_deg : 0.0) > 0.0))
        report.warn("the light is not above the horizon: everything is dark");
    return chosen;
}

Place choose_place(const SunlightOptions& options, const LightSite& site, Report& report)
{
    if (site.body != "Earth")
        throw UsageError(
            fmt::format("the sun of a moment is known over the Earth only, and this raster lies on another "
                        "body ({}); shadows can be cast with --azimuth and --altitude",
                        site.body));
    if (options.at)
        return *options.at;
    if (!site.place)
        throw UsageError("the raster does not say where on the Earth it lies: give --at LON,LAT");
    report.note(fmt::format("the sun is seen from the raster's centre, {}", in_words(*site.place)));
    return *site.place;
}

SunView choose_sun_view(const SunlightOptions& options, const LightSite& site, Limb limb, Report& report)
{
    return {.place = choose_place(options, site, report),
            .options = {.air = options.air},
            .true_to_grid_north = site.true_to_grid_north,
            .limb = limb};
}

Place parse_place(std::string_view text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos)
        throw UsageError(
            fmt::format("--at must be longitude,latitude in degrees such as -155.47,19.82, got '{}'", text));
    return {.longitude =
                Angle::from_degrees(coordinate("longitude of --at", text.substr(0, comma), -180.0, 360.0)),
            .latitude =
                Angle::from_degrees(coordinate("latitude of --at", text.substr(comma + 1), -90.0, 90.0))};
}

std::string in_words(const Place& place)
{
    const double latitude = place.latitude.degrees();
    const double longitude = std::remainder(place.longitude.degrees(), 360.0);
    return fmt::format("{:.6g} {}, {:.6g} {}", std::abs(latitude), latitude < 0.0 ? "S" : "N",
                       std::abs(longitude), longitude < 0.0 ? "W" : "E");
}

} // namespace duskline::cli
