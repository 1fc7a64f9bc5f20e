#pragma once

#include <cmath>

namespace duskline {

/// A direction or difference in a right-handed frame: x east, y north, z up, metres or unitless.
struct Vector3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr Vector3 operator+(Vector3 o) const { return {x + o.x, y + o.y, z + o.z}; }
    constexpr Vector3 operator-(Vector3 o) const { return {x - o.x, y - o.y, z - o.z}; }
    constexpr Vector3 operator*(double s) const { return {x * s, y * s, z * s}; }
};

constexpr double dot(Vector3 a, Vector3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline double length(Vector3 v)
{
    return std::sqrt(dot(v, v));
}

inline Vector3 normalized(Vector3 v)
{
    return v * (1.0 / length(v));
}

/// A place on or above a grid: row and column counted in cells from the centre of cell (0, 0), fractions
/// allowed, and a height in metres.
struct GridPoint {
    double row = 0.0;
    double column = 0.0;
    double height_m = 0.0;
};

} // namespace duskline
