#include "state_text.h"

#include "shadow_map_settings.h"

#include <fmt/format.h>

namespace duskline::planet_app {
namespace {

std::string sun_options(const PlanetSun& sun, const Globe& globe, const LonLat& place)
{
    if (sun.time)
        return "--time " + to_iso8601(*sun.time);
    const SunAngles angles = sun_angles(globe, sun.direction, place);
    return fmt::format("--azimuth {:.2f} --altitude {:.2f}", angles.azimuth.degrees(),
                       angles.altitude.degrees());
}

std::string shadow_options(const PlanetState& state)
{
    std::string text = "--technique " + std::string(name_of(state.technique));
    const std::string map = window::text_of({.options = state.shadow_map, .look = state.shadow_look});
    if (state.technique == PlanetTechnique::shadow_map && !map.empty())
        text += " --shadow-map " + map;
    if (state.technique == PlanetTechnique::fronts && state.soft)
        text += " --soft";
    return text;
}

} // namespace

std::string pose_options(const PlanetPose& pose)
{
    return fmt::format("--at {:.5f},{:.5f},{:.1f} --heading {:.1f} --pitch {:.1f}",
                       pose.place.longitude.degrees(), pose.place.latitude.degrees(), pose.clearance_m,
                       pose.heading.degrees(), pose.pitch.degrees());
}

std::string options_of(const PlanetTerrain& terrain, const PlanetState& state)
{
    const PlanetPose pose = pose_of(terrain, state.camera);
    std::string text =
        fmt::format("{} --view {:.0f} {} {}", pose_options(pose), pose.vertical_view.degrees(),
                    sun_options(state.sun, terrain.globe(), pose.place), shadow_options(state));
    for (const PlacedLamp& lamp : state.lamps)
        if (lamp.light.on)
            text += " " + option_of(lamp);
    return text;
}

} // namespace duskline::planet_app
