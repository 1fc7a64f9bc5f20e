#pragma once

#include "input_options.h"
#include "report.h"
#include "run_options.h"

#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

namespace duskline::cli {

/// How the options say INPUT is to be read.
ReadOptions read_options(const InputOptions& options, const RunOptions& run);

/// Opens INPUT as the options say. What was assumed goes into the report.
HeightFile open_heights(const InputOptions& options, const RunOptions& run, Report& report);

/// How the ground falls away under the light: as the options say, else as on the body the file lies on.
/// Coefficient 0 is a flat earth.
EarthCurvature choose_curvature(const InputOptions& options, const HeightFile& file, Report& report);

/// All heights, lowered by the curvature: ground that light meets as on a flat earth. Throws as read_terrain.
Terrain read_lowered_terrain(HeightFile& file, const EarthCurvature& curvature, const Execution& execution);

/// Says what turned up while the heights were read: no data that the file does not declare, or nothing else.
void report_reading(const HeightFile& file, Report& report);

} // namespace duskline::cli
