#pragma once

#include <duskline/view/scene_lamp.h>

#include <span>
#include <string>
#include <vector>

namespace duskline::viewer {

struct ViewedTerrain;

/// A lamp over a terrain, in the terrain's frame (view/camera.h).
struct ViewerLamp {
    SceneLamp light;
    bool on = true;
};

/// Those that are on.
std::vector<SceneLamp> shining(std::span<const ViewerLamp> lamps);

/// What lamps and searchlights are unless told otherwise.
SceneLamp usual_lamp();
SceneLamp usual_searchlight();

/// Unit vector that way: azimuth clockwise from the map's north, altitude above the horizontal.
Vector3 beam_towards(Angle azimuth, Angle altitude);

/// Where a searchlight shines.
struct BeamAngles {
    Angle azimuth;
    Angle altitude;
};
BeamAngles angles_of_beam(const SceneLamp& lamp);

/// The lamp of --lamp X,Y,Z[,NAME=VALUE...] and of --searchlight X,Y,Z,AZIMUTH,ALTITUDE,HALF_ANGLE[,NAME=VALUE...]: map
/// coordinates and metres over zero, or +Z metres over the ground. Throws UsageError with the option, what was typed and
/// what would be right, also for a place that has no ground.
ViewerLamp typed_lamp(const std::string& typed, const ViewedTerrain& viewed);
ViewerLamp typed_searchlight(const std::string& typed, const ViewedTerrain& viewed);

/// Throws UsageError unless these can be read, whatever the terrain.
void require_lamp(const std::string& typed);
void require_searchlight(const std::string& typed);

/// What may be said by name, for help texts.
std::string lamp_settings_help();

} // namespace duskline::viewer
