// What shadows on a planet's tiles take, beside their error: tiles of Hawaii among their neighbours, under suns at several
// heights over the middle tile. `wrong_%` is the share of samples whose answer (lit or not) is not that of PlanetRays, on and
// around the middle tile; `border_%` the same for samples on borders of tiles; `farthest` how many samples a wrong one is from
// an edge of shadow at most (3: more than 2).
//
// `disc` is for both edges of the sun's disc; `half_%` how many samples see a part of it, `error` what that part is wrong by in
// their mean, by rays to 40 points of the disc, and `two_shadows` the same for the shadows of the two edges by themselves.
//
// `moving` has a clock that runs at ten minutes a second, 60 frames a second, and a budget of ten tiles a frame; `jumping` the
// same when every sun is shown alone, as soon as it is computed. `wrong_%` is then against rays to the sun of the clock,
// `behind` how many frames the sun that is shown is behind it in the mean, `jump` how many frames it moves at once at most.
//
//   build/release/bench/bench_planet

#include <duskline/planet/planet_ray.h>
#include <duskline/planet/planet_shadows.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/raster_io/read_planet_source.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace duskline {
namespace {

constexpr double kAzimuth = 203.0;
constexpr std::int32_t kTilesAround = 4;

Vector3 middle()
{
    return direction_at(kWgs84, {Angle::from_degrees(-155.5), Angle::from_degrees(19.6)});
}

// The sun over the middle of the tile in which Hawaii's middle lies.
Vector3 sun_over(const PlanetTile& tile, double altitude)
{
    const LocalFrame frame = local_frame(kWgs84, centre_direction(tile));
    const auto [up, along] = sine_cosine(Angle::from_degrees(altitude));
    const auto [east, north] = sine_cosine(Angle::from_degrees(kAzimuth));
    return frame.up * up + (frame.east * east + frame.north * north) * along;
}

PlanetTerrain read_world()
{
    std::vector<PlanetSource> sources;
    sources.push_back(read_planet_source(DUSKLINE_DATA "/etopo20_world.tif").source);
    sources.push_back(read_planet_source(DUSKLINE_DATA "/hawaii_2048.tif").source);
    return PlanetTerrain(kWgs84, std::move(sources));
}

const PlanetTerrain& world()
{
    static const PlanetTerrain terrain = read_world();
    return terrain;
}

const std::shared_ptr<const TileHeights>& heights_of(const PlanetTile& tile)
{
    static std::map<PlanetTile, std::shared_ptr<const TileHeights>> made;
    std::shared_ptr<const TileHeights>& heights = made[tile];
    if (heights == nullptr)
        heights = std::make_shared<const TileHeights>(world().heights_of(tile));
    return heights;
}

// A tile, its neighbours of the same level, and all ancestors.
struct Scene {
    PlanetTile tile;
    std::vector<PlanetTile> near;
    std::map<PlanetTile, bool> all;

    explicit Scene(std::uint32_t level) : tile(place_in_tile(middle(), level).tile)
    {
        for (std::int32_t row = -kTilesAround; row <= kTilesAround; ++row)
            for (std::int32_t column = -kTilesAround; column <= kTilesAround; ++column) {
                const auto r = static_cast<std::int64_t>(tile.row) + row;
                const auto c = static_cast<std::int64_t>(tile.column) + column;
                if (r < 0 || c < 0 || r >= std::int64_t{1} << level || c >= std::int64_t{1} << level)
                    continue;
                const PlanetTile here = {tile.face, level, static_cast<std::uint32_t>(r),
                                         static_cast<std::uint32_t>(c)};
                if (std::abs(row) <= 1 && std::abs(column) <= 1)
                    near.push_back(here);
                for (std::uint32_t l = 0; l <= level; ++l)
                    all[ancestor_of(here, l)] = true;
            }
    }
    PlanetShadows shadows(const Vector3& sun) const
    {
        return shadows(sun, [](const Vector3& to_sun) { return PlanetShadows(kWgs84, to_sun); });
    }
    template <typename Made>
    PlanetShadows shadows(const Vector3& sun, const Made& made) const
    {
        PlanetShadows result = made(sun);
        for (const auto& [each, there] : all)
            result.insert(each, heights_of(each));
        return result;
    }
};

// What is wrong among the shadows of a scene.
class Errors {
public:
    Errors(const PlanetShadows& shadows, const Vector3& sun, std::uint32_t level)
        : shadows_(shadows),
          rays_({kWgs84, level, world().heights(),
                 [](const PlanetTile& tile) -> const TileHeights& { return *heights_of(tile); }},
                sun)
    {}

