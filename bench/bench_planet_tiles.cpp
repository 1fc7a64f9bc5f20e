// How long tiles of a planet take to make, and what a flight from space to the ground needs of them: the numbers of
// docs/planet.md. Where the flight is, is the share of its way in per cent.
//
//   build/release/bench/bench_planet_tiles
//   build/release/bench/bench_planet_tiles --benchmark_filter=flight

#include <duskline/planet/planet_flight.h>
#include <duskline/planet/planet_quadtree.h>
#include <duskline/raster_io/read_planet_source.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

const PlanetTerrain& earth()
{
    static const PlanetTerrain terrain = [] {
        std::vector<PlanetSource> sources;
        for (const char* file : {DUSKLINE_DATA "/etopo20_world.tif", DUSKLINE_DATA "/hawaii_2048.tif"})
            sources.push_back(read_planet_source(file).source);
        return PlanetTerrain(kWgs84, std::move(sources));
    }();
    return terrain;
}

constexpr LonLat kMaunaKea = {Angle::from_degrees(-155.55), Angle::from_degrees(19.75)};

PlanetCamera on_the_way(std::int64_t percent)
{
    return fly_down(earth(), {.place = kMaunaKea, .last_pitch = Angle::from_degrees(-3.0)},
                    static_cast<double>(percent) / 100.0);
}

void tile(benchmark::State& state)
{
    const PlanetTile tile =
        place_in_tile(direction_at(kWgs84, kMaunaKea), static_cast<std::uint32_t>(state.range(0))).tile;
    earth();
    for (auto _ : state)
        benchmark::DoNotOptimize(earth().heights_of(tile));
}
BENCHMARK(tile)->Arg(0)->Arg(4)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);

// Chooses again what is settled; the tiles are those of the whole way.
void flight(benchmark::State& state)
{
    PlanetQuadtree quadtree(earth());
    for (std::int64_t percent = 0; percent <= state.range(0); percent += 10)
        quadtree.update(on_the_way(percent), 1024, 768, std::numeric_limits<std::size_t>::max());
    const PlanetCamera camera = on_the_way(state.range(0));
    for (auto _ : state)
        quadtree.update(camera, 1024, 768, 0);
    const auto level = [](const PlanetPatch& patch) { return patch.tile.level; };
    const auto [coarsest, finest] = std::ranges::minmax(quadtree.patches(), {}, level);
    state.counters["over_ground_m"] = clearance_m(camera, earth());
    state.counters["drawn"] = static_cast<double>(quadtree.patches().size());
    state.counters["coarsest"] = coarsest.tile.level;
    state.counters["finest"] = finest.tile.level;
    state.counters["held"] = static_cast<double>(quadtree.tiles().size());
}
BENCHMARK(flight)->DenseRange(0, 100, 10)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace duskline

BENCHMARK_MAIN();
