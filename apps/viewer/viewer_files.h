#pragma once

#include "changing_ground.h"
#include "report.h"
#include "viewer_options.h"

#include <duskline/raster_io/read_height_field.h>

#include <memory>

namespace duskline::viewer {

/// A terrain as it is looked at.
struct ViewedTerrain {
    HeightFile file;
    std::unique_ptr<ChangingGround> ground;
    float ambient = 0.28f;
    bool air = true;
};

/// Reads the files the options name. Throws InputError, UsageError.
ViewedTerrain read_viewed_terrain(const ViewerOptions& options, cli::Report& report);

} // namespace duskline::viewer
