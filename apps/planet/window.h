#pragma once

#include "planet_options.h"
#include "report.h"

namespace duskline::planet_app {

/// Opens a window with the planet and returns when it is closed. Throws UnsupportedOnThisMachine, with what would help,
/// where there is no display or no OpenGL 4.5.
void show_window(const PlanetOptions& options, cli::Report& report);

} // namespace duskline::planet_app
