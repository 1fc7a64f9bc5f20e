#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/light/place.h>
#include <duskline/terrain/height_field.h>

#include <optional>
#include <string>

namespace duskline {

/// The body whose surface a coordinate reference system describes.
struct Body {
    std::string name;               ///< "Earth", "Moon", or what the file calls its ellipsoid
    bool is_earth = false;          ///< air that bends light, and a sun that `sun_position` knows
    double equatorial_radius_m = 0; ///< of the ellipsoid
    double local_radius_m = 0;      ///< of the sphere that fits the ellipsoid best at the raster's centre
};

/// How a raster lies on the ground, after its rows and columns were put in the library's order.
struct GroundFrame {
    /// Ground distance between neighbouring cells at the raster's centre, metres.
    CellSize cell_size_m;

    /// Map azimuth of the direction from the last row to row 0: clockwise from the map's north (the y axis of
    /// the coordinate system). 0 unless the raster is rotated.
    Angle grid_north;

    /// True azimuth of the map's north at the centre: the convergence of meridians, positive when the map's
    /// north lies east of true north. 0 without a coordinate system.
    Angle map_north;

    /// The rows, or the columns, of the file run the other way and are turned round on reading and writing.
    bool rows_flipped = false;
    bool columns_flipped = false;

    std::optional<Place> centre; ///< on the body's ellipsoid; empty without a coordinate system
    std::optional<Body> body;    ///< empty without a coordinate system

    /// Azimuth from the grid's north (what casters take) of an azimuth from the map's north.
    Angle from_map_north(Angle azimuth) const { return azimuth - grid_north; }
    /// Azimuth from the grid's north of an azimuth from true north, as sun positions have it.
    Angle from_true_north(Angle azimuth) const { return azimuth - map_north - grid_north; }
};

} // namespace duskline
