#pragma once

#include "planet_options.h"
#include "report.h"

namespace duskline::planet_app {

/// --soak: flies about at random, without a window: places, heights, suns, techniques and their options, in small pictures; small
/// steps and leaps. Throws std::runtime_error at the first frame after which OpenGL has complained, or more is in memory than
/// is allowed: see docs/planet.md, and UnsupportedOnThisMachine where there is no OpenGL 4.5.
void soak(const PlanetOptions& options, cli::Report& report);

} // namespace duskline::planet_app
