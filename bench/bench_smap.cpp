// What a silhouette map costs to build, by each search, and what it saves when it is asked, on the demo's elevation
// model. Answers are compared before anything is timed: the map's with the full scan that knows no map, and with
// fast-ray, from which lines along the light make it differ (`wrong_%`).
//
//   build/release/bench/bench_smap                                                    one thread, the usual suns
//   build/release/bench/bench_smap --benchmark_filter=203/altitude:5                  one sun
//   build/release/bench/bench_smap --benchmark_filter='build|map' --benchmark_enable_random_interleaving

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/ray.h>
#include <duskline/casting/smap.h>
#include <duskline/raster_io/read_height_field.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace duskline {
namespace {

Execution one_thread()
{
    return {.threads = 1};
}

// What lines along the light may change (docs/algorithms/smap.md).
constexpr double kMostWrong = 0.001;

struct Sun {
    int azimuth;
    int altitude;

    DirectionalLight light() const { return {Angle::from_degrees(azimuth), Angle::from_degrees(altitude)}; }
    auto operator<=>(const Sun&) const = default;
};

constexpr Sun kSuns[] = {{203, 20}, {203, 5}, {100, 20}, {100, 5}};

const Terrain& hawaii()
{
    static const Terrain terrain = [] {
        HeightFile file(DUSKLINE_DATA "/hawaii_2048.tif");
        return read_terrain(file);
    }();
    return terrain;
}

// The answers to a sun without any map; they take half a minute.
const ShadowMask& full_scan(const Sun& sun)
{
    static std::map<Sun, ShadowMask> known;
    if (const auto found = known.find(sun); found != known.end())
        return found->second;
    return known.emplace(sun, cast_by_full_scan(hawaii(), sun.light())).first->second;
}

double share_wrong(const ShadowMask& mask, const ShadowMask& truth)
{
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
        wrong += mask.values()[i] != truth.values()[i];
    return static_cast<double>(wrong) / static_cast<double>(mask.size());
}

bool check(benchmark::State& state, const Sun& sun, const SilhouetteMapOptions& options)
{
    const ShadowMask mask = SilhouetteMap(hawaii(), sun.light(), options).cast();
    const double wrong = share_wrong(mask, cast_by_fast_ray(hawaii(), sun.light()));
    state.counters["wrong_%"] = 100.0 * wrong;
    if (wrong > kMostWrong)
        state.SkipWithError("wrong in more cells than lines along the light can make");
    else if (share_wrong(mask, full_scan(sun)) > 0.0)
        state.SkipWithError("not the mask of the full scan");
    else
        return true;
    return false;
}

void count(benchmark::State& state, const Sun& sun, const SilhouetteMapOptions& options)
{
    const SilhouetteStatistics statistics = SilhouetteMap(hawaii(), sun.light(), options).statistics();
    const auto share = [](std::size_t part, std::size_t all) {
        return static_cast<double>(part) / static_cast<double>(all);
    };
    state.counters["black_%"] = 100.0 * share(statistics.black, statistics.texels);
    state.counters["look_ups"] = share(statistics.look_ups, statistics.cells);
    state.SetLabel(std::string(kernels::active_kernels().isa));
}

void time_build(benchmark::State& state, const Sun& sun, const SilhouetteMapOptions& options)
{
    if (!check(state, sun, options))
        return;
    for (auto _ : state)
        benchmark::DoNotOptimize(SilhouetteMap(hawaii(), sun.light(), options, one_thread()));
    count(state, sun, options);
}

void time_map(benchmark::State& state, const Sun& sun, const SilhouetteMapOptions& options)
{
    if (!check(state, sun, options))
        return;
    const SilhouetteMap map(hawaii(), sun.light(), options);
    for (auto _ : state)
        benchmark::DoNotOptimize(map.cast(one_thread()));
    count(state, sun, options);
}

void time_full_scan(benchmark::State& state, const Sun& sun)
{
    if (!check(state, sun, {}))
        return;
    for (auto _ : state)
        benchmark::DoNotOptimize(cast_by_full_scan(hawaii(), sun.light(), one_thread()));
}

template <typename Work>
benchmark::internal::Benchmark* add(const std::string& what, const Sun& sun, const Work& work)
{
    const std::string name =
        what + "/azimuth:" + std::to_string(sun.azimuth) + "/altitude:" + std::to_string(sun.altitude);
    return benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { work(state, sun); })
        ->Unit(benchmark::kMillisecond);
}

void add_all(const Sun& sun)
{
    constexpr std::pair<const char*, NextVSearch> searches[] = {
        {"binary", NextVSearch::binary},
        {"quad", NextVSearch::quad},
        {"parallel_quad", NextVSearch::parallel_quad}};
    // Clang 14 cannot capture structured bindings by their names.
    for (const auto& [name, search] : searches)
        add(std::string("build/") + name, sun, [by = search](benchmark::State& state, const Sun& from) {
            time_build(state, from, {.search = by});
        });
    for (const auto& [name, search] : searches)
        add(std::string("build_nearest/") + name, sun,
            [by = search](benchmark::State& state, const Sun& from) {
                time_build(state, from, {.search = by, .better_next_v = false});
            });
    add("map", sun, [](benchmark::State& state, const Sun& from) { time_map(state, from, {}); });
    add("map_nearest", sun,
        [](benchmark::State& state, const Sun& from) { time_map(state, from, {.better_next_v = false}); });
    add("full_scan", sun, time_full_scan)->Iterations(1);
}

} // namespace
} // namespace duskline

int main(int argc, char** argv)
{
    for (const duskline::Sun& sun : duskline::kSuns)
        duskline::add_all(sun);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
