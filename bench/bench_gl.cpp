// How long shadows on the graphics card take, beside their error.
//
// Times are of the whole of it, from the first call until the card is done; on Mesa's software renderer the card is the
// processor. Each benchmark first compares its answer with the truth; `wrong_%` is the share of cells that differ.
//
//   build/release/bench/bench_gl                                    everything
//   build/release/bench/bench_gl --benchmark_filter=/2048       some

#include <duskline/casting/exact.h>
#include <duskline/gl/headless_context.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/silhouette_passes.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace duskline::gl {
namespace {

struct Scene {
    std::size_t side;
    double azimuth;
    double altitude;
};

const Terrain& mountains(std::size_t side)
{
    static std::map<std::size_t, Terrain> made;
    if (const auto found = made.find(side); found != made.end())
        return found->second;
    return made.emplace(side, make_mountains({.grid = {side, side, {30.0, 30.0}}, .seed = 7})).first->second;
}

double share_wrong(const ShadowMask& mask, const ShadowMask& truth)
{
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
        wrong += mask.values()[i] != truth.values()[i];
    return static_cast<double>(wrong) / static_cast<double>(mask.size());
}

DirectionalLight light_of(const Scene& scene)
{
    return {Angle::from_degrees(scene.azimuth), Angle::from_degrees(scene.altitude)};
}

// DUSKLINE_SHADER_DIR: to try a change of a shader without a build.
ShaderSources shaders()
{
    const char* folder = std::getenv("DUSKLINE_SHADER_DIR");
    return ShaderSources(folder == nullptr ? "" : folder);
}

// Times `work`, which leaves the card busy.
template <typename Work>
void time_on_card(benchmark::State& state, const Work& work)
{
    for (auto _ : state) {
        wait_until_done();
        const auto start = std::chrono::steady_clock::now();
        work();
        wait_until_done();
        state.SetIterationTime(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
}

void report_error(benchmark::State& state, const ShadowMask& mask, const Terrain& terrain, const Scene& scene)
{
    state.counters["wrong_%"] = 100.0 * share_wrong(mask, cast_by_exact(terrain, light_of(scene)));
}

ShadowMask mask_of_bytes(const Grid<std::uint8_t>& bytes)
{
    ShadowMask mask(bytes.rows(), bytes.columns());
    std::ranges::transform(bytes.values(), mask.values().begin(),
                           [](std::uint8_t byte) { return byte == 0 ? Lit::no : Lit::yes; });
    return mask;
}

// Building shadow heights; there is nothing else to do for a mask of them.
void bench_sweep(benchmark::State& state, const Scene& scene, const ShadowSweepOptions& options)
{
    const Terrain& terrain = mountains(scene.side);
    const Texture heights = height_texture(terrain.heights_m.view());
    ShadowSweep sweep(shaders(), options);
    const DirectionalLight light = light_of(scene);
    const Texture& answers = sweep.cast(heights, terrain.cell_size_m, light);
    if (!options.limbs)
        report_error(state, mask_of(terrain, read_back<float>(answers)), terrain, scene);
    time_on_card(state, [&] { sweep.cast(heights, terrain.cell_size_m, light); });
}

// What of the silhouette map is timed.
enum class Timed { build, look_up, full_scan };

void bench_smap(benchmark::State& state, const Scene& scene, NextVSearch search, Timed timed)
{
    const Terrain& terrain = mountains(scene.side);
    const Texture heights = height_texture(terrain.heights_m.view());
    const float greatest_m = height_range(terrain).highest_m;
    SilhouettePasses passes(shaders(), {.search = search});
    const auto build = [&] { passes.build(heights, terrain.cell_size_m, light_of(scene), greatest_m); };
    build();
    const auto answer = [&]() -> const Texture& {
        return timed == Timed::full_scan ? passes.mask_by_full_scan() : passes.mask();
    };
    report_error(state, mask_of_bytes(read_back<std::uint8_t>(answer())), terrain, scene);
    if (timed == Timed::build)
        time_on_card(state, build);
    else
        time_on_card(state, answer);
}

template <typename Function, typename... Arguments>
void add(const std::string& name, const Scene& scene, Function function, Arguments... arguments)
{
    const std::string place =
        "/" + std::to_string(scene.side) + "/azimuth:" + std::to_string(static_cast<int>(scene.azimuth));
    benchmark::RegisterBenchmark((name + place).c_str(), function, scene, arguments...)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

void add_all()
{
    for (const std::size_t side : {512U, 2048U})
        for (const double azimuth : {203.0, 255.0}) { // along rows, along columns
            const Scene scene{side, azimuth, 5.0};
            add("full_scan/look_up", scene, bench_smap, NextVSearch::parallel_quad, Timed::full_scan);
            add("smap_binary/build", scene, bench_smap, NextVSearch::binary, Timed::build);
            add("smap_quad/build", scene, bench_smap, NextVSearch::quad, Timed::build);
            add("smap_parallel_quad/build", scene, bench_smap, NextVSearch::parallel_quad, Timed::build);
            add("smap_parallel_quad/look_up", scene, bench_smap, NextVSearch::parallel_quad, Timed::look_up);
            add("sweep/build", scene, bench_sweep, ShadowSweepOptions{});
            add("sweep/build_both_edges", scene, bench_sweep, ShadowSweepOptions{.limbs = true});
        }
}

} // namespace
} // namespace duskline::gl

int main(int argc, char** argv)
{
    const duskline::gl::HeadlessContext context;
    duskline::gl::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::AddCustomContext("OpenGL", duskline::gl::current_context().renderer);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
