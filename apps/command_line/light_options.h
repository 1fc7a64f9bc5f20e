#pragma once

#include "cli11_names.h"
#include "report.h"

#include <duskline/light/date_time.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/place.h>
#include <duskline/light/sun_course.h>
#include <duskline/light/sun_position.h>

#include <optional>
#include <string>

namespace duskline::cli {

/// When and from where the sun is looked at: --time, --at, --pressure, --temperature.
struct SunlightOptions {
    std::optional<DateTime> time = {};
    std::optional<Place> at = {}; ///< else the raster's centre
    Air air = {};
};

/// Where the light comes from: --azimuth and --altitude, or the sun.
struct LightOptions {
    std::optional<double> azimuth_deg = {};
    std::optional<double> altitude_deg = {};
    SunlightOptions sun = {};
    std::optional<double> sun_size_deg = {}; ///< else of the sun that day, or its mean
    bool disc_counts = false;                ///< all of the disc gives light, not its centre alone
};

/// What a raster says about the place its light falls on.
struct LightSite {
    std::optional<Place> place = {}; ///< of its centre; none without a coordinate system
    Angle map_to_grid_north = {};    ///< add it to an azimuth from the map's north to count from row 0
    Angle true_to_grid_north = {};   ///< add it to an azimuth from true north to count from row 0
    std::string body = "Earth";      ///< whose ground it is; --time means nothing elsewhere
};

/// A light and how it came about, for tags and summaries.
struct ChosenLight {
    DirectionalLight light;         ///< azimuth from the grid's north, as casters take it
    std::optional<DateTime> time;   ///< when --time was given
    std::optional<SunPosition> sun; ///< azimuth from true north; when --time was given
    std::optional<Place> place;     ///< where it is seen from; when --time was given
};

/// `options` must outlive `app`'s parsing.
void add_light_options(CLI::App& app, LightOptions& options);
void add_sunlight_options(CLI::App& app, SunlightOptions& options);

/// The same without --time, for commands that take dates.
void add_sun_view_options(CLI::App& app, SunlightOptions& options);

/// Whether any of them is given, even if only half of what makes a light.
bool asks_for_light(const LightOptions& options);

/// Throws UsageError when they ask for no light, for half of one, or for two.
void require_one_light(const LightOptions& options);

/// The options, or when they ask for no light the usual one of maps: azimuth 315, 45 degrees high, with a note.
LightOptions with_usual_light(LightOptions options, Report& report);

/// A moment as --time takes it. Throws UsageError.
DateTime parse_time(const std::string& text);

/// The light the options ask for, with notes on what was assumed. Throws UsageError when they ask for none, for
/// half a light, for two, or for a time where there is no place or no sun to speak of.
ChosenLight choose_light(const LightOptions& options, const LightSite& site, Report& report);

/// Where the sun of --time or --date is seen from: --at, else the raster's centre. Throws UsageError.
Place choose_place(const SunlightOptions& options, const LightSite& site, Report& report);

/// The same with the air and the raster's north, for suns of many moments.
SunView choose_sun_view(const SunlightOptions& options, const LightSite& site, Limb limb, Report& report);

/// "-155.47,19.82": longitude and latitude in degrees. Throws UsageError.
Place parse_place(std::string_view text);

/// "19.82 N, 155.47 W".
std::string in_words(const Place& place);

} // namespace duskline::cli
