#pragma once

#include "lamp_settings.h"

#include <duskline/view/camera.h>

#include <optional>
#include <span>
#include <vector>

namespace duskline::viewer {

struct ViewedTerrain;

/// A lamp over a terrain.
struct ViewerLamp {
    Vector3 position_m; ///< in the terrain's frame (view/camera.h)
    window::LampSettings light;
};

/// Those that are on, as the scene has them.
std::vector<SceneLamp> shining(std::span<const ViewerLamp> lamps);

/// Where the eye looks, a quarter of the picture wide.
window::LampBeam beam_of_view(const Camera& camera);

/// A lamp that was asked for by map coordinates and metres over zero, or +Z metres over the ground.
struct MapLamp {
    std::string option; ///< as it was typed, for messages
    double x = 0.0;
    double y = 0.0;
    double z_m = 0.0;
    bool above_ground = false;
    window::LampSettings light;
};

/// How --lamp and --searchlight say where one stands: X,Y,Z.
const window::LampPlaceForm& lamp_place_form();

/// With its place read. Throws cli::UsageError.
MapLamp map_lamp(const window::TypedLamp& typed);

/// Over the terrain. Throws cli::UsageError where that has no ground.
ViewerLamp placed_lamp(const MapLamp& lamp, const ViewedTerrain& viewed);

} // namespace duskline::viewer
