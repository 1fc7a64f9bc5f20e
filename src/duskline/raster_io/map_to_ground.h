#pragma once

#include <duskline/raster_io/ground_frame.h>

#include <memory>
#include <optional>

class OGRSpatialReference;
class OGRCoordinateTransformation;

namespace duskline {

/// Metres on the ground, east and north.
struct GroundVector {
    double east_m = 0.0;
    double north_m = 0.0;
};

/// What one unit along the map's x and y axes is on the ground, at one place.
struct MapScale {
    Place place;
    GroundVector per_x;
    GroundVector per_y;
};

/// From the coordinates of a map to the ellipsoid beneath it.
class MapToGround {
public:
    /// Throws InputError (without a file's name) for a coordinate system that is neither geographic nor
    /// projected, or that PROJ cannot undo.
    explicit MapToGround(const OGRSpatialReference& crs);
    ~MapToGround();

    bool is_geographic() const { return is_geographic_; }
    double metres_per_unit() const { return metres_per_unit_; } ///< of a projected system
    /// -1 for a map whose coordinates grow to the west and to the south (its north is minus y), else 1.
    double axis_sign() const { return axis_sign_; }
    const Body& body() const { return body_; }

    /// Radius of the sphere that fits the ellipsoid best at that latitude.
    double local_radius_m(Angle latitude) const;

    /// Empty where the map has no ground: outside its projection, or at a pole in degrees.
    std::optional<MapScale> at(double x, double y) const;

private:
    struct Curvature {
        double meridian_m;
        double normal_m;
    };
    Curvature curvature(double latitude) const;
    MapScale geographic_scale(double x, double y) const;
    std::optional<MapScale> projected_scale(double x, double y) const;

    bool is_geographic_ = false;
    double metres_per_unit_ = 1.0;
    double axis_sign_ = 1.0;
    double radians_per_degree_unit_ = 0.0;
    double prime_meridian_ = 0.0;
    double equatorial_radius_m_ = 0.0;
    double squared_eccentricity_ = 0.0;
    Body body_;
    std::unique_ptr<OGRCoordinateTransformation> to_geographic_;
};

} // namespace duskline
