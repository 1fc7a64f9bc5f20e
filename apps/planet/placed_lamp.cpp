#include "placed_lamp.h"

#include "planet_state.h"

#include <cmath>

namespace duskline::planet_app {

PlacedLamp usual_lamp(const LonLat& place, double clearance_m)
{
    return {.place = place, .clearance_m = clearance_m};
}

PlacedLamp usual_searchlight(const LonLat& place, double clearance_m, const LampBeam& beam)
{
    return {.place = place, .clearance_m = clearance_m, .beam = beam, .reach_m = 1000.0, .range_m = 20000.0};
}

LampBeam beam_of_view(const PlanetCamera& camera)
{
    return {camera.heading, camera.pitch, Angle::from_degrees(camera.vertical_view.degrees() / 4.0)};
}

PlacedLamp lamp_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera)
{
    const PlanetPose pose = pose_of(terrain, camera);
    return usual_lamp(pose.place, pose.clearance_m);
}

PlacedLamp searchlight_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera)
{
    const PlanetPose pose = pose_of(terrain, camera);
    return usual_searchlight(pose.place, pose.clearance_m, beam_of_view(camera));
}

SceneLamp scene_lamp(const PlanetTerrain& terrain, const PlacedLamp& lamp)
{
    SceneLamp scene;
    scene.position_m = camera_at(terrain, {.place = lamp.place, .clearance_m = lamp.clearance_m}).eye_m;
    if (lamp.beam) {
        scene.direction =
            sun_direction(terrain.globe(), {lamp.beam->azimuth, lamp.beam->altitude}, lamp.place);
        scene.half_angle = lamp.beam->half_angle;
    }
    scene.soft_edge = lamp.soft_edge;
    scene.colour = {lamp.colour.red, lamp.colour.green, lamp.colour.blue};
    scene.bright_m = lamp.reach_m * std::sqrt(lamp.strength);
    scene.range_m = lamp.range_m;
    return scene;
}

} // namespace duskline::planet_app
