#pragma once

#include <duskline/geometry/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace duskline {

/// The surface of a globe on the six faces of a cube around it, each seen from outside: the direction of (u, v) on a face
/// is that of  axis + u right + v up,  u and v from -1 to 1 (gnomonic projection).
///
///             +-----+              face    0    1    2    3    4    5
///             | +z  |              axis   +x   +y   -x   -y   +z   -z
///             |  4  |              right  +y   -x   -y   +x   +y   +y
///       +-----+-----+-----+-----+  up     +z   +z   +z   +z   -x   +x
///       | -y  | +x  | +y  | -x  |
///       |  3  |  0  |  1  |  2  |  v ^     Great circles are straight lines on every face: so is the way that light
///       +-----+-----+-----+-----+    |     takes over the ground (docs/decisions/0020).
///             | -z  |                +--> u
///             |  5  |
///             +-----+
///
/// On an edge of the cube both faces give the same direction, bit for bit.
inline constexpr std::uint32_t kCubeFaces = 6;

struct CubeFaceAxes {
    Vector3 axis;
    Vector3 right;
    Vector3 up;
};

inline constexpr std::array<CubeFaceAxes, kCubeFaces> kCubeFaceAxes = {{
    {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
    {{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
    {{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}},
    {{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
    {{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}},
    {{0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}},
}};

/// Of a face below kCubeFaces.
constexpr const CubeFaceAxes& axes_of_face(std::uint32_t face)
{
    return kCubeFaceAxes[face];
}

/// A place on a face. Outside -1 to 1 it lies beyond the face's edge; every u and v has a direction.
struct FacePlace {
    double u = 0.0;
    double v = 0.0;

    bool operator==(const FacePlace&) const = default;
};

/// Unit vector.
inline Vector3 direction_of(std::uint32_t face, FacePlace place)
{
    const CubeFaceAxes& axes = axes_of_face(face);
    return normalized(axes.axis + axes.right * place.u + axes.up * place.v);
}

/// Where a direction (of any length but 0) lies on a face; only for directions in the face's own half of space
/// (`dot(direction, axis) > 0`).
inline FacePlace place_on_face(std::uint32_t face, const Vector3& direction)
{
    const CubeFaceAxes& axes = axes_of_face(face);
    const double ahead = dot(direction, axes.axis);
    return {dot(direction, axes.right) / ahead, dot(direction, axes.up) / ahead};
}

/// The face that a direction lies on: of the greatest component. On edges and corners the one of x before y before z.
std::uint32_t face_of(const Vector3& direction);

} // namespace duskline
