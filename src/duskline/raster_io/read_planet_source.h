#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/planet_source.h>
#include <duskline/raster_io/file_errors.h>

#include <string>

namespace duskline {

/// Heights of a file as a source for a planet, and the planet's figure.
struct PlanetSourceFile {
    PlanetSource source;
    Globe globe;
    bool is_earth = false;
};

/// Reads heights in any projection. Rasters in degrees, north up, are taken as they are; others are warped by GDAL (cubic
/// convolution) to the longitudes and latitudes of their own ellipsoid, cells about as large as theirs. Cells without data
/// (see HeightFile) are NaN. Takes the memory of the raster twice.
///
/// Throws InputError for files that cannot be read, that do not say where they lie, or whose map GDAL cannot undo;
/// UnsupportedOnThisMachine when they do not fit in memory; Cancelled.
PlanetSourceFile read_planet_source(const std::string& path, const Execution& execution = {});

} // namespace duskline
