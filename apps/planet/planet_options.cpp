#include "planet_options.h"

#include "exit_code.h"
#include "help_page.h"
#include "light_options.h"
#include "option_values.h"
#include "shadow_map_settings.h"
#include "shadow_variants.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace duskline::planet_app {
namespace {

using cli::UsageError;

constexpr auto kPlanet = "Planet";
constexpr auto kView = "View";
constexpr auto kLight = "Light";
constexpr auto kFlight = "--flydown";

using window::kHeadlessGroup;

// "LON,LAT,HEIGHT"
void read_pose(const std::string& typed, PlanetPose& pose)
{
    const std::size_t comma = typed.rfind(',');
    if (comma == std::string::npos || typed.find(',') == comma)
        throw UsageError(
            fmt::format("--at must be LON,LAT,HEIGHT such as -155.47,19.82,2000, got '{}'", typed));
    const Place place = cli::parse_place(typed.substr(0, comma));
    pose.place = {place.longitude, place.latitude};
    pose.clearance_m = cli::parse_number("--at", typed.substr(comma + 1));
    if (!(pose.clearance_m >= 0.5 && pose.clearance_m <= 1e9))
        throw UsageError(fmt::format("--at must have a height from 0.5 to 1e9 m over the ground, got {}",
                                     pose.clearance_m));
}

void add_angle(CLI::App& app, const cli::NumberOption& option, Angle& value)
{
    const cli::Range range = option.range;
    const std::string names = option.names;
    app.add_option_function<std::string>(
           names,
           [&value, range, names](const std::string& typed) {
               const double degrees = cli::parse_number(names, typed);
               if (!(degrees >= range.least && degrees <= range.most))
                   throw UsageError(fmt::format("{} must be from {} to {}, got {}", names, range.least,
                                                range.most, degrees));
               value = Angle::from_degrees(degrees);
           },
           option.text)
        ->type_name(option.unit)
        ->default_str(fmt::format("{}", value.degrees()))
        ->group(kView);
}

std::string technique_list()
{
    std::string list;
    for (const TechniqueName& known : planet_techniques())
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", known.name, known.description);
    return list;
}

void add_planet(CLI::App& app, PlanetOptions& options)
{
    app.add_option("FILE", options.files,
                   "heights from coarse to fine: the whole planet, then parts of it; without any, those "
                   "Duskline carries "
                   "(the earth by 37 km, Hawaii by 75 m)")
        ->type_name("")
        ->group("Input");
    app.add_flag("--moon", options.moon, "the Moon: a sphere of 1737.4 km without air, sea and plants")
        ->group(kPlanet);
    app.add_flag("--sphere", options.sphere, "a sphere with the planet's equatorial radius")->group(kPlanet);
    cli::add_number(app,
                    {.names = "--radius",
                     .unit = "KM",
                     .text = "a sphere of that radius",
                     .range = {.least = 0.1, .most = 1e6}},
                    options.radius_km)
        ->group(kPlanet);
    cli::add_number(
        app,
        {.names = "--detail",
         .unit = "FACTOR",
         .text = "made-up relief below what the files show, as a multiple of what the roughness around "
                 "suggests; 0 for none",
         .range = {.least = 0.0, .most = 10.0}},
        options.detail)
        ->group(kPlanet);
}

void add_view(CLI::App& app, PlanetOptions& options)
{
    app.add_option_function<std::string>(
           "--at", [&options](const std::string& typed) { read_pose(typed, options.pose); },
           "where to look from: degrees east and north, and metres over the ground")
        ->type_name("LON,LAT,HEIGHT")
        ->default_str("-155.47,19.4,40000")
        ->group(kView);
    add_angle(app,
              {.names = "--heading",
               .unit = "DEG",
               .text = "of the view, clockwise from north",
               .range = {.least = -360.0, .most = 360.0}},
              options.pose.heading);
    add_angle(app,
              {.names = "--pitch",
               .unit = "DEG",
               .text = "of the view above the horizontal",
               .range = {.least = -90.0, .most = 90.0}},
              options.pose.pitch);
    add_angle(app,
              {.names = "--view",
               .unit = "DEG",
               .text = "angle from the lower to the upper border of the picture",
               .range = {.least = 1.0, .most = 120.0}},
              options.pose.vertical_view);
    window::add_size_option(app, options, kView);
    app.add_option("--technique", options.technique,
                   "how shadows are found: " + technique_list() + "; with --flydown also all; else fronts")
        ->type_name("NAME")
        ->group(kView);
    app.add_flag("--soft", options.look.soft,
                 "with the technique fronts: half-shadows of the sun's disc, 0.53 degrees across")
        ->group(kView);
    app.add_option_function<std::string>(
           "--shadow-map",
           [&options](const std::string& typed) {
               const auto settings = window::parse_shadow_map_option(typed);
               options.look.shadow_map = settings.options;
               options.look.shadow_look = settings.look;
           },
           "settings of the technique shadow-map, by commas, in place of " + window::shadow_map_help())
        ->type_name("NAME=VALUE,...")
        ->group(kView);
    cli::add_number(app,
                    {.names = "--square",
                     .unit = "PX",
                     .text = "how large squares of the mesh may be in the picture",
                     .range = {.least = 0.5, .most = 100.0}},
                    options.look.square_pixels)
        ->group(kView);
    app.add_flag("--mark-detail", options.look.show_made, "colour ground that no file has measured")
        ->group(kView);
}

void add_light(CLI::App& app, PlanetOptions& options)
{
    app.add_option_function<std::string>(
           "--time", [&options](const std::string& typed) { options.time = cli::parse_time(typed); },
           "the sun of the earth at this moment, ISO 8601 with its offset from UTC or Z: "
           "2026-06-21T18:30-10:00")
        ->type_name("TIME")
        ->group(kLight);
    cli::add_number(app,
                    {.names = "--azimuth",
                     .unit = "DEG",
                     .text = "towards the sun where one looks from, clockwise from north; else 300"},
                    options.azimuth_deg)
        ->group(kLight);
    cli::add_number(app,
                    {.names = "--altitude",
                     .unit = "DEG",
                     .text = "of the sun above the horizontal there; else 25",
                     .range = {.least = -90.0, .most = 90.0}},
                    options.altitude_deg)
        ->group(kLight);
}

void add_lamps(CLI::App& app, PlanetOptions& options)
{
    window::add_lamp_options(app, lamp_place_form(), kLight, [&options](const window::TypedLamp& lamp) {
        options.look.lamps.push_back(placed_lamp(lamp));
    });
}

void add_headless(CLI::App& app, PlanetOptions& options)
{
    window::add_render_option(app, options);
    app.add_option_function<std::string>(
           "--flydown",
           [&options](const std::string& typed) {
               options.flydown_frames = cli::parse_count("--flydown", typed, 2);
           },
           "fly from space down to the place of --at in so many frames, and say how long they took; needs no "
           "display")
        ->type_name("FRAMES")
        ->group(kHeadlessGroup);
    cli::add_number(app,
                    {.names = "--from",
                     .unit = "KM",
                     .text = "height over the ground where --flydown begins",
                     .range = {.least = 0.001, .most = 1e6}},
                    options.from_km)
        ->group(kHeadlessGroup);
    cli::add_number(app,
                    {.names = "--to",
                     .unit = "M",
                     .text = "height over the ground where it ends, looking as --pitch says",
                     .range = {.least = 0.5, .most = 1e8}},
                    options.to_m)
        ->group(kHeadlessGroup);
    app.add_flag("--variants", options.variants,
                 "with --flydown: the shadow map with each of its options, too; --technique may name one of "
                 "them")
        ->group(kHeadlessGroup);
    app.add_option_function<std::string>(
           "--errors",
           [&options](const std::string& typed) { options.errors = cli::parse_count("--errors", typed, 2); },
           "compare the shadows in so many frames of --flydown with rays over all the ground between them "
           "and "
           "the sun; takes seconds a frame")
        ->type_name("FRAMES")
        ->group(kHeadlessGroup);
    app.add_option_function<std::string>(
           "--errors-step",
           [&options](const std::string& typed) {
               options.errors_step = cli::parse_count("--errors-step", typed, 1);
           },
           "compare every so many pixels, in rows and columns")
        ->type_name("PX")
        ->default_str("8")
        ->group(kHeadlessGroup);
    window::add_soak_options(
        app, options,
        "fly about at random for so long, with every technique, and fail when OpenGL complains or "
        "memory grows beyond its bounds; needs no display");
    window::add_output_options(app, options, kFlight);
}

} // namespace

