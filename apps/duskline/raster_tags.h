#pragma once

#include "lamp_options.h"
#include "light_options.h"
#include "report.h"

#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

#include <string>
#include <utility>
#include <vector>

namespace duskline::cli {

/// Metadata of a raster: what a reader must know to trust it, years later.
using RasterTags = std::vector<std::pair<std::string, std::string>>;

void add_tag(RasterTags& tags, std::string key, std::string value);

/// SOFTWARE, LIGHT_AZIMUTH (from the map's north), LIGHT_ALTITUDE, and of a sun LIGHT_TIME_UTC, LIGHT_PLACE,
/// LIGHT_AZIMUTH_TRUE, REFRACTION (the degrees by which the air lifts it).
RasterTags light_tags(const ChosenLight& chosen, const HeightFile& file);

/// SOFTWARE, LIGHT_POINTS (X,Y,Z in map coordinates and metres over the zero of the heights, by semicolons).
RasterTags lamp_tags(const std::vector<ChosenLamp>& lamps);

/// CELL_SIZE_M, Z_FACTOR, HEIGHT_UNIT, CURVATURE, RADIUS_M.
void add_height_tags(RasterTags& tags, const HeightFile& file, const EarthCurvature& curvature);

/// ASSUMPTIONS: the notes and warnings so far.
void add_assumptions(RasterTags& tags, const Report& report);

} // namespace duskline::cli
