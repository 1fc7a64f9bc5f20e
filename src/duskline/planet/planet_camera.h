#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/oriented_box.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/view/camera.h>

#include <array>

namespace duskline {

/// A pinhole camera at a planet, without roll. Its angles are those of the place below it, so they stay what they are when
/// it flies round the planet.
///
///   eye_m          in the planet's frame; not the centre
///   heading        clockwise from north
///   pitch          above the horizontal, -90 (straight down, the heading upwards in the picture) to 90 degrees
///   vertical_view  angle between the lower and the upper border of the picture, above 0 and below 180 degrees
struct PlanetCamera {
    Vector3 eye_m;
    Angle heading = {};
    Angle pitch = {};
    Angle vertical_view = Angle::from_degrees(45.0);
};

/// Above a place, at a height above the ellipsoid.
PlanetCamera camera_over(const Globe& globe, const LonLat& place, double height_m);

/// What lies ahead, to the right and above in the picture, in the planet's frame.
CameraAxes axes_of(const Globe& globe, const PlanetCamera& camera);

/// How high the eye is over the ground of the deepest level.
double clearance_m(const PlanetCamera& camera, const PlanetTerrain& terrain);

// What hands do to a camera. Each gives a new camera; pitches stay within -90 and 90 degrees.

/// Looks elsewhere from the same place.
PlanetCamera turned(const PlanetCamera& camera, Angle by_heading, Angle by_pitch);

/// Moves over the curved planet: metres to the right and ahead, both level, and up. What is ahead stays ahead.
PlanetCamera flown(const Globe& globe, const PlanetCamera& camera, double right_m, double ahead_m,
                   double up_m);

/// Lifted to at least that height over the ground.
PlanetCamera kept_above_ground(const PlanetCamera& camera, const PlanetTerrain& terrain, double clearance_m);

/// What a camera sees, however far away.
class PlanetFrustum {
public:
    PlanetFrustum(const Globe& globe, const PlanetCamera& camera, double aspect);

    /// False only for boxes of which nothing is seen; true for some that lie just beside.
    bool may_see(const OrientedBox& box) const;

private:
    Vector3 eye_m_;
    std::array<Vector3, 5> inwards_; ///< unit normals of planes through the eye
};

} // namespace duskline
