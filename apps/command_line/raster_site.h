#pragma once

#include "light_options.h"

#include <duskline/raster_io/ground_frame.h>

namespace duskline::cli {

/// What a raster's place says about the light on it.
LightSite light_site(const GroundFrame& ground);

} // namespace duskline::cli
