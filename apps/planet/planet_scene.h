#pragma once

#include "planet_files.h"
#include "planet_state.h"

#include <duskline/execution/progress.h>
#include <duskline/gl/planet_renderer.h>
#include <duskline/gl/shadow_map.h>
#include <duskline/planet/planet_quadtree.h>
#include <duskline/planet/planet_shadows.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>

namespace duskline::planet_app {

/// What a frame may do besides drawing.
struct FrameBudget {
    std::size_t loads = 8;    ///< tiles read
    std::size_t shadows = 24; ///< tiles whose shadow heights are found
};

/// What a frame cost, by the wall clock; with `wait` the graphics card's work is part of it.
struct FrameCost {
    double load_ms = 0.0; ///< choosing tiles and reading those that are new
    double cast_ms = 0.0; ///< finding shadows
    double draw_ms = 0.0; ///< with taking tiles to the card
    gl::DrawnPlanet drawn;
    bool settled = false; ///< all that the view wants is there
};

/// A planet on the graphics card and the shadows on it, as a state says. Needs a current OpenGL context.
class PlanetScene {
public:
    /// `viewed` and `sources` must outlive it.
    PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources, double square_pixels,
                const Execution& execution);

    /// Draws a picture of that size into the current framebuffer, with what is there and what the budget adds.
    FrameCost draw(const PlanetState& state, std::size_t width, std::size_t height, const FrameBudget& budget,
                   bool wait = false);

    /// The same with everything there, however long it takes.
    FrameCost draw_settled(const PlanetState& state, std::size_t width, std::size_t height);

    /// The picture that was last drawn, of the same state and size, as PlanetRenderer::probe_ground gives it.
    void probe(const PlanetState& state, std::size_t width, std::size_t height);

    /// Layers of tiles that there is room for on the card.
    std::size_t layers() const { return renderer_.layers(); }

    /// Tiles of which the fronts know.
    std::size_t tiles_of_fronts() const { return known_.size(); }

    /// Takes up shader files that have changed on disk.
    bool reload_shaders() { return renderer_.reload_if_changed(); }

    const PlanetQuadtree& quadtree() const { return quadtree_; }

private:
    void update_shadow_map(const PlanetState& state, std::size_t width, std::size_t height);
    void update_fronts(const PlanetState& state, std::size_t tiles);
    void follow_tiles(const PlanetState& state);
    void know_tile(const PlanetTile& tile);
    gl::PlanetShadow shadow_of(const PlanetState& state) const;
    gl::DrawnPlanet draw_picture(const PlanetState& state, std::size_t width, std::size_t height);

    const ViewedPlanet& viewed_;
    const gl::ShaderSources& sources_;
    Execution execution_;
    PlanetQuadtree quadtree_;
    gl::PlanetRenderer renderer_;
    std::optional<gl::ShadowMap> map_; ///< made when first needed, and for other options
    gl::ShadowMapOptions map_options_;
    std::optional<PlanetShadows> fronts_;                                      ///< made when first needed
    std::unordered_map<PlanetTile, std::shared_ptr<const TileHeights>> known_; ///< what the fronts know
};

} // namespace duskline::planet_app
