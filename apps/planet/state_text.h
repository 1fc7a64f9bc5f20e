#pragma once

#include "planet_state.h"

#include <string>

namespace duskline::planet_app {

/// The options of duskline-planet that bring the view of a state, its sun, its shadows and its lamps that are on, without
/// those of files and of the globe: "--at -155.6,20.1,100 --heading 220 ... --lamp -155.6,20.1,30".
std::string options_of(const PlanetTerrain& terrain, const PlanetState& state);

/// Of these, the place and where to look.
std::string pose_options(const PlanetPose& pose);

} // namespace duskline::planet_app
