#pragma once

#include <duskline/geometry/vector.h>

#include <array>

namespace duskline {

/// A box whose sides run along three unit vectors at right angles.
struct OrientedBox {
    Vector3 centre_m;
    std::array<Vector3, 3> axes;
    std::array<double, 3> half_m = {}; ///< from the centre along each axis, either way; 0 or above
};

/// How far a point lies from the nearest point of a box; 0 inside.
double distance_m(const Vector3& point_m, const OrientedBox& box);

/// How far the box reaches from its centre in a direction (a unit vector).
double reach_m(const OrientedBox& box, const Vector3& direction);

/// From corner to opposite corner: no two points of the box are farther apart.
inline double diagonal_m(const OrientedBox& box)
{
    return 2.0 * length({box.half_m[0], box.half_m[1], box.half_m[2]});
}

} // namespace duskline