void add_planet_options(CLI::App& app, PlanetOptions& options)
{
    add_planet(app, options);
    add_view(app, options);
    add_light(app, options);
    add_lamps(app, options);
    add_headless(app, options);
    cli::add_run_options(app, options.run);
    cli::add_details(
        app, "Shows a planet from space down to a step above the ground, under a sun that can be moved by "
             "date, by time and by hand. --render and --flydown need neither window nor display.");
    cli::add_example(app, "Hawaii in the evening, as a picture",
                     "duskline-planet --render hawaii.png --at -155.5,19.0,30000 --pitch -20 --time "
                     "2026-06-21T18:30-10:00");
    cli::add_example(
        app, "the Moon's Tycho at sunrise",
        "duskline-planet moon_tycho.tif --moon --render tycho.png --at -11.3,-46,60000 --azimuth 90 "
        "--altitude 8");
    cli::add_example(app, "a lamp and a searchlight in a valley by night",
                     "duskline-planet --at -155.6,20.11,900 --heading 190 --pitch -20 --altitude -20 --lamp "
                     "-155.61,20.08,40,strength=20 --searchlight -155.6,20.11,30,200,-10,8");
}

namespace {

void require_known_technique(const PlanetOptions& options)
{
    if (options.technique.empty() || options.technique == "all")
        return;
    const std::vector<ShadowVariant> variants = shadow_map_variants(options.look.shadow_map);
    if (options.variants
        && std::ranges::find(variants, options.technique, &ShadowVariant::name) != variants.end())
        return;
    technique_named(options.technique);
}

} // namespace

