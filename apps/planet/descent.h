#pragma once

#include "planet_options.h"
#include "report.h"

namespace duskline::planet_app {

/// --flydown: the same way down from space with every technique asked for, without a window, timed frame by frame; tiles
/// and shadows come as they do in a window. Throws OutputError, and UnsupportedOnThisMachine where there is no OpenGL 4.5.
void fly_down(const PlanetOptions& options, cli::Report& report);

} // namespace duskline::planet_app
