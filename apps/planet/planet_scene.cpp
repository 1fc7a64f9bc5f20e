#include "planet_scene.h"

#include <duskline/planet/caster_space.h>

#include <limits>

namespace duskline::planet_app {
namespace {

gl::PlanetView view_of(const Globe& globe, const PlanetState& state, std::size_t width, std::size_t height)
{
    return {.eye_m = state.camera.eye_m,
            .axes = axes_of(globe, state.camera),
            .vertical_view = state.camera.vertical_view,
            .width = width,
            .height = height,
            .show_made = state.show_made};
}

} // namespace

PlanetScene::PlanetScene(const ViewedPlanet& viewed, const gl::ShaderSources& sources, double square_pixels,
                         const Execution& execution)
    : viewed_(viewed), sources_(sources), execution_(execution),
      quadtree_(*viewed.terrain, {.square_pixels = square_pixels, .look_around = true}, execution),
      renderer_(sources, viewed.terrain->globe(),
                [this](const PlanetTile& tile) -> const TileHeights& { return quadtree_.heights_of(tile); }),
      lamps_(*viewed.terrain, quadtree_, renderer_)
{}

void PlanetScene::load(const PlanetState& state, std::size_t width, std::size_t height,
                       std::size_t most_tiles)
{
    quadtree_.update(state.camera, width, height, most_tiles, execution_);
    if (!quadtree_.changes().empty())
        ++ground_number_;
    renderer_.hold(quadtree_.patches());
}

void PlanetScene::load_all(const PlanetState& state, std::size_t width, std::size_t height)
{
    do
        load(state, width, height, std::numeric_limits<std::size_t>::max());
    while (!quadtree_.settled());
}

gl::PlanetLight PlanetScene::light_of(const PlanetState& state) const
{
    gl::PlanetLight light;
    light.to_sun = state.sun.direction;
    light.ambient = viewed_.air ? state.ambient : 0.2f * state.ambient;
    light.exposure = state.exposure;
    light.air = viewed_.air;
    light.living = viewed_.living;
    light.lamps = lamps_.maps();
    return light;
}

gl::DrawnPlanet PlanetScene::draw(const PlanetState& state, std::size_t width, std::size_t height,
                                  const gl::PlanetShadow& shadow)
{
    return renderer_.draw(view_of(terrain().globe(), state, width, height), light_of(state),
                          quadtree_.patches(), shadow);
}

void PlanetScene::probe(const PlanetState& state, std::size_t width, std::size_t height,
                        const gl::PlanetShadow& shadow)
{
    renderer_.probe_ground(view_of(terrain().globe(), state, width, height), light_of(state),
                           quadtree_.patches(), shadow);
}

std::span<const SceneLamp> PlanetScene::lamps() const
{
    return lamps_.maps() != nullptr ? lamps_.maps()->lamps() : std::span<const SceneLamp>();
}

void PlanetScene::probe_lamp(const PlanetState& state, std::size_t width, std::size_t height,
                             std::size_t lamp)
{
    renderer_.probe_lamp(view_of(terrain().globe(), state, width, height), light_of(state),
                         quadtree_.patches(), lamp);
}

void PlanetScene::draw_casters(const Vector3& eye_m, const ShadowBox& box)
{
    renderer_.draw_depth(eye_m, box_to_clip(box, eye_m), casters_of(quadtree_, box));
}

} // namespace duskline::planet_app
