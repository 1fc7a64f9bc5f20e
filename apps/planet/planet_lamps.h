#pragma once

#include "planet_state.h"

#include <duskline/gl/lamp_maps.h>
#include <duskline/gl/planet_renderer.h>
#include <duskline/planet/planet_quadtree.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace duskline::planet_app {

/// The lamps and searchlights of a state, and their shadow maps, in which all tiles cast that are loaded within their range, as
/// finely as they are drawn. Needs a current OpenGL context.
class PlanetLamps {
public:
    /// All must outlive it.
    PlanetLamps(const PlanetTerrain& terrain, const PlanetQuadtree& quadtree, gl::PlanetRenderer& renderer)
        : terrain_(terrain), quadtree_(quadtree), renderer_(renderer)
    {}

    /// Lets the lamps shine that are on, and draws the maps that are not what they were: of lamps that have changed; and all
    /// when the tiles within their range have, or when the eye has moved so far that the mesh has turned with it. While it
    /// moves that may be a tenth of its way to the ground; where it stands, and if `exact`, nothing. Says how many were drawn.
    std::size_t update(const PlanetState& state, bool exact);

    /// What to draw with: none while no lamp shines. Valid until the next update.
    const gl::LampMaps* maps() const;

private:
    bool mesh_has_turned(const PlanetCamera& camera, bool exact);
    std::vector<PlanetPatch> tiles_in_range(const std::vector<SceneLamp>& lamps) const;

    const PlanetTerrain& terrain_;
    const PlanetQuadtree& quadtree_;
    gl::PlanetRenderer& renderer_;
    std::optional<gl::LampMaps> maps_; ///< made when first needed
    std::vector<PlanetPatch> cast_;    ///< in the maps
    Vector3 cast_for_eye_m_;           ///< which the meshes in the maps are for
    Vector3 last_eye_m_;
};

} // namespace duskline::planet_app
