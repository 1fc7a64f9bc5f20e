#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>
#include <duskline/terrain/height_field.h>

#include <array>

namespace duskline {

/// A pinhole camera over a terrain, without roll.
///
///   position_m     x east, y north, z up from the centre of cell (0, 0) and height 0, metres: the frame of the terrain
///   heading        of the view, clockwise from the grid's north
///   pitch          of the view above the horizontal, -90 to 90 degrees
///   vertical_view  angle between the lower and the upper border of the picture, above 0 and below 180 degrees
struct Camera {
    Vector3 position_m = {};
    Angle heading = {};
    Angle pitch = {};
    Angle vertical_view = Angle::from_degrees(45.0);
};

/// Unit vectors of what lies ahead, to the right and above in the picture.
struct CameraAxes {
    Vector3 forward;
    Vector3 right;
    Vector3 up;
};
CameraAxes axes_of(const Camera& camera);

/// Column by column, as OpenGL takes it.
using Matrix4 = std::array<float, 16>;

/// What lies between two distances ahead, metres; 0 < nearest_m < farthest_m.
struct DepthRange {
    double nearest_m = 1.0;
    double farthest_m = 1e6;
};

/// From metres east, north and up *of the eye* to OpenGL's clip space (depth -1 at the nearest). Relative to the eye,
/// so that floats are precise where it matters however large the terrain is. `aspect` is width over height.
Matrix4 eye_to_clip(const Camera& camera, double aspect, const DepthRange& depth);

/// Pixels that a small angle of one radian takes at the middle of a picture `height` pixels high.
double pixels_per_radian(const Camera& camera, double height);

/// Where a place in cells lies in the terrain's frame.
inline Vector3 position_m(const GridPoint& point, CellSize cell_size_m)
{
    return {point.column * cell_size_m.x, -point.row * cell_size_m.y, point.height_m};
}

/// And back.
inline GridPoint grid_point(const Vector3& position_m, CellSize cell_size_m)
{
    return {-position_m.y / cell_size_m.y, position_m.x / cell_size_m.x, position_m.z};
}

// What hands do to a camera. Each gives a new camera; pitches stay within 89.9 degrees.

/// Looks elsewhere from the same place.
Camera turned(const Camera& camera, Angle by_heading, Angle by_pitch);

/// Swings around a pivot, which keeps its place in the picture.
Camera orbited(const Camera& camera, const Vector3& pivot_m, Angle by_heading, Angle by_pitch);

/// Moves towards a pivot (factor below 1) or away from it.
Camera approached(const Camera& camera, const Vector3& pivot_m, double factor);

/// Moves by metres to the right, ahead (as the camera looks) and straight up.
Camera flown(const Camera& camera, double right_m, double ahead_m, double up_m);

/// Lifted to at least that height over the ground (bilinear; beyond the border that of the nearest border). Unchanged
/// over ground without data.
Camera kept_above_ground(const Camera& camera, const HeightField& field, double clearance_m);

/// Height of a place over the ground under it, as `kept_above_ground` sees it; its height over 0 where there are no
/// data.
double clearance_m(const Vector3& position_m, const HeightField& field);

/// The first place where a ray from the eye meets the ground, to about a cell; where it meets none, the place at the
/// distance of the terrain's middle. For picking what the pointer is on. `right` and `up` are -1 to 1 over the picture.
Vector3 picked_m(const Camera& camera, double aspect, double right, double up, const HeightField& field);

/// A view of the whole terrain from the south and above.
Camera overview(const HeightField& field, double aspect);

/// The depths between which the ground can lie for that eye.
DepthRange depth_range(const Camera& camera, const HeightField& field, HeightRange heights);

} // namespace duskline
