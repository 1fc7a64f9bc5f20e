#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr SampleGrid kSmall{.rows = 21, .columns = 41, .cell_size_m = {2.0, 5.0}};
constexpr std::size_t kMiddleRow = 10;
constexpr std::size_t kMiddleColumn = 20;

TEST(SyntheticTerrain, APlaneFallsTowardsItsAspectByItsSlope)
{
    const Terrain east = make_plane({.grid = kSmall, .height_m = 7.0, .slope = 45_deg, .aspect = 90_deg});
    EXPECT_EQ(east.heights_m(kMiddleRow, kMiddleColumn), 7.0f);
    EXPECT_FLOAT_EQ(east.heights_m(3, kMiddleColumn + 1), 5.0f);
    const Terrain south = make_plane({.grid = kSmall, .slope = 45_deg, .aspect = 180_deg});
    EXPECT_FLOAT_EQ(south.heights_m(kMiddleRow + 1, 0), -5.0f);
    EXPECT_FLOAT_EQ(south.heights_m(kMiddleRow - 2, 40), 10.0f);
}

TEST(SyntheticTerrain, AWallIsAsThickAndLongAsAskedAndRunsAlongItsCourse)
{
    const Terrain north_south = make_wall({.grid = kSmall,
                                           .ground_m = 1.0,
                                           .height_m = 4.0,
                                           .thickness_m = 2.0,
                                           .length_m = 20.0,
                                           .offset_m = 6.0});
    for (std::size_t row = 0; row < 21; ++row)
        for (std::size_t column = 0; column < 41; ++column) {
            const bool inside = column == kMiddleColumn + 3 && row >= 8 && row <= 12;
            EXPECT_EQ(north_south.heights_m(row, column), inside ? 5.0f : 1.0f) << row << ' ' << column;
        }
    const Terrain east_west = make_wall({.grid = kSmall, .course = 90_deg, .thickness_m = 5.0});
    EXPECT_EQ(east_west.heights_m(kMiddleRow, 0), 10.0f);
    EXPECT_EQ(east_west.heights_m(kMiddleRow + 1, kMiddleColumn), 0.0f);
}

TEST(SyntheticTerrain, AStepIsLowOnTheSideItFaces)
{
    const Terrain step = make_step({.grid = kSmall, .ground_m = -3.0, .height_m = 8.0, .facing = 270_deg});
    EXPECT_EQ(step.heights_m(0, kMiddleColumn), 5.0f);
    EXPECT_EQ(step.heights_m(0, kMiddleColumn - 1), -3.0f);
    EXPECT_EQ(step.heights_m(0, 40), 5.0f);
}

TEST(SyntheticTerrain, RoundShapesHaveTheirHeightsAtCentreHalfwayAndRim)
{
    const SampleGrid grid{.rows = 101, .columns = 101};
    const Terrain cone = make_cone({.grid = grid, .ground_m = 1.0, .height_m = 40.0, .slope = 45_deg});
    EXPECT_EQ(cone.heights_m(50, 50), 41.0f);
    EXPECT_FLOAT_EQ(cone.heights_m(30, 50), 21.0f);
    EXPECT_EQ(cone.heights_m(50, 5), 1.0f);

    const Terrain dome = make_dome({.grid = grid, .radius_m = 50.0});
    EXPECT_EQ(dome.heights_m(50, 50), 50.0f);
    EXPECT_EQ(dome.heights_m(50 - 30, 50), 40.0f);
    EXPECT_EQ(dome.heights_m(0, 50), 0.0f);

    const Terrain bowl = make_pit({.grid = grid, .ground_m = 2.0, .radius_m = 50.0, .depth_m = 20.0});
    EXPECT_EQ(bowl.heights_m(50, 50), -18.0f);
    EXPECT_EQ(bowl.heights_m(50, 50 + 30), -8.0f);
    EXPECT_EQ(bowl.heights_m(50, 50 + 40), 2.0f);
    EXPECT_EQ(bowl.heights_m(0, 0), 2.0f);

    const Terrain hill = make_gaussian_hill({.grid = grid, .height_m = 30.0, .sigma_m = 20.0});
    EXPECT_EQ(hill.heights_m(50, 50), 30.0f);
    EXPECT_FLOAT_EQ(hill.heights_m(50, 30), static_cast<float>(30.0 * std::exp(-0.5)));
}

