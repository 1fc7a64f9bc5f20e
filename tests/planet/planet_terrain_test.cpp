#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/made_up_detail.h>
#include <duskline/planet/planet_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace duskline {
namespace {

using HeightOf = std::function<double(double longitude_deg, double latitude_deg)>;

PlanetSource made_source(double west_deg, double north_deg, std::size_t rows, std::size_t columns,
                         double cell_deg, const HeightOf& height_of)
{
    PlanetSource source = {Grid<float>(rows, columns), Angle::from_degrees(west_deg),
                           Angle::from_degrees(north_deg), Angle::from_degrees(cell_deg),
                           Angle::from_degrees(cell_deg)};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            source.heights_m(row, column) =
                static_cast<float>(height_of(west_deg + (static_cast<double>(column) + 0.5) * cell_deg,
                                             north_deg - (static_cast<double>(row) + 0.5) * cell_deg));
    return source;
}

PlanetSource world(const HeightOf& height_of, double cell_deg = 2.0)
{
    const auto rows = static_cast<std::size_t>(180.0 / cell_deg);
    return made_source(-180.0, 90.0, rows, 2 * rows, cell_deg, height_of);
}

double hills(double longitude_deg, double latitude_deg)
{
    return 1500.0 + 900.0 * std::sin(longitude_deg * 0.3) * std::cos(latitude_deg * 0.35)
           + 300.0 * std::sin(longitude_deg * 1.1 + latitude_deg);
}

std::vector<PlanetSource> one(PlanetSource source)
{
    std::vector<PlanetSource> sources;
    sources.push_back(std::move(source));
    return sources;
}

Vector3 direction(double longitude_deg, double latitude_deg)
{
    return direction_at(kWgs84, {Angle::from_degrees(longitude_deg), Angle::from_degrees(latitude_deg)});
}

bool same_bytes(const TileHeights& a, const TileHeights& b)
{
    return std::ranges::equal(a.heights_m.values(), b.heights_m.values())
           && std::ranges::equal(a.measured.values(), b.measured.values());
}

float on_edge(const TileHeights& heights, TileEdge edge, std::int32_t i)
{
    switch (edge) {
    case TileEdge::lowest_u:
        return heights.height_m(i, 0);
    case TileEdge::highest_u:
        return heights.height_m(i, kTileSquares);
    case TileEdge::lowest_v:
        return heights.height_m(0, i);
    default:
        return heights.height_m(kTileSquares, i);
    }
}

TEST(PlanetTerrain, IsTheSourceAtTheCentresOfItsCells)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)), {.detail = 0.0});
    for (const double latitude : {-89.0, -31.0, 1.0, 45.0, 89.0})
        for (const double longitude : {-179.0, -3.0, 1.0, 77.0, 179.0})
            EXPECT_NEAR(terrain.height_m(direction(longitude, latitude), 12), hills(longitude, latitude),
                        1e-3);
}

TEST(PlanetTerrain, TilesAgreeOnTheSamplesTheyShareBitForBit)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)), {.finest_spacing_m = 20.0});
    std::mt19937 random(2);
    for (const std::uint32_t level : {0U, 1U, 4U, 11U}) {
        std::uniform_int_distribution<std::uint32_t> index(0, (1U << level) - 1);
        for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
            const PlanetTile tile = {face, level, index(random), face % 2 == 0 ? 0 : (1U << level) - 1};
            const TileHeights here = terrain.heights_of(tile);
            for (const TileEdge edge : kTileEdges) {
                const TileNeighbour there = neighbour_of(tile, edge);
                const TileHeights beyond = terrain.heights_of(there.tile);
                for (std::int32_t i = 0; i <= kTileSquares; ++i)
                    ASSERT_EQ(on_edge(here, edge, i),
                              on_edge(beyond, there.edge, there.reversed ? kTileSquares - i : i));
            }
        }
    }
}

TEST(PlanetTerrain, GivesTheSameBytesOnEveryThreadAndSampleBySample)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)));
    const PlanetTile tile = {2, 14, 9000, 5000};
    const TileHeights alone = terrain.heights_of(tile);
    std::vector<TileHeights> together(4);
    for_rows(together.size(), 1, {.threads = 4}, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            together[i] = terrain.heights_of(tile);
    });
    for (const TileHeights& heights : together)
        EXPECT_TRUE(same_bytes(heights, alone));
    EXPECT_EQ(alone.height_m(17, 90), terrain.height_m(sample_direction(tile, 17, 90), 14));
}

