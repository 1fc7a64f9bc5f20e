// What shadows on a planet's tiles take, beside their error: tiles of Hawaii among their neighbours, under suns at several
// heights over the middle tile. `wrong_%` is the share of samples whose answer (lit or not) is not that of PlanetRays, on and
// around the middle tile; `border_%` the same for samples on borders of tiles; `farthest` how many samples a wrong one is from
// an edge of shadow at most (3: more than 2).
//
//   build/release/bench/bench_planet

#include <duskline/planet/planet_ray.h>
#include <duskline/planet/planet_shadows.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/raster_io/read_planet_source.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
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
        PlanetShadows result(kWgs84, sun);
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
        const auto shadow = shadows_.shadow_of(tile);
        for (std::int32_t row = 0; row <= kTileSquares; ++row)
            for (std::int32_t column = 0; column <= kTileSquares; ++column) {
                const bool border = row % kTileSquares == 0 || column % kTileSquares == 0;
                if (heights_of(tile)->height_m(row, column) <= 0.0F
                    || (!border && (row * 129 + column) % 11 != 0))
                    continue;
                const bool lit = heights_of(tile)->height_m(row, column) >= shadow->heights_m(
                                     static_cast<std::size_t>(row), static_cast<std::size_t>(column));
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

private:
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
    state.counters["tiles"] = static_cast<double>(scene.all.size());
    state.counters["per_tile"] =
        benchmark::Counter(static_cast<double>(scene.all.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
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
