#pragma once

#include "cli11_names.h"
#include "drawing_options.h"
#include "planet_state.h"
#include "run_options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace duskline::planet_app {

/// What `duskline-planet` was asked for.
struct PlanetOptions : window::DrawingOptions {
    std::vector<std::string> files; ///< from coarse to fine; none: those Duskline carries
    bool moon = false;
    bool sphere = false;
    std::optional<double> radius_km;
    double detail = 1.0;
    PlanetPose pose;
    std::optional<DateTime> time;
    std::optional<double> azimuth_deg;
    std::optional<double> altitude_deg;
    std::string technique; ///< empty: the usual one; "all" in a descent
    PlanetState look;      ///< the mesh, the shadow map and so on
    cli::RunOptions run;
    std::optional<std::size_t> flydown_frames;
    double from_km = 20000.0;
    double to_m = 15.0;
    bool variants = false;       ///< the shadow map with each of its options, too
    std::size_t errors = 0;      ///< frames of a descent whose shadows are compared with the truth
    std::size_t errors_step = 8; ///< of their pixels, in rows and columns
};

/// `options` must outlive `app`'s parsing.
void add_planet_options(CLI::App& app, PlanetOptions& options);

/// Throws UsageError for options that do not go together.
void require_consistent(const PlanetOptions& options);

/// The globe the options ask for; `of_file` is that of the first file.
Globe globe_of(const PlanetOptions& options, const Globe& of_file);

/// What the options say to begin with.
PlanetState first_state(const PlanetOptions& options, const PlanetTerrain& terrain);

} // namespace duskline::planet_app
