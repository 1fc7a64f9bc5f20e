#pragma once

#include "report.h"
#include "viewer_options.h"

namespace duskline::viewer {

/// --flyby: the same flight with every technique asked for, without a window, timed frame by frame; the light goes
/// round once at its altitude. Besides, each once more with the light at rest, its shadows found before.
/// Throws OutputError, and UnsupportedOnThisMachine where there is no OpenGL 4.3.
void fly_by(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
