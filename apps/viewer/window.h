#pragma once

#include "report.h"
#include "viewer_options.h"

namespace duskline::viewer {

/// Opens a window with the terrain and returns when it is closed. Throws UnsupportedOnThisMachine, with what would help,
/// where there is no display or no OpenGL 4.3.
void show_window(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
