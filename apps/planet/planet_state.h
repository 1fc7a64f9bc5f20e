#pragma once

#include "placed_lamp.h"

#include <duskline/gl/shadow_map.h>
#include <duskline/light/date_time.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/planet_camera.h>
#include <duskline/planet/planet_terrain.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duskline::planet_app {

/// Where somebody looks from, as people say it. Heading clockwise from north, pitch above the horizontal.
struct PlanetPose {
    LonLat place = {Angle::from_degrees(-155.47), Angle::from_degrees(19.4)};
    double clearance_m = 40000.0; ///< over the ground
    Angle heading = {};
    Angle pitch = Angle::from_degrees(-35.0);
    Angle vertical_view = Angle::from_degrees(45.0);
};

/// The sun: of a moment, or where it was put.
struct PlanetSun {
    std::optional<DateTime> time;        ///< then the direction is what the sun has at that moment
    Vector3 direction = {1.0, 0.0, 0.0}; ///< unit vector in the planet's frame
    double clock_s_per_s = 600.0;        ///< how fast the clock runs
};

/// How shadows are found.
enum class PlanetTechnique : std::uint8_t { none, shadow_map, fronts };

struct TechniqueName {
    PlanetTechnique technique;
    std::string_view name;
    std::string_view description;
};
/// All there are.
const std::vector<TechniqueName>& planet_techniques();

/// Throws InvalidInput, listing the names there are.
PlanetTechnique technique_named(std::string_view name);
std::string_view name_of(PlanetTechnique technique);

/// Everything that can be set while looking, and nothing that follows from the files.
struct PlanetState {
    PlanetCamera camera;
    PlanetSun sun;
    PlanetTechnique technique = PlanetTechnique::fronts;
    bool soft = false; ///< fronts: the sun is a disc that may be seen in part
    gl::ShadowMapOptions shadow_map;
    gl::ShadowMapLook shadow_look;
    std::vector<PlacedLamp> lamps; ///< at most kMostLamps; beside the sun
    double square_pixels = 4.0;    ///< of the mesh: PlanetQuadtreeOptions
    float ambient = 0.25f;         ///< 0 to below 1
    float exposure = 1.0f;         ///< above 0
    bool show_made = false;        ///< mark what no file has measured
};

/// The camera of a pose.
PlanetCamera camera_at(const PlanetTerrain& terrain, const PlanetPose& pose);

/// The pose of a camera.
PlanetPose pose_of(const PlanetTerrain& terrain, const PlanetCamera& camera);

/// Azimuth clockwise from north and altitude over the horizontal of a place, without refraction.
struct SunAngles {
    Angle azimuth;
    Angle altitude;
};
SunAngles sun_angles(const Globe& globe, const Vector3& sun, const LonLat& place);
Vector3 sun_direction(const Globe& globe, const SunAngles& angles, const LonLat& place);

/// Sets the direction from the time, if there is one.
void bring_up_to_date(PlanetSun& sun);

} // namespace duskline::planet_app
