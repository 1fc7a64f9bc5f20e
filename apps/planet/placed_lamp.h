#pragma once

#include <duskline/planet/planet_camera.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/products/colour.h>
#include <duskline/view/scene_lamp.h>

#include <optional>

namespace duskline::planet_app {

/// Where a searchlight shines: clockwise from north, above the horizontal, and from the middle of its beam to its border.
struct LampBeam {
    Angle azimuth = {};
    Angle altitude = {};
    Angle half_angle = Angle::from_degrees(10.0);
};

/// A lamp or a searchlight as people say it: by its place, and with where it is as bright as the sun.
struct PlacedLamp {
    LonLat place;
    double clearance_m = 10.0;         ///< over the ground
    std::optional<LampBeam> beam = {}; ///< of a searchlight
    double strength = 1.0;             ///< at its reach, in suns; with the square of the distance it falls
    double reach_m = 100.0;
    double range_m = 5000.0;   ///< farther away it lights nothing
    double soft_edge = 0.2;    ///< of a beam: SceneLamp
    Colour colour = {1, 1, 1}; ///< factors, 0 to 1
    bool on = true;
};

/// A lamp that shines all round, or a searchlight, with what is usual: those see farther.
PlacedLamp usual_lamp(const LonLat& place, double clearance_m);
PlacedLamp usual_searchlight(const LonLat& place, double clearance_m, const LampBeam& beam);

/// A lamp where the eye is, and a searchlight that shines where the eye looks, a quarter of the picture wide.
PlacedLamp lamp_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera);
PlacedLamp searchlight_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera);
LampBeam beam_of_view(const PlanetCamera& camera);

/// As the scene has it. It stands on the ground of the deepest level.
SceneLamp scene_lamp(const PlanetTerrain& terrain, const PlacedLamp& lamp);

} // namespace duskline::planet_app
