#include "viewer_options.h"

#include "changing_ground.h"
#include "exit_code.h"
#include "help_page.h"
#include "option_values.h"
#include "shadow_map_settings.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/shadow_technique.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace duskline::viewer {
namespace {

using cli::UsageError;

constexpr auto kLook = "View";
constexpr auto kFlight = "--flyby";

using window::kHeadlessGroup;

constexpr std::size_t kMostLightMaps = 96;

std::string technique_list()
{
    std::string list;
    for (const gl::ShadowTechniqueKind& kind : gl::shadow_techniques())
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", kind.name, kind.description);
    return list;
}

std::string motion_list()
{
    std::string list;
    for (const GroundMotionKind& kind : ground_motions())
        list += fmt::format("{}{} ({}, {:.0f} s)", list.empty() ? "" : ", ", kind.name, kind.description,
                            kind.period_s);
    return list;
}

void add_look(CLI::App& app, ViewerOptions& options)
{
    window::add_size_option(app, options, kLook);
    app.add_option("--technique", options.technique,
                   "how shadows are found: " + technique_list() + "; with --flyby also all; else exact")
        ->type_name("NAME")
        ->group(kLook);
    app.add_option("--shadow-map", options.shadow_map,
                   "settings of the technique shadow-map, by commas, in place of "
                       + window::shadow_map_help())
        ->type_name("NAME=VALUE,...")
        ->group(kLook);
    app.add_flag("--soft", options.soft, "soft edges of shadows, by techniques that have them")->group(kLook);
    app.add_option_function<std::string>(
           "--light-maps",
           [&options](const std::string& typed) {
               options.light_maps = cli::parse_count("--light-maps", typed, 2);
               if (*options.light_maps > kMostLightMaps)
                   throw UsageError(
                       fmt::format("--light-maps must be at most {}, got {}", kMostLightMaps, typed));
           },
           "how many shadow maps the technique baked makes of a day, or of the compass for a light by angles")
        ->type_name("N")
        ->default_str("24")
        ->group(kLook);
    app.add_flag("--difference", options.difference,
                 "mark what differs from the exact shadows: red where they are missing, blue where there are "
                 "too many")
        ->group(kLook);
    app.add_flag("--objects", options.objects,
                 "trees, towers, an aircraft and clouds, in the terrain's shadow; larger than life")
        ->group(kLook);
    app.add_option("--animate", options.animation,
                   "how the ground moves, shadows and all: " + motion_list() + "; else it keeps still")
        ->type_name("NAME")
        ->group(kLook);
    cli::add_number(app,
                    {.names = "--animate-from",
                     .unit = "S",
                     .text = "second of --animate to begin with, the one that --render shows",
                     .range = {-1e9, 1e9}},
                    options.animation_s)
        ->group(kLook);
    cli::add_number(app,
                    {.names = "--animate-speed",
                     .unit = "X",
                     .text = "seconds of --animate in a second, of which --flyby takes 25 frames",
                     .range = {0.0, 100.0}},
                    options.animation_speed)
        ->group(kLook);
    app.add_option("--state", options.state,
                   "begin with a state that was saved, a JSON file; other options go before")
        ->type_name("FILE")
        ->group(kLook);
    app.add_option("--flight", options.flight,
                   "the flight of --flyby, a JSON file that was recorded; else the usual one")
        ->type_name("FILE")
        ->group(kLook);
}

void add_lamps(CLI::App& app, ViewerOptions& options)
{
    window::add_lamp_options(app, lamp_place_form(), kLook, [&options](const window::TypedLamp& lamp) {
        options.lamps.push_back(map_lamp(lamp));
    });
}

void add_headless(CLI::App& app, ViewerOptions& options)
{
    window::add_render_option(app, options);
    app.add_option_function<std::string>(
           "--flyby",
           [&options](const std::string& typed) {
               options.flyby_frames = cli::parse_count("--flyby", typed, 2);
           },
           "fly over the terrain in so many frames while the light goes round once, and say how long they "
           "took; needs no "
           "display")
        ->type_name("FRAMES")
        ->group(kHeadlessGroup);
    app.add_option_function<std::string>(
           "--at-most",
           [&options](const std::string& typed) {
               options.at_most_s = cli::parse_number("--at-most", typed);
               if (!(*options.at_most_s > 0.0))
                   throw UsageError(fmt::format("--at-most must be more than 0 seconds, got {}", typed));
           },
           "when --flyby would take longer with a technique, fly only every second frame of the same flight, "
           "or every "
           "third, ...: seconds of finding shadows and drawing; at least two frames are flown")
        ->type_name("SECONDS")
        ->group(kHeadlessGroup);
    window::add_soak_options(
        app, options,
        "use everything at random for so long, and fail when OpenGL complains or anything is left over; "
        "needs no display");
    window::add_output_options(app, options, kFlight);
}

} // namespace

void add_viewer_options(CLI::App& app, ViewerOptions& options)
{
    cli::add_input_options(app, options.input);
    add_look(app, options);
    add_lamps(app, options);
    cli::add_light_options(app, options.light);
    cli::add_look_options(app, options.picture);
    add_headless(app, options);
    cli::add_run_options(app, options.run);
    cli::add_details(
        app, "Opens a window with INPUT as a landscape under a sun that can be moved, by hand, by angles "
             "or by date and time. Drag to look around, turn the wheel to come nearer, hold Shift and "
             "drag to move the sun; F1 shows all keys. --render and --flyby need neither window nor "
             "display.");
    cli::add_example(app, "look at a terrain", "duskline-viewer dem.tif");
    cli::add_example(app, "the evening of a day, as a picture",
                     "duskline-viewer dem.tif --render evening.png --time 2026-06-21T18:30-10:00");
    cli::add_example(app, "how fast every technique is here, and how right",
                     "duskline-viewer dem.tif --flyby 1000 --technique all --report flyby.json");
}

void require_consistent(const ViewerOptions& options)
{
    window::require_one_task(options, options.flyby_frames.has_value(), kFlight);
    if (!options.flyby_frames && options.at_most_s)
        throw UsageError("--at-most says how long --flyby may take: give --flyby FRAMES");
    if (!options.flyby_frames && options.technique == "all")
        throw UsageError("--technique all is for --flyby");
    if (!options.technique.empty() && options.technique != "all")
        gl::shadow_technique_named(options.technique);
    if (!options.animation.empty())
        require_motion(options.animation);
    window::parse_shadow_map_option(options.shadow_map);
    cli::require_palette(options.picture);
}

} // namespace duskline::viewer
