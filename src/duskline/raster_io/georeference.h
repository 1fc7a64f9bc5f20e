#pragma once

#include <duskline/raster_io/ground_frame.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

class OGRSpatialReference;

namespace duskline {

/// Where a file says its cells lie.
struct Georeference {
    std::string path; ///< for messages
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::optional<std::array<double, 6>> geotransform; ///< GDAL's; empty: none
    const OGRSpatialReference* crs = nullptr;          ///< null: none
};

struct SettledGround {
    GroundFrame frame;
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
};

/// Measures the cells on the ground and puts rows and columns in order.
///
/// Geographic cells are measured on the ellipsoid at the raster's centre, projected ones by their own unit,
/// or on the ellipsoid too where the projection stretches them by more than 1 % (Web Mercator, plate carree).
/// `cell_size_m` overrules both.
///
/// Throws InputError, with a remedy, where one cell size would be a lie: sheared rasters, poles in degrees,
/// cells that differ by more than a factor of 2 from edge to edge, numbers that can only be degrees without
/// a coordinate system.
SettledGround settle_ground(const Georeference& file, std::optional<double> cell_size_m);

} // namespace duskline
