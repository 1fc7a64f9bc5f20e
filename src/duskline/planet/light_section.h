#pragma once

#include <duskline/planet/globe.h>

#include <cmath>

namespace duskline {

/// An ellipse: a globe cut by a half-plane about the axis of light. With x along the light and y away from its axis it is
/// xx x^2 + 2 xy x y + yy y^2 = 1; theta is the angle at the centre from the sun's direction.
struct LightSection {
    double xx;
    double xy;
    double yy;

    LightSection(const Globe& globe, const Vector3& to_sun, const Vector3& outward)
    {
        const auto scaled = [&](const Vector3& v) {
            return Vector3{v.x / globe.equatorial_radius_m, v.y / globe.equatorial_radius_m,
                           v.z / globe.polar_radius_m};
        };
        xx = dot(scaled(to_sun), scaled(to_sun));
        xy = dot(scaled(to_sun), scaled(outward));
        yy = dot(scaled(outward), scaled(outward));
    }

    /// Where it is farthest from the axis, and how far.
    double widest_theta() const { return std::atan2(xx, -xy); }
    double greatest_rho_m() const { return std::sqrt(xx / (xx * yy - xy * xy)); }

    double radius_m(double theta) const
    {
        const double c = std::cos(theta);
        const double s = std::sin(theta);
        return 1.0 / std::sqrt(xx * c * c + 2.0 * xy * c * s + yy * s * s);
    }
};

} // namespace duskline