    void count(const PlanetTile& tile)
    {
        const ShownShadow shown = shadows_.shown(tile);
        for (std::int32_t row = 0; row <= kTileSquares; ++row)
            for (std::int32_t column = 0; column <= kTileSquares; ++column) {
                const bool border = row % kTileSquares == 0 || column % kTileSquares == 0;
                if (heights_of(tile)->height_m(row, column) <= 0.0F
                    || (!border && (row * 129 + column) % 11 != 0))
                    continue;
                const bool lit = static_cast<double>(heights_of(tile)->height_m(row, column)) >= shadow_m(
                                     shown, static_cast<std::size_t>(row), static_cast<std::size_t>(column));
                const bool wrong = lit != is_lit(tile, row, column);
                ++(border ? border_samples_ : samples_);
                if (!wrong)
                    continue;
                ++(border ? border_wrong_ : wrong_);
                farthest_ = std::max(farthest_, from_edge(tile, row, column));
            }
    }

    void report(benchmark::State& state) const
    {
        const auto percent = [](std::size_t part, std::size_t all) {
            return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
        };
        state.counters["wrong_%"] = percent(wrong_, samples_);
        state.counters["border_%"] = percent(border_wrong_, border_samples_);
        state.counters["farthest"] = farthest_;
        if (percent(wrong_, samples_) > 0.8)
            state.SkipWithError("more than 0.8 % of the samples are wrong");
    }

    double samples() const { return static_cast<double>(samples_); }
    double wrong() const { return static_cast<double>(wrong_); }

private:
    static double shadow_m(const ShownShadow& shown, std::size_t row, std::size_t column)
    {
        const auto first_m = static_cast<double>(shown.first->heights_m(row, column));
        if (!shown.second)
            return first_m;
        return first_m + shown.share * (static_cast<double>(shown.second->heights_m(row, column)) - first_m);
    }
    bool is_lit(const PlanetTile& tile, std::int32_t row, std::int32_t column) const
    {
        return rays_.is_lit(sample_direction(tile, row, column),
                            static_cast<double>(heights_of(tile)->height_m(row, column)));
    }
    int from_edge(const PlanetTile& tile, std::int32_t row, std::int32_t column) const
    {
        const bool lit = is_lit(tile, row, column);
        for (std::int32_t far = 1; far <= 2; ++far)
            for (std::int32_t r = std::max(row - far, -1); r <= std::min(row + far, kTileSquares + 1); ++r)
                for (std::int32_t c = std::max(column - far, -1);
                     c <= std::min(column + far, kTileSquares + 1); ++c)
                    if (is_lit(tile, r, c) != lit)
                        return far;
        return 3;
    }

