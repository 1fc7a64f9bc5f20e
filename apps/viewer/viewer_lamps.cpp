#include "viewer_lamps.h"

#include "exit_code.h"
#include "option_values.h"
#include "viewer_files.h"

#include <duskline/raster_io/map_place.h>
#include <duskline/terrain/ground_height.h>

#include <fmt/format.h>

namespace duskline::viewer {
namespace {

// Azimuth clockwise from the map's north, altitude above the horizontal.
Vector3 direction_of(const window::LampBeam& beam)
{
    const auto [east, north] = sine_cosine(beam.azimuth);
    const auto [up, ahead] = sine_cosine(beam.altitude);
    return {east * ahead, north * ahead, up};
}

} // namespace

std::vector<SceneLamp> shining(std::span<const ViewerLamp> lamps)
{
    std::vector<SceneLamp> on;
    for (const ViewerLamp& lamp : lamps)
        if (lamp.light.on)
            on.push_back(window::scene_lamp(lamp.light, lamp.position_m,
                                            direction_of(lamp.light.beam.value_or(window::LampBeam{}))));
    return on;
}

window::LampBeam beam_of_view(const Camera& camera)
{
    return {camera.heading, camera.pitch, Angle::from_degrees(camera.vertical_view.degrees() / 4.0)};
}

const window::LampPlaceForm& lamp_place_form()
{
    static constexpr window::LampPlaceForm form = {
        "X,Y,Z", "243500,2193200,+30",
        "beside the sun, at map coordinates X,Y, Z metres high or +Z metres above the ground"};
    return form;
}

MapLamp map_lamp(const window::TypedLamp& typed)
{
    const auto number = [&](std::size_t i, const char* name) {
        return cli::parse_number(fmt::format("{} of {}", name, typed.option), typed.place.at(i));
    };
    return {fmt::format("{} {},{},{}", typed.option, typed.place[0], typed.place[1], typed.place[2]),
            number(0, "X"),
            number(1, "Y"),
            number(2, "Z"),
            typed.place[2].starts_with('+'),
            typed.light};
}

ViewerLamp placed_lamp(const MapLamp& lamp, const ViewedTerrain& viewed)
{
    const GridPlace at = grid_place(viewed.file.facts(), lamp.x, lamp.y);
    const HeightField seen = viewed.ground->terrain();
    const std::optional<double> ground_m = ground_height_m(seen, at.row, at.column);
    const std::optional<double> at_rest_m = ground_height_m(viewed.ground->at_rest(), at.row, at.column);
    if (!ground_m || !at_rest_m)
        throw cli::UsageError(fmt::format(
            "{}: there is no ground at that place (outside the raster, or no data)", lamp.option));
    // Over the ground as it is seen, lowered by the earth's curvature.
    const double over_m = lamp.above_ground ? lamp.z_m : lamp.z_m - viewed.file.facts().base_m - *at_rest_m;
    return {position_m({at.row, at.column, *ground_m + over_m}, seen.cell_size_m), lamp.light};
}

} // namespace duskline::viewer
