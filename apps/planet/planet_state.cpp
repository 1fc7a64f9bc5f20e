#include "planet_state.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/light/sun_position.h>

#include <algorithm>
#include <cmath>

namespace duskline::planet_app {

const std::vector<TechniqueName>& planet_techniques()
{
    static const std::vector<TechniqueName> techniques = {
        {PlanetTechnique::none, "none", "ground that faces away from the sun alone is dark"},
        {PlanetTechnique::shadow_map, "shadow-map", "a depth map that goes with the viewer"},
        {PlanetTechnique::fronts, "fronts", "shadow heights of all tiles, exact on every level"},
    };
    return techniques;
}

PlanetTechnique technique_named(std::string_view name)
{
    const auto found = std::ranges::find(planet_techniques(), name, &TechniqueName::name);
    if (found != planet_techniques().end())
        return found->technique;
    std::string names;
    for (const TechniqueName& known : planet_techniques())
        names += (names.empty() ? "" : ", ") + std::string(known.name);
    throw InvalidInput("no technique is called '" + std::string(name) + "'; there are: " + names);
}

std::string_view name_of(PlanetTechnique technique)
{
    return std::ranges::find(planet_techniques(), technique, &TechniqueName::technique)->name;
}

PlanetCamera camera_at(const PlanetTerrain& terrain, const PlanetPose& pose)
{
    const Vector3 direction = direction_at(terrain.globe(), pose.place);
    const auto ground_m = static_cast<double>(terrain.height_m(direction, terrain.deepest_level()));
    PlanetCamera camera = camera_over(terrain.globe(), pose.place, ground_m + pose.clearance_m);
    camera.heading = pose.heading;
    camera.pitch = pose.pitch;
    camera.vertical_view = pose.vertical_view;
    return camera;
}

PlanetPose pose_of(const PlanetTerrain& terrain, const PlanetCamera& camera)
{
    return {lon_lat_of(terrain.globe(), normalized(camera.eye_m)), clearance_m(camera, terrain),
            camera.heading, camera.pitch, camera.vertical_view};
}

Vector3 sun_direction(const Globe& globe, const SunAngles& angles, const LonLat& place)
{
    const LocalFrame here = local_frame(globe, direction_at(globe, place));
    const auto [sin_azimuth, cos_azimuth] = sine_cosine(angles.azimuth);
    const auto [sin_altitude, cos_altitude] = sine_cosine(angles.altitude);
    return normalized((here.east * sin_azimuth + here.north * cos_azimuth) * cos_altitude
                      + here.up * sin_altitude);
}

SunAngles sun_angles(const Globe& globe, const Vector3& sun, const LonLat& place)
{
    const LocalFrame here = local_frame(globe, direction_at(globe, place));
    return {wrapped_to_circle(Angle::from_radians(std::atan2(dot(sun, here.east), dot(sun, here.north)))),
            Angle::from_radians(std::asin(std::clamp(dot(sun, here.up), -1.0, 1.0)))};
}

void bring_up_to_date(PlanetSun& sun)
{
    if (sun.time)
        sun.direction = duskline::sun_direction(sun.time->utc);
}

} // namespace duskline::planet_app