    const PlanetShadows& shadows_;
    PlanetRays rays_;
    std::size_t samples_ = 0;
    std::size_t wrong_ = 0;
    std::size_t border_samples_ = 0;
    std::size_t border_wrong_ = 0;
    int farthest_ = 0;
};

// One tile again and again, with the light that its neighbours leave.
void time_tile(benchmark::State& state, std::uint32_t level, double altitude)
{
    const Scene scene(level);
    const Vector3 sun = sun_over(scene.tile, altitude);
    PlanetShadows shadows = scene.shadows(sun);
    shadows.settle();
    Errors errors(shadows, sun, level);
    for (const PlanetTile& tile : scene.near)
        errors.count(tile);
    const LightAxis axis = light_axis(sun);
    EnteringLight entering;
    for (const TileEdge edge : kTileEdges)
        if (light_enters(axis, scene.tile, edge))
            entering.neighbours.at(static_cast<std::size_t>(edge)) =
                shadows.shadow_of(neighbour_of(scene.tile, edge).tile).get();
    for (auto _ : state)
        benchmark::DoNotOptimize(cast_on_tile(kWgs84, axis, scene.tile, *heights_of(scene.tile), entering));
    errors.report(state);
}

void report_per_tile(benchmark::State& state, const Scene& scene)
{
    state.counters["tiles"] = static_cast<double>(scene.all.size());
    state.counters["per_tile"] =
        benchmark::Counter(static_cast<double>(scene.all.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// All tiles of a scene from nothing, one thread; per tile.
void time_settle(benchmark::State& state, std::uint32_t level, double altitude)
{
    const Scene scene(level);
    const Vector3 sun = sun_over(scene.tile, altitude);
    for (auto _ : state) {
        PlanetShadows shadows = scene.shadows(sun);
        shadows.settle({.threads = 1});
        benchmark::DoNotOptimize(shadows.shadow_of(scene.tile));
    }
    report_per_tile(state, scene);
}

const Angle kSunRadius = Angle::from_degrees(0.2666);

// The part of the disc that is seen: as shaders have it (visible_disc.glsl).
double part_seen(double ground_m, double dark_m, double lit_m)
{
    if (ground_m >= lit_m || ground_m < dark_m)
        return ground_m >= lit_m ? 1.0 : 0.0;
    const double horizon = 2.0 * (lit_m - ground_m) / (lit_m - dark_m) - 1.0;
    return 0.5 - (horizon * std::sqrt(1.0 - horizon * horizon) + std::asin(horizon)) / std::numbers::pi;
}

// Rays to points all over the disc.
std::vector<PlanetRays> rays_to_disc(const Vector3& sun, std::uint32_t level)
{
    constexpr int points = 40;
    const LightAxis axis = light_axis(sun);
    std::vector<PlanetRays> rays;
    for (int i = 0; i < points; ++i) {
        const double away = tangent(kSunRadius) * std::sqrt((i + 0.5) / points);
        const double turn = 2.399963 * i; // the golden angle
        const Vector3 aside = axis.across * std::cos(turn) + axis.aside * std::sin(turn);
        rays.emplace_back(
            PlanetLevel{kWgs84, level, world().heights(),
                        [](const PlanetTile& tile) -> const TileHeights& { return *heights_of(tile); }},
            axis.to_sun + aside * away);
    }
    return rays;
}

double part_seen(const std::vector<PlanetRays>& rays, const Vector3& direction, double height_m)
{
    const auto lit = std::ranges::count_if(
        rays, [&](const PlanetRays& to_point) { return to_point.is_lit(direction, height_m); });
    return static_cast<double>(lit) / static_cast<double>(rays.size());
}

void count_half_shadow(benchmark::State& state, const Scene& scene, const Vector3& sun, std::uint32_t level,
                       const PlanetShadows& disc)
{
    PlanetShadows upper =
        scene.shadows(sun, [](const Vector3& to_sun) { return PlanetShadows(kWgs84, to_sun, kSunRadius); });
    upper.settle();
    const std::vector<PlanetRays> rays = rays_to_disc(sun, level);
    double samples = 0.0;
    double half = 0.0;
    double error = 0.0;
    double error_of_two = 0.0;
    for (const PlanetTile& tile : scene.near)
        for (std::int32_t row = 0; row <= kTileSquares; row += 3)
            for (std::int32_t column = 0; column <= kTileSquares; column += 3) {
                const auto r = static_cast<std::size_t>(row);
                const auto c = static_cast<std::size_t>(column);
                const auto shadow = disc.shadow_of(tile);
                const auto ground_m = static_cast<double>(heights_of(tile)->height_m(row, column));
                const auto lit_m = static_cast<double>(shadow->heights_m(r, c));
                const double seen = part_seen(ground_m, static_cast<double>(shadow->dark_m(r, c)), lit_m);
                samples += ground_m > 0.0 ? 1.0 : 0.0;
                if (ground_m <= 0.0 || seen == 0.0 || seen == 1.0)
                    continue;
                const double truth = part_seen(rays, sample_direction(tile, row, column), ground_m);
                const auto upper_m = static_cast<double>(upper.shadow_of(tile)->heights_m(r, c));
                half += 1.0;
                error += std::abs(seen - truth);
                error_of_two += std::abs(part_seen(ground_m, upper_m, lit_m) - truth);
            }
    state.counters["half_%"] = 100.0 * half / samples;
    state.counters["error"] = error / half;
    state.counters["two_shadows"] = error_of_two / half;
}

// All tiles of a scene from nothing with both edges of the disc, one thread.
void time_disc(benchmark::State& state, std::uint32_t level, double altitude)
{
    const Scene scene(level);
    const Vector3 sun = sun_over(scene.tile, altitude);
    const auto made = [](const Vector3& to_sun) {
        return PlanetShadows::of_disc(kWgs84, to_sun, kSunRadius);
    };
    for (auto _ : state) {
        PlanetShadows shadows = scene.shadows(sun, made);
        shadows.settle({.threads = 1});
        benchmark::DoNotOptimize(shadows.shadow_of(scene.tile));
    }
    report_per_tile(state, scene);
    PlanetShadows shadows = scene.shadows(sun, made);
    shadows.settle();
    count_half_shadow(state, scene, sun, level, shadows);
}

// The sun as the day goes on.
Vector3 sun_after(const Vector3& sun, double frames)
{
    constexpr double clock_s_per_frame = 10.0;
    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(-frames * clock_s_per_frame / 240.0));
    return {sun.x * cosine - sun.y * sine, sun.x * sine + sun.y * cosine, sun.z};
}

void run_clock(benchmark::State& state, std::uint32_t level, double altitude, bool ahead)
{
    constexpr int first = 40;
    constexpr int frames = 140;
    const Scene scene(level);
    const Vector3 sun = sun_over(scene.tile, altitude);
    const Vector3 step = sun_after(sun, 1.0) - sun;
    for (auto _ : state) {
        PlanetShadows shadows = scene.shadows(sun);
        shadows.settle();
        double samples = 0.0;
        double wrong = 0.0;
        double behind = 0.0;
        double jump = 0.0;
        for (int frame = 0; frame < frames; ++frame) {
            const Vector3 now = sun_after(sun, frame);
            const Vector3 before = shadows.shown_sun();
            // Set twice it is a sun that stands.
            for (int times = ahead ? 1 : shadows.settled() ? 2 : 0; times > 0; --times)
                shadows.set_sun(now);
            shadows.update(10);
            if (frame < first)
                continue;
            behind += length(shadows.shown_sun() - now) / length(step);
            jump = std::max(jump, length(shadows.shown_sun() - before) / length(step));
            if (frame % 5 != 0)
                continue;
            Errors errors(shadows, now, level);
            for (const PlanetTile& tile : scene.near)
                errors.count(tile);
            samples += errors.samples();
            wrong += errors.wrong();
        }
        state.counters["wrong_%"] = 100.0 * wrong / samples;
        state.counters["behind"] = behind / (frames - first);
        state.counters["jump"] = jump;
    }
}

void add_all()
{
    const auto add = [](const std::string& what, std::uint32_t level, double altitude, auto work) {
        const std::string name = what + "/level:" + std::to_string(level)
                                 + "/altitude:" + std::to_string(static_cast<int>(altitude));
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
            work(state, level, altitude);
        })->Unit(benchmark::kMillisecond);
    };
    for (const std::uint32_t level : {8U, 10U})
        for (const double altitude : {1.0, 5.0, 20.0})
            add("tile", level, altitude, time_tile);
    add("tile", 10, 90.0, time_tile);
    add("settle", 10, 10.0, time_settle);
    for (const double altitude : {2.0, 10.0})
        add("disc", 10, altitude, time_disc);
    for (const bool ahead : {false, true})
        for (const double altitude : {5.0, 20.0})
            add(ahead ? "moving" : "jumping", 10, altitude,
                [ahead](benchmark::State& state, std::uint32_t level, double high) {
                    run_clock(state, level, high, ahead);
                });
}

} // namespace
} // namespace duskline

int main(int argc, char** argv)
{
    duskline::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
