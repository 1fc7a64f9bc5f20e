#include "placed_lamp.h"

#include "option_values.h"
#include "planet_state.h"

#include <fmt/format.h>

namespace duskline::planet_app {

const window::LampPlaceForm& lamp_place_form()
{
    static constexpr window::LampPlaceForm form = {"LON,LAT,HEIGHT", "-155.62,20.1,30",
                                                   "at a place, so many metres over the ground"};
    return form;
}

PlacedLamp placed_lamp(const window::TypedLamp& typed)
{
    const auto number = [&](std::size_t i, const char* name, const cli::Range& range) {
        return cli::parse_number(fmt::format("{} of {}", name, typed.option), typed.place.at(i), range);
    };
    const double longitude_deg = number(0, "the longitude", {.least = -180.0, .most = 360.0});
    const double latitude_deg = number(1, "the latitude", {.least = -90.0, .most = 90.0});
    const double clearance_m = number(2, "the height over the ground", {.least = 0.1, .most = 1e7});
    return {
        {Angle::from_degrees(longitude_deg), Angle::from_degrees(latitude_deg)}, clearance_m, typed.light};
}

std::string option_of(const PlacedLamp& lamp)
{
    return window::option_of(fmt::format("{},{},{}", window::degrees_text(lamp.place.longitude),
                                         window::degrees_text(lamp.place.latitude),
                                         window::metres_text(lamp.clearance_m)),
                             lamp.light);
}

PlacedLamp lamp_at_eye(const PlanetTerrain& terrain, const PlanetCamera& camera,
                       const window::LampSettings& light)
{
    const PlanetPose pose = pose_of(terrain, camera);
    return {pose.place, pose.clearance_m, light};
}

window::LampBeam beam_of_view(const PlanetCamera& camera)
{
    return {camera.heading, camera.pitch, Angle::from_degrees(camera.vertical_view.degrees() / 4.0)};
}

SceneLamp scene_lamp(const PlanetTerrain& terrain, const PlacedLamp& lamp)
{
    const window::LampBeam beam = lamp.light.beam.value_or(window::LampBeam{});
    return window::scene_lamp(
        lamp.light, camera_at(terrain, {.place = lamp.place, .clearance_m = lamp.clearance_m}).eye_m,
        sun_direction(terrain.globe(), {beam.azimuth, beam.altitude}, lamp.place));
}

} // namespace duskline::planet_app
