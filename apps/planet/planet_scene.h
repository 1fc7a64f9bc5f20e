#pragma once

#include "planet_files.h"
#include "planet_lamps.h"
#include "planet_state.h"

#include <duskline/execution/progress.h>
#include <duskline/gl/planet_renderer.h>
#include <duskline/planet/planet_quadtree.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace duskline::planet_app {

/// The ground of a planet on the graphics card, and pictures of it. Shadows come from elsewhere (PlanetShadowing), so that
/// several ways of finding them can draw the same ground in the same frame. Needs a current OpenGL context.
class PlanetScene {
public:
    /// `viewed` and `sources` must outlive it.
    PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources, double square_pixels,
                const Execution& execution);
    PlanetScene(const PlanetScene&) = delete; // its renderer asks its quadtree
    PlanetScene& operator=(const PlanetScene&) = delete;

    /// Chooses the tiles of a picture of that size, reads at most about so many of those that are missing, and takes what is to
    /// be drawn to the card.
    void load(const PlanetState& state, std::size_t width, std::size_t height, std::size_t most_tiles);

    /// The same with everything there, however long it takes.
    void load_all(const PlanetState& state, std::size_t width, std::size_t height);

    /// Brings the lamps up to date for the tiles that are loaded: PlanetLamps::update.
    std::size_t update_lamps(const PlanetState& state, bool exact) { return lamps_.update(state, exact); }

    /// Draws the picture for which tiles were loaded last into the current framebuffer.
    gl::DrawnPlanet draw(const PlanetState& state, std::size_t width, std::size_t height,
                         const gl::PlanetShadow& shadow);

    /// The same picture as PlanetRenderer::probe_ground gives it.
    void probe(const PlanetState& state, std::size_t width, std::size_t height,
               const gl::PlanetShadow& shadow);

    /// Its lamps that shine, and the same picture as PlanetRenderer::probe_lamp gives it of one of them.
    std::span<const SceneLamp> lamps() const;
    void probe_lamp(const PlanetState& state, std::size_t width, std::size_t height, std::size_t lamp);

    /// What may cast shadows into a box: PlanetRenderer::draw_depth, as DrawCasters of the box wants it.
    void draw_casters(const Vector3& eye_m, const ShadowBox& box);

    /// Another number whenever tiles have come or gone: what casts is no longer what it was.
    std::uint64_t ground_number() const { return ground_number_; }

    const PlanetTerrain& terrain() const { return *viewed_.terrain; }
    const PlanetQuadtree& quadtree() const { return quadtree_; }
    const gl::ShaderSources& sources() const { return sources_; }
    const Execution& execution() const { return execution_; }

    /// Layers of tiles that there is room for on the card.
    std::size_t layers() const { return renderer_.layers(); }

    /// Takes up shader files that have changed on disk.
    bool reload_shaders() { return renderer_.reload_if_changed(); }

private:
    gl::PlanetLight light_of(const PlanetState& state) const;

    const ViewedPlanet& viewed_;
    const gl::ShaderSources& sources_;
    Execution execution_;
    PlanetQuadtree quadtree_;
    gl::PlanetRenderer renderer_;
    PlanetLamps lamps_;
    std::uint64_t ground_number_ = 0;
};

} // namespace duskline::planet_app
