#pragma once

#include <duskline/planet/planet_camera.h>
#include <duskline/planet/planet_terrain.h>

namespace duskline {

/// Down from space to a place on the ground.
struct FlyDown {
    LonLat place;
    double from_m = 2.0e7; ///< over the ground; above `to_m`
    double to_m = 2.0;     ///< over the ground; above 0
    Angle heading = {};    ///< throughout
    Angle last_pitch = {}; ///< the first looks straight down
    Angle vertical_view = Angle::from_degrees(45.0);
};

/// The camera at a share of the way down, 0 to 1. The height over the ground falls by equal factors in equal times, slower at
/// both ends, so the ground comes up as fast at every scale; from a third of the way on the eye is raised from straight down
/// to the last pitch. Throws InvalidInput for heights out of range.
PlanetCamera fly_down(const PlanetTerrain& terrain, const FlyDown& flight, double share);

/// Between two cameras: along the great circle between them, heights over the ellipsoid by equal factors (eased as above),
/// never lower than `clearance_m` over the ground, heading and pitch the short way round.
PlanetCamera between(const PlanetTerrain& terrain, const PlanetCamera& from, const PlanetCamera& to,
                     double clearance_m, double share);

} // namespace duskline
