#pragma once

// One raster of mountains, as a flat terrain and on a ball, for tests.

#include "planet/made_ground.h"

#include <duskline/casting/shadow_mask.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <cmath>
#include <cstddef>

namespace duskline {

/// The middle of a face is flat enough to be a raster: its samples, and beyond them the plain.
class MountainsOnABall {
public:
    static constexpr std::uint32_t kLevel = 9;
    static constexpr std::size_t kSide = 255;

    explicit MountainsOnABall(double radius_m)
        : radius_m_(radius_m),
          mountains_(make_mountains({.grid = {kSide, kSide, cell_size()}, .seed = 5, .height_m = 3000.0})),
          ground_(sphere_of_radius(radius_m), {0.0F, 3000.0F},
                  [this](const Vector3& d) { return height_m(d.y / d.x, d.z / d.x); })
    {}

    const Terrain& mountains() const { return mountains_; }
    const MadeGround& ground() const { return ground_; }

    /// The raster with its heights lowered by the curvature of the ball: flat casters' ground.
    Terrain curved_raster() const
    {
        Terrain curved = {mountains_.heights_m.copy(), mountains_.cell_size_m};
        curvature().lower(curved.heights_m.view());
        return curved;
    }
    double lowered_m(double row, double column, double height_m) const
    {
        const double away_m = std::hypot(row - kMiddle, column - kMiddle) * mountains_.cell_size_m.x;
        return height_m - curvature_drop_m(away_m, 1.0, radius_m_);
    }

    Vector3 direction(double row, double column) const
    {
        return normalized({1.0, (column - kMiddle) * step(), (kMiddle - row) * step()});
    }

    /// Of all cells, from what is true of a direction and the height of the ground there.
    template <typename IsLit>
    ShadowMask mask_by(const IsLit& is_lit) const
    {
        ShadowMask mask(kSide, kSide);
        for (std::size_t row = 0; row < kSide; ++row)
            for (std::size_t column = 0; column < kSide; ++column)
                mask(row, column) = is_lit(direction(static_cast<double>(row), static_cast<double>(column)),
                                           static_cast<double>(mountains_.heights_m(row, column)))
                                        ? Lit::yes
                                        : Lit::no;
        return mask;
    }

private:
    static constexpr double kMiddle = (kSide - 1) / 2.0;
    static double step() { return 2.0 / static_cast<double>(kTileSquares << kLevel); }
    CellSize cell_size() const { return {radius_m_ * step(), radius_m_ * step()}; }
    CurvedEarth curvature() const
    {
        return {{1.0, radius_m_, kMiddle, kMiddle}, mountains_.cell_size_m, kSide};
    }

    double height_m(double u, double v) const
    {
        const double row = std::round(kMiddle - v / step());
        const double column = std::round(kMiddle + u / step());
        if (!(row >= 0.0 && column >= 0.0 && row < kSide && column < kSide))
            return 0.0;
        return static_cast<double>(
            mountains_.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
    }

    double radius_m_;
    Terrain mountains_;
    MadeGround ground_;
};

} // namespace duskline
