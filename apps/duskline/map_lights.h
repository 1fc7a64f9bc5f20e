#pragma once

#include "lamp_options.h"
#include "light_options.h"

#include <duskline/products/colour.h>

#include <optional>
#include <string>
#include <vector>

namespace duskline::cli {

/// The lights of a light map: one sun by --azimuth and --altitude or --time, lamps by --point, or any of both by
/// --light, each with its colour and strength.
struct MapLightOptions {
    LightOptions sun;
    LampOptions lamps;
    std::vector<std::string> lights; ///< KEY=VALUE,KEY=VALUE...
};

/// A light as it was asked for: a sun, or else a lamp.
struct ChosenMapLight {
    std::optional<ChosenLight> sun;
    std::optional<ChosenLamp> lamp;
    double strength = 1.0;
    Colour colour = {1, 1, 1}; ///< factors, 0 to 1
    double reach_m = 1000.0;   ///< of a lamp
    bool casts = true;         ///< shadows
};

/// `options` must outlive `app`'s parsing.
void add_map_light_options(CLI::App& app, MapLightOptions& options);

/// Throws UsageError for lights that are mixed up or are none: all that can be said without the file.
void require_lights(const MapLightOptions& options);

/// The lights the options ask for, else the usual light of maps. Throws as `choose_light` and `choose_lamps`.
std::vector<ChosenMapLight> choose_map_lights(const MapLightOptions& options, const InputOptions& input,
                                              const RunOptions& run, const HeightFile& file,
                                              const EarthCurvature& curvature, bool discs_count,
                                              Report& report);

/// The light as --light takes it: "azimuth=203,altitude=5,colour=#ffffff,strength=1".
std::string in_words(const ChosenMapLight& light, const HeightFile& file);

} // namespace duskline::cli
