#include "caster_bench.h"

#include "interruption.h"
#include "peak_memory.h"
#include "stopwatch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace duskline::cli {
namespace {

constexpr double kSecondsPerCaster = 2.0;
constexpr std::size_t kMostRuns = 25;
constexpr std::size_t kLeastRounds = 5; // so many times is memory copied, even if casters run less often

// Where the parts of the work end on the progress bar. Nobody knows how long each will take.
constexpr double kReadingEnds = 0.1;
constexpr double kCheckingEnds = 0.5;

struct Scene {
    const Terrain& terrain;
    BenchLight light;
    std::size_t threads;

    ShadowMask cast(const Caster& caster, const HeightField& field, const ProgressCallback& progress) const
    {
        const Execution execution{.threads = threads, .progress = progress};
        if (const auto* lamp = std::get_if<PointLight>(&light))
            return caster.cast_lamp(field, *lamp, execution);
        return caster.cast(field, std::get<DirectionalLight>(light), execution);
    }
};

struct Checked {
    ShadowMask mask;
    double seconds = 0.0;
    std::optional<std::size_t> peak_bytes;
};

// Starts the threads and loads the code, which would count as the first caster's memory.
void warm_up(const Scene& scene, const Caster& caster)
{
    constexpr std::size_t side = 64;
    const HeightField field = scene.terrain;
    scene.cast(caster, field.window(0, 0, std::min(field.rows(), side), std::min(field.columns(), side)), {});
}

Checked check(const Scene& scene, const Caster& caster, const ProgressCallback& progress)
{
    warm_up(scene, caster);
    Checked checked;
    const PeakMemory memory;
    {
        const Stopwatch watch(checked.seconds);
        checked.mask = scene.cast(caster, scene.terrain, progress);
    }
    checked.peak_bytes = memory.bytes();
    return checked;
}

const Caster& choose_truth(const std::vector<const Caster*>& casters)
{
    const bool has_ray = std::ranges::any_of(casters, [](const Caster* c) { return c->name == "ray"; });
    return caster_named(has_ray ? "ray" : "fast-ray");
}

std::size_t runs_that_fit(double seconds_each)
{
    const double fit = std::floor(kSecondsPerCaster / std::max(seconds_each, 1e-9));
    return static_cast<std::size_t>(std::clamp(fit, 1.0, static_cast<double>(kMostRuns)));
}

// One caster with what it takes to time it.
struct Contestant {
    CasterBench bench;
    std::size_t runs = 0; // still to come

    // Whether it takes part in a round: its runs are spread evenly over all of them.
    bool has_turn(std::size_t round, std::size_t rounds) const
    {
        return (round + 1) * runs / rounds > round * runs / rounds;
    }
};

Contestant contestant(const Caster& caster, const Checked& checked, const ShadowMask& truth,
                      const BenchPlan& plan)
{
    Contestant result{.bench = {.caster = &caster,
                                .difference = mask_difference(truth, checked.mask),
                                .peak_bytes = checked.peak_bytes,
                                .times = {}},
                      .runs = plan.runs.value_or(runs_that_fit(checked.seconds))};
    if (!plan.runs && checked.seconds > kSecondsPerCaster) {
        result.bench.times.add(checked.seconds);
        result.runs = 0;
    }
    return result;
}

std::vector<Contestant> check_all(const Scene& scene, const BenchPlan& plan, BenchResult& result,
                                  ProgressBar& bar)
{
    const double step = (kCheckingEnds - kReadingEnds) / static_cast<double>(plan.casters.size() + 1);
    const Checked truth = check(scene, *result.truth, bar.part(kReadingEnds, kReadingEnds + step));
    result.shadow = static_cast<std::size_t>(std::ranges::count(truth.mask.values(), Lit::no));
    result.no_data = static_cast<std::size_t>(std::ranges::count(truth.mask.values(), Lit::unknown));
    std::vector<Contestant> contestants;
    double done = kReadingEnds + step;
    for (const Caster* caster : plan.casters) {
        contestants.push_back(
            caster == result.truth
                ? contestant(*caster, truth, truth.mask, plan)
                : contestant(*caster, check(scene, *caster, bar.part(done, done + step)), truth.mask, plan));
        done += step;
    }
    return contestants;
}

// Tells the compiler that somebody may look at what lies there, so that it is really written.
void look_at(const void* memory)
{
    asm volatile("" : : "r"(memory) : "memory");
}

void time_copy(const Grid<float>& heights_m, Grid<float>& copy_m, Times& times)
{
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        std::memcpy(copy_m.data(), heights_m.data(), copy_m.size() * sizeof(float));
        look_at(copy_m.data());
    }
    times.add(seconds);
}

void time_cast(const Scene& scene, CasterBench& bench)
{
    double seconds = 0.0;
    ShadowMask mask; // its end is not timed
    {
        const Stopwatch watch(seconds);
        mask = scene.cast(*bench.caster, scene.terrain, [](double) { return !interrupted(); });
    }
    bench.times.add(seconds);
}

void time_all(const Scene& scene, std::vector<Contestant>& contestants, Times& memcpy_times, ProgressBar& bar)
{
    const auto progress = bar.part(kCheckingEnds, 1.0);
    const auto& most = std::ranges::max_element(contestants, {}, &Contestant::runs);
    const std::size_t rounds = std::max(kLeastRounds, most->runs);
    const Grid<float>& heights_m = scene.terrain.heights_m;
    Grid<float> copy_m = heights_m.copy();
    for (std::size_t round = 0; round < rounds; ++round) {
        time_copy(heights_m, copy_m, memcpy_times);
        for (Contestant& each : contestants)
            if (each.has_turn(round, rounds))
                time_cast(scene, each.bench);
        if (!progress(static_cast<double>(round + 1) / static_cast<double>(rounds)))
            throw Cancelled();
    }
}

} // namespace

double Times::best_s() const
{
    return std::ranges::min(seconds_);
}

double Times::median_s() const
{
    std::vector<double> sorted = seconds_;
    std::ranges::sort(sorted);
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2.0;
}

BenchResult bench_casters(const Terrain& terrain, const BenchLight& light, const BenchPlan& plan,
                          ProgressBar& bar)
{
    const Scene scene{terrain, light, plan.threads};
    BenchResult result;
    result.truth = &choose_truth(plan.casters);
    std::vector<Contestant> contestants = check_all(scene, plan, result, bar);
    time_all(scene, contestants, result.memcpy_times, bar);
    for (Contestant& each : contestants)
        result.casters.push_back(std::move(each.bench));
    return result;
}

} // namespace duskline::cli
