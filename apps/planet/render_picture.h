#pragma once

#include "planet_options.h"
#include "report.h"

namespace duskline::planet_app {

/// --render: one picture without a window, all of its ground loaded. Each pixel is the mean of four. Throws OutputError,
/// and UnsupportedOnThisMachine where there is no OpenGL 4.5.
void render_picture(const PlanetOptions& options, cli::Report& report);

} // namespace duskline::planet_app
