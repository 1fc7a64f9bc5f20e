#include "planet_scene.h"

#include "stopwatch.h"

#include <duskline/gl/context.h>

#include <algorithm>
#include <cmath>

namespace duskline::planet_app {
namespace {

constexpr std::size_t kAll = 1U << 20U;

constexpr double kCastersOverClearance = 20.0;
constexpr double kLongestShadow = 15.0; // over the height of what casts it

gl::PlanetView view_of(const Globe& globe, const PlanetState& state, std::size_t width, std::size_t height)
{
    return {.eye_m = state.camera.eye_m,
            .axes = axes_of(globe, state.camera),
            .vertical_view = state.camera.vertical_view,
            .width = width,
            .height = height,
            .show_made = state.show_made};
}

gl::PlanetLight light_of(const ViewedPlanet& viewed, const PlanetState& state)
{
    gl::PlanetLight light;
    light.to_sun = state.sun.direction;
    light.ambient = viewed.air ? state.ambient : 0.2f * state.ambient;
    light.exposure = state.exposure;
    light.air = viewed.air;
    light.living = viewed.living;
    return light;
}

// From the middle of the picture to its corners.
Angle half_view(const PlanetCamera& camera, double aspect)
{
    const double upwards = tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    return Angle::from_radians(std::atan(upwards * std::hypot(1.0, aspect)));
}

// The part of space that a shadow box and its casters take.
OrientedBox space_of(const ShadowBox& box)
{
    const double half_m = box.side_m / 2.0;
    return {box.centre_m + box.axes.towards_light * (box.caster_reach_m / 2.0),
            {box.axes.right, box.axes.up, box.axes.towards_light},
            {half_m, half_m, half_m + box.caster_reach_m / 2.0}};
}

// Around the eye as far as fine tiles reach, and on towards the sun as far as long shadows do.
OrientedBox space_of_casters(const PlanetTerrain& terrain, const PlanetState& state)
{
    const double half_m = kCastersOverClearance * std::max(100.0, clearance_m(state.camera, terrain));
    const double longest_m =
        std::min(half_m, kLongestShadow * static_cast<double>(terrain.heights().highest_m));
    const LightAxes axes = light_axes(state.sun.direction);
    return {state.camera.eye_m + axes.towards_light * (longest_m / 2.0),
            {axes.right, axes.up, axes.towards_light},
            {half_m, half_m, half_m + longest_m / 2.0}};
}

} // namespace

PlanetScene::PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources, double square_pixels,
                         const Execution& execution)
    : viewed_(viewed), sources_(sources), execution_(execution),
      quadtree_(*viewed.terrain, {.square_pixels = square_pixels, .look_around = true}, execution),
      renderer_(sources, viewed.terrain->globe(),
                [this](const PlanetTile& tile) -> const TileHeights& { return quadtree_.heights_of(tile); })
{}

void PlanetScene::update_shadow_map(const PlanetState& state, std::size_t width, std::size_t height)
{
    if (!map_ || map_options_ != state.shadow_map) {
        map_.emplace(sources_, state.shadow_map);
        map_options_ = state.shadow_map;
    }
    const PlanetTerrain& terrain = *viewed_.terrain;
    const Globe& globe = terrain.globe();
    const PlanetCamera& camera = state.camera;
    const double aspect = static_cast<double>(width) / static_cast<double>(height);
    const double highest_m = static_cast<double>(terrain.heights().highest_m);
    const ShadowView view = {.eye_m = camera.eye_m,
                             .forward = axes_of(globe, camera).forward,
                             .up = local_frame(globe, normalized(camera.eye_m)).up,
                             .half_view = half_view(camera, aspect),
                             .clearance_m = clearance_m(camera, terrain),
                             .highest_above_eye_m = highest_m - height_m(globe, camera.eye_m),
                             .curvature_per_m = 1.0 / globe.equatorial_radius_m,
                             .towards_light = state.sun.direction};
    if (!quadtree_.settled())
        map_->casters_changed();
    map_->update(view, [&](const ShadowBox& box) {
        const std::vector<PlanetPatch> casters = quadtree_.casters(space_of(box));
        renderer_.draw_depth(camera.eye_m, box_to_clip(box, camera.eye_m), casters);
    });
}