TEST(SyntheticTerrain, AValleyRisesEvenlyToItsRims)
{
    const Terrain valley =
        make_valley({.grid = kSmall, .bottom_m = 100.0, .course = 0_deg, .slope = 45_deg, .depth_m = 30.0});
    for (std::size_t row = 0; row < 21; ++row) {
        EXPECT_EQ(valley.heights_m(row, kMiddleColumn), 100.0f);
        EXPECT_FLOAT_EQ(valley.heights_m(row, kMiddleColumn - 4), 108.0f);
        EXPECT_EQ(valley.heights_m(row, 0), 130.0f);
    }
}

TEST(SyntheticTerrain, MountainsDependOnThePlaceAndTheSeedAlone)
{
    const MountainsOptions large{.grid = {.rows = 101, .columns = 121, .cell_size_m = {30.0, 30.0}},
                                 .seed = 5};
    MountainsOptions small = large;
    small.grid.rows = 31;
    small.grid.columns = 21;
    MountainsOptions other = large;
    other.seed = 6;
    const Terrain a = make_mountains(large);
    const Terrain b = make_mountains(small, {.threads = 1});
    const Terrain c = make_mountains(other);
    for (std::size_t row = 0; row < 31; ++row)
        for (std::size_t column = 0; column < 21; ++column)
            EXPECT_EQ(a.heights_m(row + 35, column + 50), b.heights_m(row, column));
    EXPECT_FALSE(std::ranges::equal(a.heights_m.values(), c.heights_m.values()));
}

TEST(SyntheticTerrain, MountainsAreTheSameOnEveryMachine)
{
    // Red means that the mountains of every test, benchmark and picture have changed.
    const Terrain terrain =
        make_mountains({.grid = {.rows = 64, .columns = 64, .cell_size_m = {30.0, 30.0}}});
    std::uint64_t hash = 0;
    for (const float h : terrain.heights_m.values())
        hash = hash * 31 + static_cast<std::uint64_t>(std::lround(h * 1024.0f));
    EXPECT_EQ(hash, 12453444690886104381U);
}

TEST(SyntheticTerrain, MountainsStayBetweenTheirBoundsAndUseMostOfThem)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 512, .columns = 512, .cell_size_m = {75.0, 75.0}},
                        .lowest_m = 100.0,
                        .height_m = 1000.0});
    const auto [low, high] = std::ranges::minmax(terrain.heights_m.values());
    EXPECT_GE(low, 100.0f);
    EXPECT_LT(low, 300.0f);
    EXPECT_LE(high, 1100.0f);
    EXPECT_GT(high, 850.0f);
}

TEST(SyntheticTerrain, EmptyAndSingleCellGridsAreFine)
{
    EXPECT_TRUE(make_mountains({.grid = {.rows = 0, .columns = 9}}).heights_m.empty());
    EXPECT_TRUE(make_cone({.grid = {.rows = 4, .columns = 0}}).heights_m.empty());
    EXPECT_EQ(make_cone({.grid = {.rows = 1, .columns = 1}, .height_m = 3.0}).heights_m(0, 0), 3.0f);
}

TEST(SyntheticTerrain, ValuesOutOfRangeAreRefused)
{
    EXPECT_THROW(make_plane({.slope = 90_deg}), InvalidInput);
    EXPECT_THROW(make_plane({.grid = {.cell_size_m = {0.0, 1.0}}}), InvalidInput);
    EXPECT_THROW(make_wall({.thickness_m = std::nan("")}), InvalidInput);
    EXPECT_THROW(make_step({.facing = Angle::from_degrees(std::nan(""))}), InvalidInput);
    EXPECT_THROW(make_cone({.slope = 0_deg}), InvalidInput);
    EXPECT_THROW(make_dome({.radius_m = -1.0}), InvalidInput);
    EXPECT_THROW(make_pit({.radius_m = 5.0, .depth_m = 6.0}), InvalidInput);
    EXPECT_THROW(make_gaussian_hill({.sigma_m = 0.0}), InvalidInput);
    EXPECT_THROW(make_valley({.depth_m = 0.0}), InvalidInput);
    EXPECT_THROW(make_mountains({.roughness = 1.5}), InvalidInput);
}

} // namespace
} // namespace duskline
