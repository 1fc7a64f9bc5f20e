#pragma once

#include "planet_files.h"
#include "planet_state.h"

#include <duskline/gl/planet_renderer.h>
#include <duskline/gl/timer_query.h>

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace duskline::planet_app {

/// What a frame cost.
struct FrameCost {
    gl::DrawnPlanet drawn;
};

/// A planet on the graphics card and the shadows on it, as a state says. Needs a current OpenGL context.
class PlanetScene {
public:
    /// Both must outlive it.
    PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources);

    /// Draws a picture of that size into the current framebuffer, with all its ground loaded.
    FrameCost draw_settled(const PlanetState& state, std::size_t width, std::size_t height);

private:
    const TileHeights& heights_of(const PlanetTile& tile);
    void select(const PlanetTile& tile, const Vector3& eye_m, double reach,
                std::vector<gl::PlanetPatch>& patches);

    const ViewedPlanet& viewed_;
    std::unordered_map<PlanetTile, TileHeights> tiles_;
    gl::PlanetRenderer renderer_;
};

/// Where the eye of a pose is, and how it looks, in the planet's frame.
Vector3 eye_m(const PlanetTerrain& terrain, const PlanetPose& pose);
CameraAxes axes_of(const Globe& globe, const PlanetPose& pose);

} // namespace duskline::planet_app