void PlanetScene::know_tile(const PlanetTile& tile)
{
    if (tile.level > 0 && !known_.contains(parent_of(tile)))
        know_tile(parent_of(tile));
    const std::shared_ptr<const TileHeights>& heights = quadtree_.tiles().find(tile)->heights;
    std::shared_ptr<const TileHeights>& known = known_[tile];
    if (known == heights)
        return;
    known = heights;
    fronts_->insert(tile, heights);
}

// What the fronts know: tiles that are drawn, what else is there around the eye and may cast shadows on them, and the
// ancestors of all; each until the quadtree throws it out.
void PlanetScene::follow_tiles(const PlanetState& state)
{
    std::erase_if(known_, [&](const auto& entry) {
        const LoadedTile* loaded = quadtree_.tiles().find(entry.first);
        const bool gone = loaded == nullptr || loaded->heights != entry.second;
        if (gone)
            fronts_->erase(entry.first);
        return gone;
    });
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        know_tile({face, 0, 0, 0});
    for (const PlanetPatch& patch : quadtree_.patches())
        know_tile(patch.tile);
    for (const PlanetPatch& patch : quadtree_.casters(space_of_casters(*viewed_.terrain, state)))
        know_tile(patch.tile);
}

void PlanetScene::update_fronts(const PlanetState& state, std::size_t tiles)
{
    if (!fronts_)
        fronts_.emplace(viewed_.terrain->globe(), state.sun.direction);
    fronts_->set_sun(state.sun.direction);
    follow_tiles(state);
    if (tiles == kAll)
        fronts_->settle(execution_);
    else
        fronts_->update(tiles, execution_);
}

gl::PlanetShadow PlanetScene::shadow_of(const PlanetState& state) const
{
    gl::PlanetShadow shadow;
    if (state.technique == PlanetTechnique::shadow_map) {
        shadow.map = &*map_;
        shadow.look = state.shadow_look;
    } else if (state.technique == PlanetTechnique::fronts) {
        shadow.heights_of = [this](const PlanetTile& tile) {
            const std::shared_ptr<const TileShadow> found = fronts_->shadow_of(tile);
            return found ? std::shared_ptr<const Grid<float>>(found, &found->heights_m) : nullptr;
        };
    }
    return shadow;
}

gl::DrawnPlanet PlanetScene::draw_picture(const PlanetState& state, std::size_t width, std::size_t height)
{
    return renderer_.draw(view_of(viewed_.terrain->globe(), state, width, height), light_of(viewed_, state),
                          quadtree_.patches(), shadow_of(state));
}

void PlanetScene::probe(const PlanetState& state, std::size_t width, std::size_t height)
{
    renderer_.probe_ground(view_of(viewed_.terrain->globe(), state, width, height), light_of(viewed_, state),
                           quadtree_.patches(), shadow_of(state));
}

FrameCost PlanetScene::draw(const PlanetState& state, std::size_t width, std::size_t height,
                            const FrameBudget& budget, bool wait)
{
    const auto timed = [wait](double& ms, const auto& work) {
        double seconds = 0.0;
        {
            const cli::Stopwatch watch(seconds);
            work();
            if (wait)
                gl::wait_until_done();
        }
        ms = 1000.0 * seconds;
    };
    FrameCost cost;
    timed(cost.load_ms, [&] { quadtree_.update(state.camera, width, height, budget.loads, execution_); });
    timed(cost.cast_ms, [&] {
        if (state.technique == PlanetTechnique::shadow_map)
            update_shadow_map(state, width, height);
        else if (state.technique == PlanetTechnique::fronts)
            update_fronts(state, budget.shadows);
    });
    timed(cost.draw_ms, [&] { cost.drawn = draw_picture(state, width, height); });
    cost.settled = quadtree_.settled() && (state.technique != PlanetTechnique::fronts || fronts_->settled());
    return cost;
}

FrameCost PlanetScene::draw_settled(const PlanetState& state, std::size_t width, std::size_t height)
{
    do
        quadtree_.update(state.camera, width, height, kAll, execution_);
    while (!quadtree_.settled());
    return draw(state, width, height, {kAll, kAll});
}

} // namespace duskline::planet_app
