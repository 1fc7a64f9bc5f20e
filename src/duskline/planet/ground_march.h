#pragma once

#include <duskline/planet/light_axis.h>
#include <duskline/planet/light_section.h>
#include <duskline/planet/planet_level.h>

#include <cstdint>

namespace duskline {

/// The half-plane, bounded by an axis through the planet's centre, in which a ray goes along that axis: unit vectors at
/// right angles, towards the light and away from the axis.
struct RayPlane {
    Vector3 towards;
    Vector3 outward;
};

/// One walk along a ray over the ground of a level, crossing by crossing. Angles `theta` are at the planet's centre, from
/// `towards`, 0 to pi; they fall along the ray. `ground` must outlive it.
class GroundMarch {
public:
    /// Until the first ground farther from the axis than `known_rho_m` if `stop_at_first`, else to the end.
    GroundMarch(const PlanetLevel& ground, const RayPlane& plane, double known_rho_m, bool stop_at_first);

    /// The greatest distance from the axis that ground has between two angles, neither of them counted, or `known_rho_m`
    /// where that is greater. Once only. An end of 0 is an end beyond all ground.
    double greatest_rho_m(double from_theta, double to_theta = 0.0);

private:
    struct ThetaRange {
        double low;
        double high;
    };

    double first_theta_that_counts(double theta) const;
    double reach_m(double theta) const;
    ThetaRange thetas_on(std::uint32_t face) const;
    void walk_over(std::uint32_t face, ThetaRange thetas);
    void cross_lines(std::uint32_t face, LinesAlong lines, ThetaRange thetas);
    std::int64_t index_above(double line) const;
    std::int64_t index_below(double line) const;
    bool cross(std::uint32_t face, LinesAlong lines, const BeamLine& beam, std::int64_t line);
    double inverse_depth_at(std::uint32_t face, LinesAlong lines, std::int64_t line, std::int64_t cell);
    static ThetaRange not_below_zero(double a, double b);

    const PlanetLevel& ground_;
    RayPlane plane_;
    std::int64_t samples_;
    double step_;
    LightSection section_;
    double falls_below_; // nearer to the light than this theta, the greatest distance possible only falls
    double rho_m_;
    bool stop_at_first_;
    bool ended_ = false;
    double start_ = 0.0;
    double end_ = 0.0;
    PlanetTile tile_ = {};
    const TileHeights* heights_ = nullptr;
};

} // namespace duskline
