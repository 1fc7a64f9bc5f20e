#pragma once

#include "lamp_settings.h"

#include <duskline/planet/planet_camera.h>
#include <duskline/planet/planet_terrain.h>

#include <string>

namespace duskline::planet_app {

/// A lamp or a searchlight on a planet.
struct PlacedLamp {
    LonLat place;
    double clearance_m = 10.0; ///< over the ground
    window::LampSettings light;
};

/// How --lamp and --searchlight say where one stands: LON,LAT,HEIGHT.
const window::LampPlaceForm& lamp_place_form();

/// With its place read. Throws cli::UsageError.
PlacedLamp placed_lamp(const window::TypedLamp& typed);

/// The option that brings the lamp: "--lamp -155.62,20.1,30,strength=2".
std::string option_of(const PlacedLamp& lamp);

/// A lamp where the eye is.
PlacedLamp lamp_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera,
                       const window::LampSettings& light);

/// Where the eye looks, a quarter of the picture wide.
window::LampBeam beam_of_view(const PlanetCamera& camera);

/// As the scene has it. It stands on the ground of the deepest level.
SceneLamp scene_lamp(const PlanetTerrain& terrain, const PlacedLamp& lamp);

} // namespace duskline::planet_app