TEST(PlanetTerrain, TakesMeansOfCellsThatATileCannotShow)
{
    // Cells of 0.05 degrees, every other one high: level 0 has samples 0.8 degrees apart.
    int cell = 0;
    const PlanetSource fine = made_source(0.0, 20.0, 400, 400, 0.05, [&](double, double) {
        ++cell;
        return (cell + (cell - 1) / 400) % 2 == 0 ? 1000.0 : 0.0;
    });
    std::vector<PlanetSource> sources;
    sources.push_back({fine.heights_m.copy(), fine.west, fine.north, fine.cell_width, fine.cell_height});
    const PlanetTerrain terrain(kWgs84, std::move(sources), {.detail = 0.0});
    for (double at = 5.0; at < 15.0; at += 0.37)
        EXPECT_NEAR(terrain.height_m(direction(at, 20.3 - at), 1), 500.0, 1.0);
    // Finely, the cells themselves.
    EXPECT_LT(std::abs(terrain.height_m(direction(10.025, 10.025), 14)
                       - terrain.height_m(direction(10.075, 10.025), 14)),
              1001.0f);
    EXPECT_GT(std::abs(terrain.height_m(direction(10.025, 10.025), 14)
                       - terrain.height_m(direction(10.075, 10.025), 14)),
              999.0f);
}

TEST(PlanetTerrain, ShowsTheFinerSourceAndBlendsItOverItsBorder)
{
    std::vector<PlanetSource> sources;
    sources.push_back(world([](double, double) { return 100.0; }));
    sources.push_back(made_source(10.0, 20.0, 200, 200, 0.05, [](double, double) { return 900.0; }));
    const PlanetTerrain terrain(kWgs84, std::move(sources), {.detail = 0.0, .border_cells = 20});
    EXPECT_FLOAT_EQ(terrain.height_m(direction(15.0, 15.0), 13), 900.0f);
    EXPECT_FLOAT_EQ(terrain.height_m(direction(9.9, 15.0), 13), 100.0f);
    float before_m = 100.0f;
    for (double longitude = 9.9; longitude < 11.2; longitude += 0.005) {
        const float here_m = terrain.height_m(direction(longitude, 15.0), 13);
        EXPECT_GE(here_m, before_m - 1e-3f);
        EXPECT_LT(here_m - before_m, 800.0f * 0.005f / 0.05f * 1.5f / 20.0f + 8.0f);
        before_m = here_m;
    }
    EXPECT_FLOAT_EQ(before_m, 900.0f);
}

TEST(PlanetTerrain, FillsHolesFromTheCoarserSource)
{
    std::vector<PlanetSource> sources;
    sources.push_back(world([](double, double) { return 100.0; }));
    sources.push_back(made_source(10.0, 20.0, 200, 200, 0.05, [](double longitude, double latitude) {
        const bool hole = std::hypot(longitude - 15.0, latitude - 15.0) < 1.0;
        return hole ? std::numeric_limits<double>::quiet_NaN() : 900.0;
    }));
    const PlanetTerrain terrain(kWgs84, std::move(sources), {.detail = 0.0, .border_cells = 10});
    EXPECT_FLOAT_EQ(terrain.height_m(direction(15.0, 15.0), 13), 100.0f);
    EXPECT_FLOAT_EQ(terrain.height_m(direction(13.0, 15.0), 13), 900.0f);
    for (const std::uint32_t level : {0U, 5U, 9U})
        EXPECT_FALSE(std::isnan(terrain.height_m(direction(14.1, 15.0), level)));
}

TEST(PlanetTerrain, GoesRoundTheGlobeAndOverThePoles)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)), {.detail = 0.0});
    for (double latitude = -88.0; latitude < 89.0; latitude += 3.7)
        EXPECT_NEAR(terrain.height_m(direction(179.9999, latitude), 10),
                    terrain.height_m(direction(-179.9999, latitude), 10), 0.5);
    const PlanetTerrain cap(kWgs84, one(world([](double, double latitude) { return 20.0 * latitude; })),
                            {.sea = false, .detail = 0.0});
    for (double longitude = -180.0; longitude < 180.0; longitude += 31.0) {
        EXPECT_NEAR(cap.height_m(direction(longitude, 89.99), 10), 1780.0, 10.0);
        EXPECT_NEAR(cap.height_m(direction(longitude, -89.99), 10), -1780.0, 10.0);
    }
}

TEST(PlanetTerrain, DrawsTheSeaLevelAndWithoutDetail)
{
    const HeightOf coast = [](double longitude, double) { return 80.0 * longitude; };
    const PlanetTerrain terrain(kWgs84, one(world(coast)));
    const TilePlace sea = place_in_tile(direction(-40.0, 10.0), 12);
    const TileHeights heights = terrain.heights_of(sea.tile);
    EXPECT_EQ(heights.range.lowest_m, 0.0f);
    EXPECT_EQ(heights.range.highest_m, 0.0f);
    EXPECT_TRUE(std::ranges::all_of(heights.measured.values(), [](std::uint8_t one) { return one == 1; }));
    const PlanetTerrain dry(kWgs84, one(world(coast)), {.sea = false, .detail = 0.0});
    EXPECT_NEAR(dry.height_m(direction(-41.0, 11.0), 12), -3280.0, 1e-2);
}

