#pragma once

#include "planet_options.h"
#include "report.h"

#include <duskline/planet/planet_terrain.h>

#include <memory>

namespace duskline::planet_app {

/// A planet as it is looked at.
struct ViewedPlanet {
    std::unique_ptr<PlanetTerrain> terrain;
    bool air = true;
    bool living = true; ///< with sea, plants and snow
};

/// Reads the files the options name, or those Duskline carries: from the folder in the environment's DUSKLINE_DATA_DIR, from
/// `data` in the current folder, or from where they are installed. Throws InputError.
ViewedPlanet read_viewed_planet(const PlanetOptions& options, cli::Report& report);

} // namespace duskline::planet_app
