#include "planet_scene.h"

#include <duskline/products/daylight.h>

#include <cmath>
#include <limits>

namespace duskline::planet_app {

Vector3 eye_m(const PlanetTerrain& terrain, const PlanetPose& pose)
{
    const Vector3 direction = direction_at(terrain.globe(), pose.place);
    const auto ground_m = static_cast<double>(terrain.height_m(direction, terrain.deepest_level()));
    return point_m(terrain.globe(), direction, ground_m + pose.clearance_m);
}

CameraAxes axes_of(const Globe& globe, const PlanetPose& pose)
{
    const LocalFrame here = local_frame(globe, direction_at(globe, pose.place));
    const auto [sin_heading, cos_heading] = sine_cosine(pose.heading);
    const auto [sin_pitch, cos_pitch] = sine_cosine(pose.pitch);
    const Vector3 ahead = here.north * cos_heading + here.east * sin_heading;
    const Vector3 right = here.east * cos_heading - here.north * sin_heading;
    return {ahead * cos_pitch + here.up * sin_pitch, right, here.up * cos_pitch - ahead * sin_pitch};
}

PlanetScene::PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources)
    : viewed_(viewed),
      renderer_(sources, viewed.terrain->globe(),
                [this](const PlanetTile& tile) -> const TileHeights& { return heights_of(tile); })
{}

const TileHeights& PlanetScene::heights_of(const PlanetTile& tile)
{
    const auto found = tiles_.find(tile);
    return found != tiles_.end() ? found->second
                                 : tiles_.emplace(tile, viewed_.terrain->heights_of(tile)).first->second;
}

void PlanetScene::select(const PlanetTile& tile, const Vector3& eye, double reach,
                         std::vector<gl::PlanetPatch>& patches)
{
    const Globe& globe = viewed_.terrain->globe();
    const auto diagonal = [&](std::uint32_t level) {
        return std::sqrt(2.0) * kTileSquares * spacing_m(globe, level);
    };
    constexpr double never = std::numeric_limits<double>::infinity();
    const auto range = [&](std::uint32_t level) {
        const double end = reach * diagonal(level);
        return level == 0 ? MorphRange{never, never}
                          : MorphRange{std::min(0.95 * end, (reach / 2.0 + 1.0) * diagonal(level)), end};
    };
    const OrientedBox box = box_around(globe, tile, heights_of(tile).range);
    if (tile.level == viewed_.terrain->deepest_level() || distance_m(eye, box) >= range(tile.level + 1).end_m)
        patches.push_back({tile, range(tile.level)});
    else
        for (const PlanetTile& child : children_of(tile))
            select(child, eye, reach, patches);
}

FrameCost PlanetScene::draw_settled(const PlanetState& state, std::size_t width, std::size_t height)
{
    const Globe& globe = viewed_.terrain->globe();
    const gl::PlanetView view = {.eye_m = eye_m(*viewed_.terrain, state.pose),
                                 .axes = axes_of(globe, state.pose),
                                 .vertical_view = state.pose.vertical_view,
                                 .width = width,
                                 .height = height,
                                 .show_made = state.show_made};
    std::vector<gl::PlanetPatch> patches;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        select({face, 0, 0, 0}, view.eye_m, 2.5, patches);
    gl::PlanetLight light;
    light.to_sun = state.sun.direction;
    light.ambient = state.ambient;
    light.exposure = state.exposure;
    light.air = viewed_.air;
    light.living = viewed_.living;
    return {renderer_.draw(view, light, patches)};
}

} // namespace duskline::planet_app
