#pragma once

#include "report.h"
#include "viewer_options.h"

#include <duskline/products/colour.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/height_field.h>

namespace duskline::viewer {

/// A terrain as it is looked at.
struct ViewedTerrain {
    HeightFile file;
    Terrain terrain; ///< lowered for the curvature, so that what is seen is what the shadows are cast on
    Picture ground;  ///< its own colours
    float ambient = 0.28f;
    bool air = true;
};

/// Reads the files the options name. Throws InputError, UsageError.
ViewedTerrain read_viewed_terrain(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