void require_consistent(const PlanetOptions& options)
{
    window::require_one_task(options, options.flydown_frames.has_value(), kFlight);
    if (!options.flydown_frames && (options.variants || options.errors > 0))
        throw UsageError("--variants and --errors are for --flydown");
    if (!options.flydown_frames && options.technique == "all")
        throw UsageError("--technique all is for --flydown");
    if (options.flydown_frames && !(1000.0 * options.from_km > options.to_m))
        throw UsageError(
            fmt::format("--from must be above --to, got {} km and {} m", options.from_km, options.to_m));
    if (options.moon && (options.sphere || options.radius_km))
        throw UsageError("--moon says the radius: give it without --sphere and --radius");
    if (options.time && (options.azimuth_deg || options.altitude_deg))
        throw UsageError("give --azimuth and --altitude, or --time, not both");
    if (options.time && options.moon)
        throw UsageError("--time is the sun of the earth: give --azimuth and --altitude with --moon");
    window::require_lamps_fit(options.look.lamps.size());
    require_known_technique(options);
}

Globe globe_of(const PlanetOptions& options, const Globe& of_file)
{
    if (options.moon)
        return sphere_of_radius(kMoonRadius_m);
    if (options.radius_km)
        return sphere_of_radius(1000.0 * *options.radius_km);
    return options.sphere ? sphere_of_radius(of_file.equatorial_radius_m) : of_file;
}

PlanetState first_state(const PlanetOptions& options, const PlanetTerrain& terrain)
{
    PlanetState state = options.look;
    state.camera = camera_at(terrain, options.pose);
    state.sun.time = options.time;
    state.sun.direction = sun_direction(terrain.globe(),
                                        {Angle::from_degrees(options.azimuth_deg.value_or(300.0)),
                                         Angle::from_degrees(options.altitude_deg.value_or(25.0))},
                                        options.pose.place);
    bring_up_to_date(state.sun);
    if (!options.technique.empty() && options.technique != "all" && !options.variants)
        state.technique = technique_named(options.technique);
    return state;
}

} // namespace duskline::planet_app
