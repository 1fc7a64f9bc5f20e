#include "planet_shadowing.h"

#include "stopwatch.h"

#include <algorithm>
#include <cmath>

namespace duskline::planet_app {
namespace {

constexpr double kCastersOverClearance = 20.0;
constexpr double kLongestShadow = 15.0; // over the height of what casts it

// From the middle of the picture to its corners.
Angle half_view(const PlanetCamera& camera, double aspect)
{
    const double upwards = tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    return Angle::from_radians(std::atan(upwards * std::hypot(1.0, aspect)));
}

ShadowView shadow_view(const PlanetTerrain& terrain, const PlanetState& state, double aspect)
{
    const Globe& globe = terrain.globe();
    const PlanetCamera& camera = state.camera;
    const auto highest_m = static_cast<double>(terrain.heights().highest_m);
    return {.eye_m = camera.eye_m,
            .forward = axes_of(globe, camera).forward,
            .up = local_frame(globe, normalized(camera.eye_m)).up,
            .half_view = half_view(camera, aspect),
            .clearance_m = clearance_m(camera, terrain),
            .highest_above_eye_m = highest_m - height_m(globe, camera.eye_m),
            .curvature_per_m = 1.0 / globe.equatorial_radius_m,
            .towards_light = state.sun.direction};
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

void PlanetShadowing::update(const PlanetState& state, std::size_t width, std::size_t height,
                             const ShadowBudget& budget)
{
    if (state.technique == PlanetTechnique::shadow_map)
        update_shadow_map(state, width, height);
    else if (state.technique == PlanetTechnique::fronts)
        update_fronts(state, budget);
}

void PlanetShadowing::update_shadow_map(const PlanetState& state, std::size_t width, std::size_t height)
{
    if (!map_ || map_->options() != state.shadow_map)
        map_.emplace(scene_.sources(), state.shadow_map);
    if (ground_of_map_ != scene_.ground_number())
        map_->casters_changed();
    ground_of_map_ = scene_.ground_number();
    const double aspect = static_cast<double>(width) / static_cast<double>(height);
    map_->update(shadow_view(scene_.terrain(), state, aspect),
                 [&](const ShadowBox& box) { scene_.draw_casters(state.camera.eye_m, box); });
}

void PlanetShadowing::know_tile(const PlanetTile& tile)
{
    if (tile.level > 0 && !known_.contains(parent_of(tile)))
        know_tile(parent_of(tile));
    const std::shared_ptr<const TileHeights>& heights = scene_.quadtree().tiles().find(tile)->heights;
    std::shared_ptr<const TileHeights>& known = known_[tile];
    if (known == heights)
        return;
    known = heights;
    fronts_->insert(tile, heights);
}

// What the fronts know: tiles that are drawn, what else is there around the eye and may cast shadows on them, and the
// ancestors of all; each until the quadtree throws it out.
void PlanetShadowing::follow_tiles(const PlanetState& state)
{
    const PlanetQuadtree& quadtree = scene_.quadtree();
    std::erase_if(known_, [&](const auto& entry) {
        const LoadedTile* loaded = quadtree.tiles().find(entry.first);
        const bool gone = loaded == nullptr || loaded->heights != entry.second;
        if (gone)
            fronts_->erase(entry.first);
        return gone;
    });
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        know_tile({face, 0, 0, 0});
    for (const PlanetPatch& patch : quadtree.patches())
        know_tile(patch.tile);
    for (const PlanetPatch& patch : quadtree.casters(space_of_casters(scene_.terrain(), state)))
        know_tile(patch.tile);
}

void PlanetShadowing::make_fronts(const PlanetState& state)
{
    const Globe& globe = scene_.terrain().globe();
    known_.clear();
    fronts_of_disc_ = state.soft;
    fronts_ = state.soft ? PlanetShadows::of_disc(globe, state.sun.direction, gl::PlanetLight().sun_radius)
                         : PlanetShadows(globe, state.sun.direction);
}

void PlanetShadowing::update_fronts(const PlanetState& state, const ShadowBudget& budget)
{
    if (!fronts_ || fronts_of_disc_ != state.soft)
        make_fronts(state);
    fronts_->set_sun(state.sun.direction);
    follow_tiles(state);
    if (budget.tiles == kAllTiles) {
        fronts_->settle(scene_.execution());
        return;
    }
    double seconds = 0.0;
    std::size_t done = 0;
    do {
        const cli::Stopwatch watch(seconds);
        done = fronts_->update(budget.tiles, scene_.execution());
    } while (done > 0 && 1000.0 * seconds < budget.ms);
}

gl::PlanetShadow PlanetShadowing::shadow(const PlanetState& state) const
{
    gl::PlanetShadow shadow;
    if (state.technique == PlanetTechnique::shadow_map) {
        shadow.map = &*map_;
        shadow.look = state.shadow_look;
    } else if (state.technique == PlanetTechnique::fronts) {
        shadow.shadows_of = [this](const PlanetTile& tile) { return fronts_->shown(tile); };
        shadow.of_disc = fronts_of_disc_;
    }
    return shadow;
}

bool PlanetShadowing::settled(const PlanetState& state) const
{
    return state.technique != PlanetTechnique::fronts || fronts_->settled();
}

} // namespace duskline::planet_app
