#include "planet_frame.h"

#include "stopwatch.h"

#include <duskline/gl/context.h>

namespace duskline::planet_app {
namespace {

double milliseconds(bool wait, const auto& work)
{
    double seconds = 0.0;
    {
        const cli::Stopwatch watch(seconds);
        work();
        if (wait)
            gl::wait_until_done();
    }
    return 1000.0 * seconds;
}

} // namespace

double load_tiles(PlanetScene& scene, const PlanetState& state, std::size_t width, std::size_t height,
                  const FrameBudget& budget, bool wait)
{
    return milliseconds(wait, [&] { scene.load(state, width, height, budget.loads); });
}

double light_lamps(PlanetScene& scene, const PlanetState& state, bool exact, bool wait)
{
    return milliseconds(wait, [&] { scene.update_lamps(state, exact); });
}

FrameCost draw_loaded(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                      std::size_t width, std::size_t height, const FrameBudget& budget, bool wait)
{
    FrameCost cost;
    cost.cast_ms = milliseconds(wait, [&] { shadowing.update(state, width, height, budget.shadows); });
    cost.draw_ms =
        milliseconds(wait, [&] { cost.drawn = scene.draw(state, width, height, shadowing.shadow(state)); });
    cost.settled = scene.quadtree().settled() && shadowing.settled(state);
    return cost;
}

FrameCost draw_frame(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                     std::size_t width, std::size_t height, const FrameBudget& budget, bool wait)
{
    const double load_ms = load_tiles(scene, state, width, height, budget, wait);
    const double lamps_ms = light_lamps(scene, state, false, wait);
    FrameCost cost = draw_loaded(scene, shadowing, state, width, height, budget, wait);
    cost.load_ms = load_ms;
    cost.lamps_ms = lamps_ms;
    return cost;
}

FrameCost draw_settled(PlanetScene& scene, PlanetShadowing& shadowing, const PlanetState& state,
                       std::size_t width, std::size_t height)
{
    scene.load_all(state, width, height);
    light_lamps(scene, state, true);
    return draw_loaded(scene, shadowing, state, width, height, {.loads = kAllTiles, .shadows = {}});
}

} // namespace duskline::planet_app
