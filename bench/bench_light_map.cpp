// What a light map costs once its shadows are known: normals once, and then every light. Each map is first compared
// with its formula, cell by cell in double precision.
//
//   build/release/bench/bench_light_map

#include <duskline/casting/exact.h>
#include <duskline/products/light_map.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace duskline {
namespace {

constexpr std::size_t kSide = 2048;
constexpr double kMostOff = 1e-5;

Execution one_thread()
{
    return {.threads = 1};
}

const Terrain& mountains()
{
    static const Terrain terrain = make_mountains({.grid = {kSide, kSide, {30.0, 30.0}}, .seed = 7});
    return terrain;
}

const NormalField& normals()
{
    static const NormalField field = upward_normals(mountains());
    return field;
}

const DirectionalLight kSun{Angle::from_degrees(203.0), Angle::from_degrees(20.0)};

const ShadowMask& mask()
{
    static const ShadowMask lit = cast_by_exact(mountains(), kSun);
    return lit;
}

Vector3 towards(const MapLight& light, std::size_t row, std::size_t column)
{
    if (const auto* sun = std::get_if<DirectionalLight>(&light.source))
        return direction_towards(*sun);
    const GridPoint& lamp = std::get<PointLight>(light.source).position;
    return {(lamp.column - static_cast<double>(column)) * mountains().cell_size_m.x,
            (static_cast<double>(row) - lamp.row) * mountains().cell_size_m.y,
            lamp.height_m - mountains().heights_m(row, column)};
}

// The formula of light_map.h for one light by Lambert's model, everywhere lit or as the mask says.
double expected(const MapLight& light, const LightMapOptions& options, bool masked, std::size_t row,
                std::size_t column)
{
    const Vector3 to = towards(light, row, column);
    const double length = std::hypot(to.x, to.y, to.z);
    const double facing = (normals().east(row, column) * to.x + normals().north(row, column) * to.y
                           + normals().up(row, column) * to.z)
                          / length;
    const bool is_sun = std::holds_alternative<DirectionalLight>(light.source);
    const double strength = light.strength * (is_sun ? 1.0 : std::pow(light.reach_m / length, 2.0));
    const bool lit = !masked || mask()(row, column) == Lit::yes;
    return std::clamp(options.ambient + (lit ? strength * std::max(facing, 0.0) : 0.0), 0.0, 1.0);
}

double farthest_off(const LightMap& map, const MapLight& light, const LightMapOptions& options, bool masked)
{
    double off = 0.0;
    for (std::size_t row = 0; row < kSide; ++row)
        for (std::size_t column = 0; column < kSide; ++column)
            off = std::max(off, std::abs(map.channels.front()(row, column)
                                         - expected(light, options, masked, row, column)));
    return off;
}

void bench_normals(benchmark::State& state)
{
    mountains();
    for (auto _ : state)
        benchmark::DoNotOptimize(upward_normals(mountains(), one_thread()));
}

void bench_map(benchmark::State& state, MapLight light, bool masked)
{
    if (masked)
        light.lit = mask().view();
    const LightMapOptions options;
    const double off =
        farthest_off(light_map(mountains(), normals(), {&light, 1}, options), light, options, masked);
    if (!(off < kMostOff)) {
        state.SkipWithError(("off its formula by " + std::to_string(off)).c_str());
        return;
    }
    for (auto _ : state)
        benchmark::DoNotOptimize(light_map(mountains(), normals(), {&light, 1}, options, one_thread()));
    state.counters["Mcells/s"] = benchmark::Counter(static_cast<double>(kSide * kSide) / 1e6,
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

void add_all()
{
    const auto timed = [](auto* bench) { bench->Unit(benchmark::kMillisecond)->Repetitions(5); };
    const MapLight sun{.source = kSun, .strength = 0.8};
    MapLight warm = sun;
    warm.colour = {1.0f, 0.8f, 0.5f};
    const MapLight lamp{.source = PointLight{{1000.3, 900.7, 6000.0}}, .strength = 0.5, .reach_m = 8000.0};
    timed(benchmark::RegisterBenchmark("normals", bench_normals));
    timed(benchmark::RegisterBenchmark("sun", bench_map, sun, false));
    timed(benchmark::RegisterBenchmark("sun_and_mask", bench_map, sun, true));
    timed(benchmark::RegisterBenchmark("lamp", bench_map, lamp, false));
    timed(benchmark::RegisterBenchmark("sun_in_colour", bench_map, warm, true));
}

} // namespace
} // namespace duskline

int main(int argc, char** argv)
{
    duskline::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
