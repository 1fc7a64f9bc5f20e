#pragma once

#include "report.h"
#include "viewer_options.h"

namespace duskline::viewer {

/// --render: one picture without a window. Each pixel is the mean of four. Throws OutputError, and
/// UnsupportedOnThisMachine where there is no OpenGL 4.3.
void render_picture(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
