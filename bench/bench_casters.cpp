// How long the casters take, beside a copy of the same heights and beside their error.
//
// Every measured cast is preceded by a memcpy of the height map, measured as well: on a machine that is shared
// or changes its clock the ratio of the two medians (x_memcpy) holds where milliseconds do not. Both write to
// memory that is there already. Each benchmark first compares its answer with the truth and fails when it is
// off by more than the caster may be; `wrong_%` is the share of cells that differ.
//
//   build/release/bench/bench_casters                                       everything
//   build/release/bench/bench_casters --benchmark_filter=sweep/mask/2048    some

#include <duskline/casting/casters.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/terrain_shadows.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/execution/for_rows.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace duskline {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

// What one benchmark casts.
struct Scene {
    std::size_t side;
    double azimuth;
    double altitude;
};

// The share of cells an inexact caster may have wrong at these suns (docs/accuracy.md).
double most_wrong(std::string_view caster)
{
    return caster == "line-march" ? 0.05 : caster == "strider" ? 0.015 : 0.008;
}

// Square mountains, made once. The larger ones are the 2048 ones mirrored side by side, whose every shadow is
// known from theirs but for the seams, and which take no minutes to make.
const Terrain& mountains(std::size_t side)
{
    static std::map<std::size_t, Terrain> made;
    if (const auto found = made.find(side); found != made.end())
        return found->second;
    constexpr std::size_t tile = 2048;
    Terrain terrain{Grid<float>(side, side), {30.0, 30.0}};
    const Terrain one = make_mountains(
        {.grid = {std::min(side, tile), std::min(side, tile), terrain.cell_size_m}, .seed = 7});
    const auto mirrored = [](std::size_t i) { return i / tile % 2 == 0 ? i % tile : tile - 1 - i % tile; };
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            terrain.heights_m(y, x) = one.heights_m(mirrored(y), mirrored(x));
    return made.emplace(side, std::move(terrain)).first->second;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

template <typename Work>
double milliseconds(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return Milliseconds(std::chrono::steady_clock::now() - start).count();
}

double share_wrong(const ShadowMask& mask, const ShadowMask& truth)
{
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
        wrong += mask.values()[i] != truth.values()[i];
    return static_cast<double>(wrong) / static_cast<double>(mask.size());
}

// The truth for a scene; scenes are asked for with several numbers of threads.
const ShadowMask& truth_of(const Scene& scene, const DirectionalLight& light)
{
    static std::map<std::pair<std::size_t, std::pair<double, double>>, ShadowMask> known;
    const auto key = std::pair(scene.side, std::pair(scene.azimuth, scene.altitude));
    if (const auto found = known.find(key); found != known.end())
        return found->second;
    return known.emplace(key, TerrainRays(mountains(scene.side)).cast(light)).first->second;
}

// Times `cast`, which leaves its answer where `mask` finds it, against memcpy.
template <typename Cast>
void run(benchmark::State& state, const Scene& scene, std::size_t threads, double most_wrong,
         const ShadowMask& mask, const Cast& cast)
{
    const Terrain& terrain = mountains(scene.side);
    const DirectionalLight light{Angle::from_degrees(scene.azimuth), Angle::from_degrees(scene.altitude)};
    cast(light);
    const double wrong = share_wrong(mask, truth_of(scene, light));
    if (wrong > most_wrong) {
        state.SkipWithError(("wrong in " + std::to_string(100.0 * wrong) + " % of the cells").c_str());
        return;
    }

    Grid<float> copy(scene.side, scene.side, 0.0f);
    std::vector<double> copies_ms;
    std::vector<double> casts_ms;
    for (auto _ : state) {
        copies_ms.push_back(milliseconds([&] {
            std::memcpy(copy.data(), terrain.heights_m.data(), copy.size() * sizeof(float));
            benchmark::ClobberMemory();
        }));
        casts_ms.push_back(milliseconds([&] { cast(light); }));
        state.SetIterationTime(casts_ms.back() / 1000.0);
    }
    const double cast_ms = median(casts_ms);
    state.counters["median_ms"] = cast_ms;
    state.counters["best_ms"] = std::ranges::min(casts_ms);
    state.counters["memcpy_ms"] = median(copies_ms);
    state.counters["x_memcpy"] = cast_ms / median(copies_ms);
    state.counters["Mcells/s"] = static_cast<double>(mask.size()) / cast_ms / 1000.0;
    state.counters["wrong_%"] = 100.0 * wrong;
    state.SetLabel(std::string(kernels::active_kernels().isa) + ", threads " + std::to_string(threads));
}

std::string name_of(std::string_view what, const Scene& scene, std::size_t threads)
{
    const auto number = [](double value) {
        std::string text = std::to_string(value);
        return text.substr(0, text.find('.') + (value == std::floor(value) ? 0 : 2));
    };
    return std::string(what) + "/" + std::to_string(scene.side) + "/azimuth:" + number(scene.azimuth)
           + "/altitude:" + number(scene.altitude) + "/j:" + std::to_string(threads);
}

// A sweep into memory that is there already, as an engine or a series of suns would do it.
void add_sweep(const Scene& scene, std::size_t threads)
{
    benchmark::RegisterBenchmark(
        name_of("sweep/mask", scene, threads).c_str(),
        [=](benchmark::State& state) {
            const Terrain& terrain = mountains(scene.side);
            ShadowMask mask(scene.side, scene.side, Lit::unknown);
            run(state, scene, threads, most_wrong("sweep"), mask, [&](const DirectionalLight& light) {
                const LightFrame frame = light_frame(light, terrain.cell_size_m);
                SweepFront front(scene.side, scene.side, frame);
                front.advance(in_light_order(terrain.heights_m.view(), frame),
                              in_light_order(mask.view(), frame), {.threads = threads});
            });
        })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

// Any caster as the table has it, its answer's memory included.
void add_caster(const Caster& caster, const Scene& scene, std::size_t threads)
{
    const std::string name = name_of("caster/" + std::string(caster.name), scene, threads);
    benchmark::RegisterBenchmark(
        name.c_str(),
        [=, &caster](benchmark::State& state) {
            ShadowMask mask;
            run(state, scene, threads, most_wrong(caster.name), mask, [&](const DirectionalLight& light) {
                mask = caster.cast(mountains(scene.side), light, {.threads = threads});
            });
        })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

// Whether a cell that sees all of the sun is lit by its middle, and one that sees nothing of it is not.
bool agree(const VisibleFraction& seen, const ShadowMask& mask)
{
    for (std::size_t i = 0; i < seen.size(); ++i)
        if ((seen.values()[i] == 0.0f && mask.values()[i] == Lit::yes)
            || (seen.values()[i] == 1.0f && mask.values()[i] == Lit::no))
            return false;
    return true;
}

// Soft edges, beside the mask that has none.
void add_soft(const Scene& scene, std::size_t threads)
{
    const auto cast_soft = [=](benchmark::State& state) {
        const Terrain& terrain = mountains(scene.side);
        const DirectionalLight light{Angle::from_degrees(scene.azimuth), Angle::from_degrees(scene.altitude)};
        const Execution execution{.threads = threads};
        const Caster& exact = caster_named("exact");
        ShadowMask mask;
        VisibleFraction seen;
        std::vector<double> soft_ms;
        std::vector<double> hard_ms;
        for (auto _ : state) {
            hard_ms.push_back(milliseconds([&] { mask = exact.cast(terrain, light, execution); }));
            soft_ms.push_back(
                milliseconds([&] { seen = visible_fraction(terrain, light, exact, execution); }));
            state.SetIterationTime(soft_ms.back() / 1000.0);
        }
        if (!agree(seen, mask))
            state.SkipWithError("not what the mask says");
        state.counters["median_ms"] = median(soft_ms);
        state.counters["hard_ms"] = median(hard_ms);
        state.counters["x_hard"] = median(soft_ms) / median(hard_ms);
        const auto half = std::ranges::count_if(seen.values(), [](float f) { return f > 0.0f && f < 1.0f; });
        state.counters["half_%"] = 100.0 * static_cast<double>(half) / static_cast<double>(seen.size());
        state.SetLabel(std::string(kernels::active_kernels().isa) + ", threads " + std::to_string(threads));
    };
    benchmark::RegisterBenchmark(name_of("soft", scene, threads).c_str(), cast_soft)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

// A day's worth of suns: from one side to the other, low at first and last, along rows and columns and between.
std::vector<DirectionalLight> suns_of_a_day(std::size_t count)
{
    std::vector<DirectionalLight> suns;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        suns.push_back({Angle::from_degrees(60.0 + 240.0 * share),
                        Angle::from_degrees(60.0 * std::sin(share * Angle::from_degrees(180.0).radians()))});
    }
    return suns;
}

// Beside what the same masks cost from scratch, cast in turn.
void report(benchmark::State& state, std::size_t threads, const std::vector<double>& own_ms,
            const std::vector<double>& scratch_ms)
{
    state.counters["median_ms"] = median(own_ms);
    state.counters["scratch_ms"] = median(scratch_ms);
    state.counters["x_scratch"] = median(own_ms) / median(scratch_ms);
    state.SetLabel(std::string(kernels::active_kernels().isa) + ", threads " + std::to_string(threads));
}

// Many suns over one terrain, set-up included, beside as many calls of cast_by_exact.
void add_day(std::size_t side, std::size_t count, std::size_t threads)
{
    const auto cast_day = [=](benchmark::State& state) {
        const Terrain& terrain = mountains(side);
        const std::vector<DirectionalLight> suns = suns_of_a_day(count);
        const Execution execution{.threads = threads};
        TerrainShadows checked(terrain, execution);
        for (const DirectionalLight& sun : suns)
            if (share_wrong(checked.cast(sun, execution), cast_by_exact(terrain, sun, execution)) > 0.0) {
                state.SkipWithError("not the mask of cast_by_exact");
                return;
            }
        std::vector<double> days_ms;
        std::vector<double> scratch_ms;
        for (auto _ : state) {
            std::optional<TerrainShadows> shadows;
            days_ms.push_back(milliseconds([&] { shadows.emplace(terrain, execution); }));
            scratch_ms.push_back(0.0);
            for (const DirectionalLight& sun : suns) {
                scratch_ms.back() +=
                    milliseconds([&] { benchmark::DoNotOptimize(cast_by_exact(terrain, sun, execution)); });
                days_ms.back() +=
                    milliseconds([&] { benchmark::DoNotOptimize(shadows->cast(sun, execution)); });
            }
            state.SetIterationTime(days_ms.back() / 1000.0);
        }
        report(state, threads, days_ms, scratch_ms);
    };
    const std::string name =
        "day/" + std::to_string(count) + "/" + std::to_string(side) + "/j:" + std::to_string(threads);
    benchmark::RegisterBenchmark(name.c_str(), cast_day)->UseManualTime()->Unit(benchmark::kMillisecond);
}

// A square of ground raised and lowered in turn, beside a whole cast.
void add_edit(const Scene& scene, std::size_t edited, std::size_t threads)
{
    const auto edit_and_recast = [=](benchmark::State& state) {
        Terrain terrain{mountains(scene.side).heights_m.copy(), mountains(scene.side).cell_size_m};
        const DirectionalLight light{Angle::from_degrees(scene.azimuth), Angle::from_degrees(scene.altitude)};
        const Execution execution{.threads = threads};
        const std::size_t first = scene.side / 2;
        float by_m = 50.0f;
        const auto edit = [&] {
            for (std::size_t y = first; y < first + edited; ++y)
                for (float& height_m : terrain.heights_m.row(y).subspan(first, edited))
                    height_m += by_m;
            by_m = -by_m;
        };
        TerrainShadows shadows(terrain, execution);
        shadows.cast(light, execution);
        std::vector<double> edits_ms;
        std::vector<double> scratch_ms;
        std::size_t cells = 0;
        for (auto _ : state) {
            edit();
            edits_ms.push_back(milliseconds([&] {
                cells = shadows.heights_changed({first, first, edited, edited}, execution);
            }));
            ShadowMask scratch;
            scratch_ms.push_back(milliseconds([&] { scratch = cast_by_exact(terrain, light, execution); }));
            if (share_wrong(shadows.mask(), scratch) > 0.0) {
                state.SkipWithError("not the mask of cast_by_exact");
                return;
            }
            state.SetIterationTime(edits_ms.back() / 1000.0);
        }
        report(state, threads, edits_ms, scratch_ms);
        state.counters["cells_%"] =
            100.0 * static_cast<double>(cells) / static_cast<double>(shadows.mask().size());
    };
    benchmark::RegisterBenchmark(name_of("edit/" + std::to_string(edited), scene, threads).c_str(),
                                 edit_and_recast)
        ->Iterations(30) // each is cast from scratch as well
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

void add_all()
{
    const std::size_t all = thread_count({});
    for (const std::size_t side : {std::size_t{2048}, std::size_t{8192}})
        for (const double azimuth : {0.0, 203.0, 337.5, 100.3, 270.0, 301.5})
            for (const std::size_t threads : {std::size_t{1}, all})
                add_sweep({side, azimuth, 20.0}, threads);
    for (const Caster& caster : kCasters)
        for (const double altitude : {20.0, 5.0})
            add_caster(caster, {caster.name == "ray" ? std::size_t{512} : std::size_t{2048}, 203.0, altitude},
                       all);
    for (const double altitude : {20.0, 5.0})
        for (const std::size_t side : {std::size_t{2048}, std::size_t{8192}})
            for (const double azimuth : {203.0, 270.0})
                add_caster(caster_named("exact"), {side, azimuth, altitude}, 1);
    for (const std::string_view name : {"strider", "sweep"}) // the same work, allocations included
        for (const double azimuth : {0.0, 203.0, 270.0, 100.3})
            add_caster(caster_named(name), {2048, azimuth, 20.0}, 1);
    for (const std::size_t threads : {std::size_t{1}, all}) {
        for (const double altitude : {20.0, 5.0})
            add_soft({2048, 203.0, altitude}, threads);
        add_day(2048, 96, threads);
        for (const double azimuth : {203.0, 270.0, 315.0})
            add_edit({2048, azimuth, 20.0}, 64, threads);
    }
}

} // namespace
} // namespace duskline

int main(int argc, char** argv)
{
    duskline::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::AddCustomContext("duskline_kernels", std::string(duskline::kernels::active_kernels().isa));
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
