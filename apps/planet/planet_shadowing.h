#pragma once

#include "planet_scene.h"
#include "planet_state.h"

#include <duskline/gl/planet_renderer.h>
#include <duskline/gl/shadow_map.h>
#include <duskline/planet/planet_shadows.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>

namespace duskline::planet_app {

inline constexpr std::size_t kAllTiles = std::numeric_limits<std::size_t>::max();

/// How many tiles may be given shadow heights in a frame: so many, and as many again and again until so much time has passed.
/// Without time what a frame shows does not depend on how fast the machine is.
struct ShadowBudget {
    std::size_t tiles = kAllTiles;
    double ms = 0.0;
};

/// One way of shadowing a scene, kept up to date from frame to frame: what the technique of a state needs, made when first
/// needed. Several may serve one scene in the same frame. Needs a current OpenGL context.
class PlanetShadowing {
public:
    /// `scene` must outlive it.
    explicit PlanetShadowing(PlanetScene& scene) : scene_(scene) {}

    /// Finds the shadows of a state for the tiles that the scene has loaded last, for a picture of that size, as far as the
    /// budget goes. Once a frame: the sun is followed from one to the next.
    void update(const PlanetState& state, std::size_t width, std::size_t height,
                const ShadowBudget& budget = {});

    /// What to draw with, of the state that it was updated for. Valid until the next update.
    gl::PlanetShadow shadow(const PlanetState& state) const;

    /// Whether all is there that the technique of a state wants.
    bool settled(const PlanetState& state) const;

    /// Tiles of which the fronts know.
    std::size_t tiles_of_fronts() const { return known_.size(); }

private:
    void update_shadow_map(const PlanetState& state, std::size_t width, std::size_t height);
    void make_fronts(const PlanetState& state);
    void update_fronts(const PlanetState& state, const ShadowBudget& budget);
    void follow_tiles(const PlanetState& state);
    void know_tile(const PlanetTile& tile);

    PlanetScene& scene_;
    std::optional<gl::ShadowMap> map_; ///< made anew for other options
    std::uint64_t ground_of_map_ = 0;  ///< PlanetScene::ground_number when it was drawn
    std::optional<PlanetShadows> fronts_;
    bool fronts_of_disc_ = false;
    std::unordered_map<PlanetTile, std::shared_ptr<const TileHeights>> known_; ///< what the fronts know
};

} // namespace duskline::planet_app