TEST(PlanetTerrain, MarksWhereDetailIsMadeUp)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills, 1.0)), {.finest_spacing_m = 50.0});
    const PlanetTerrain plain(kWgs84, one(world(hills, 1.0)), {.detail = 0.0, .finest_spacing_m = 50.0});
    // Samples 100 km apart, as a cell is: nothing is made up.
    const TileHeights coarse = terrain.heights_of({0, 0, 0, 0});
    EXPECT_TRUE(same_bytes(coarse, plain.heights_of({0, 0, 0, 0})));
    EXPECT_EQ(coarse.measured(60, 60), 1);
    const PlanetTile tile = {0, 11, 900, 700};
    const TileHeights fine = terrain.heights_of(tile);
    EXPECT_TRUE(std::ranges::all_of(fine.measured.values(), [](std::uint8_t one) { return one == 0; }));
    EXPECT_FALSE(std::ranges::equal(fine.heights_m.values(), plain.heights_of(tile).heights_m.values()));
    EXPECT_TRUE(std::ranges::all_of(plain.heights_of(tile).measured.values(),
                                    [](std::uint8_t one) { return one == 1; }));
}

TEST(PlanetTerrain, KeepsTheReliefOfALevelInTheNextAndAddsSmallerOne)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)), {.finest_spacing_m = 20.0});
    std::mt19937 random(4);
    std::uniform_real_distribution<double> longitude(-180.0, 180.0);
    std::uniform_real_distribution<double> latitude(-80.0, 80.0);
    std::vector<double> change_m(13, 0.0);
    for (int i = 0; i < 200; ++i) {
        const Vector3 place = direction(longitude(random), latitude(random));
        for (std::uint32_t level = 2; level < change_m.size(); ++level)
            change_m[level] +=
                std::abs(terrain.height_m(place, level) - terrain.height_m(place, level - 1)) / 200.0;
    }
    for (std::uint32_t level = 4; level < change_m.size(); ++level) {
        EXPECT_GT(change_m[level], 0.0);
        EXPECT_LT(change_m[level], change_m[level - 2]) << level;
    }
    EXPECT_LT(change_m[12], 0.1 * change_m[4]);
}

TEST(PlanetTerrain, LiesWithinTheRangeItPromises)
{
    const PlanetTerrain terrain(kWgs84, one(world(hills)),
                                {.sea = false, .detail = 3.0, .finest_spacing_m = 50.0});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> side(-1.0, 1.0);
    for (int i = 0; i < 3000; ++i) {
        const float height_m = terrain.height_m(normalized({side(random), side(random), side(random)}), 11);
        EXPECT_GE(height_m, terrain.heights().lowest_m);
        EXPECT_LE(height_m, terrain.heights().highest_m);
    }
}

TEST(PlanetTerrain, IsASmoothGlobeWithoutSources)
{
    const PlanetTerrain terrain(sphere_of_radius(1000.0), {}, {.finest_spacing_m = 1.0});
    EXPECT_EQ(terrain.heights_of({1, 2, 3, 1}).range.highest_m, 0.0f);
    EXPECT_EQ(terrain.deepest_level(), 4U);
}

TEST(PlanetTerrain, RefusesSourcesAndOptionsOutOfRange)
{
    EXPECT_THROW(PlanetTerrain(kWgs84, one(made_source(0.0, 95.0, 10, 10, 1.0, hills))), InvalidInput);
    EXPECT_THROW(PlanetTerrain(kWgs84, one(made_source(0.0, 10.0, 10, 400, 1.0, hills))), InvalidInput);
    EXPECT_THROW(PlanetTerrain(kWgs84, one(made_source(0.0, 10.0, 10, 10, NAN, hills))), InvalidInput);
    EXPECT_THROW(PlanetTerrain(kWgs84, one(PlanetSource())), InvalidInput);
    EXPECT_THROW(PlanetTerrain(kWgs84, {}, {.detail = -1.0}), InvalidInput);
    EXPECT_THROW(PlanetTerrain(kWgs84, {}, {.finest_spacing_m = 0.0}), InvalidInput);
    EXPECT_THROW(PlanetTerrain(Globe{0.0, 1.0}, {}), InvalidInput);
}

TEST(DetailBand, IsSmoothWithinAFeatureAndHasNoMeanToSpeakOf)
{
    DetailBand band(8, 7);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> side(-1.0, 1.0);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const Vector3 place = normalized({side(random), side(random), side(random)});
        const double here = band.at(place);
        const double step = 1e-3 * band.wavelength();
        EXPECT_LT(std::abs(band.at(normalized(place + Vector3{step, -step, step})) - here), 0.01);
        EXPECT_LE(std::abs(here), 1.1);
        sum += here;
        squares += here * here;
    }
    EXPECT_LT(std::abs(sum / 4000.0), 0.02);
    EXPECT_GT(std::sqrt(squares / 4000.0), 0.2);
}

TEST(DetailBand, DoesNotRememberWhereItWasAskedBefore)
{
    DetailBand used(12, 1);
    for (double x = 0.0; x < 1.0; x += 0.01)
        used.at(normalized({x, 1.0 - x, 0.5}));
    const Vector3 place = normalized({0.3, -0.2, 0.9});
    EXPECT_EQ(used.at(place), DetailBand(12, 1).at(place));
    EXPECT_NE(used.at(place), DetailBand(12, 2).at(place));
}

} // namespace
} // namespace duskline
