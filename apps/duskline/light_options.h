#pragma once

#include "report.h"

#include <duskline/light/directional_light.h>
#include <duskline/light/place.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace duskline::cli {

/// Where the light comes from, as typed: --azimuth and --altitude, or --time with a place.
struct LightOptions {
    std::optional<double> azimuth_deg;
    std::optional<double> altitude_deg;
    std::string time;        ///< ISO 8601 with an offset or Z
    std::optional<Place> at; ///< else the raster's centre
    double sun_size_deg = 0.533;
};

/// What a raster says about the place its light falls on.
struct LightSite {
    std::optional<Place> place; ///< of its centre; none without a CRS
    Angle true_to_grid_north;   ///< add it to an azimuth from true north to get one from the raster's north
    bool on_earth = true;       ///< --time means nothing on the Moon
};

/// A light and how it came about, for tags and summaries.
struct ChosenLight {
    DirectionalLight light;
    std::string time_utc; ///< ISO 8601; empty unless --time was given
};

/// `options` must outlive `app`'s parsing.
void add_light_options(CLI::App& app, LightOptions& options);

/// The light the options ask for. Throws UsageError when they ask for none, for half a light, for two, or
/// for a time where there is no place.
ChosenLight choose_light(const LightOptions& options, const LightSite& site, Report& report);

/// "-155.47,19.82": longitude and latitude in degrees. Throws UsageError.
Place parse_place(std::string_view text);

} // namespace duskline::cli
