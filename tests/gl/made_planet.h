#pragma once

#include <duskline/gl/planet_renderer.h>

#include <functional>
#include <map>
#include <vector>

namespace duskline::gl {

/// A planet with heights by a formula of the direction, the same on every level.
class MadePlanet {
public:
    using Height = std::function<double(const Vector3&)>;

    explicit MadePlanet(const Globe& globe, Height height = {}) : globe_(globe), height_(std::move(height)) {}

    const Globe& globe() const { return globe_; }

    const TileHeights& heights_of(const PlanetTile& tile);
    PlanetTextures::HeightsOf source()
    {
        return [this](const PlanetTile& tile) -> const TileHeights& { return heights_of(tile); };
    }

    /// What tiles say of all their samples, from now on.
    void set_measured(bool measured) { measured_ = measured; }

    double ground_m(const Vector3& direction) const { return height_ ? height_(direction) : 0.0; }

private:
    Globe globe_;
    Height height_;
    bool measured_ = true;
    std::map<PlanetTile, TileHeights> tiles_;
};

/// All tiles of a level, which turn into nothing.
std::vector<PlanetPatch> whole_level(std::uint32_t level);

/// Tiles of many levels, finer near the eye: each is split while it is nearer than `reach` times the diagonal of its
/// children, down to `deepest`.
std::vector<PlanetPatch> patches_around(MadePlanet& planet, const Vector3& eye_m, double reach,
                                        std::uint32_t deepest);

/// Axes of an eye over a place: heading clockwise from north, pitch above the horizontal.
CameraAxes looking(const Globe& globe, const Vector3& eye_m, double heading_deg, double pitch_deg);

} // namespace duskline::gl
