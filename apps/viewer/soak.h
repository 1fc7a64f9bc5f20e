#pragma once

#include "report.h"
#include "viewer_options.h"

namespace duskline::viewer {

/// --soak: random use without a window for so many seconds, the same use for the same seed. Throws std::runtime_error
/// with what was being done when the driver complains, when shadows are not those of the ground, or when objects of OpenGL
/// or memory are left over; UnsupportedOnThisMachine where there is no OpenGL 4.3.
void soak(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
