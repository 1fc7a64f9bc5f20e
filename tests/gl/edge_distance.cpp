#include "gl/edge_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace duskline::gl {

namespace {

constexpr int kDirections = 24;
constexpr double kGrowth = 1.1;
constexpr double kNearestTexels = 0.1;
// Ground that the light grazes: two texels are that many along it, in light of 2 degrees.
constexpr double kFarthestTexels = 60.0;

double across_light_m(const Vector3& between_m, const ShadowBox& box)
{
    return std::hypot(dot(between_m, box.axes.right), dot(between_m, box.axes.up));
}

} // namespace

bool has_edge_within(double texels, const GroundAround& around, const ShadowBox& box)
{
    const GroundPlace place = around(0.0, 0.0, 0.0);
    const auto shows_edge = [&](const GroundPlace& other) {
        return other.lit != place.lit
               && across_light_m(other.position_m - place.position_m, box) <= texels * box.texel_m;
    };
    for (double along = kNearestTexels; along < kFarthestTexels; along *= kGrowth) {
        const double along_m = along * box.texel_m;
        for (int i = 0; i < kDirections; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / kDirections;
            if (shows_edge(around(along_m * std::cos(angle), along_m * std::sin(angle), 0.0)))
                return true;
        }
        if (!place.lit && shows_edge(around(0.0, 0.0, along_m)))
            return true;
    }
    return false;
}

} // namespace duskline::gl
