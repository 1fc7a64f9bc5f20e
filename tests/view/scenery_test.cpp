#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/normals.h>
#include <duskline/terrain/synthetic_terrain.h>
#include <duskline/view/scenery.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

Terrain mountains()
{
    Terrain terrain = make_mountains({.grid = {.rows = 300, .columns = 400, .cell_size_m = {20.0, 25.0}},
                                      .height_m = 500.0,
                                      .feature_m = 2500.0});
    for (std::size_t row = 100; row < 150; ++row)
        for (float& height_m : terrain.heights_m.row(row).subspan(200, 100))
            height_m = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t row = 200; row < 300; ++row)
        for (float& height_m : terrain.heights_m.row(row).subspan(0, 100))
            height_m = 5.0f; // a lake
    return terrain;
}

TEST(Scenery, IsTheSameEachTime)
{
    const Terrain terrain = mountains();
    const Scenery a = usual_scenery(terrain);
    const Scenery b = usual_scenery(terrain);
    ASSERT_EQ(a.trees.size(), b.trees.size());
    EXPECT_GT(a.trees.size(), 500U);
    EXPECT_GT(a.towers.size(), 15U);
    for (std::size_t i = 0; i < a.trees.size(); ++i) {
        EXPECT_EQ(a.trees[i].row, b.trees[i].row);
        EXPECT_EQ(a.trees[i].turn.degrees(), b.trees[i].turn.degrees());
    }
}

TEST(Scenery, StandsWhereTheGroundIsNeitherLevelNorSteepNorHighNorMissing)
{
    const Terrain terrain = mountains();
    const HeightRange range = height_range(terrain);
    const Scenery scenery = usual_scenery(terrain);
    for (const auto* standing : {&scenery.trees, &scenery.towers})
        for (const StandingObject& object : *standing) {
            const float height_m = terrain.heights_m(object.row, object.column);
            ASSERT_FALSE(std::isnan(height_m));
            const Slope slope = slope_at(terrain, object.row, object.column);
            const double rise = std::hypot(slope.dz_dx, slope.dz_dy);
            EXPECT_GT(rise, 0.0);
            EXPECT_LT(rise, 0.71); // 35 degrees
        }
    for (const StandingObject& tree : scenery.trees)
        EXPECT_LT(terrain.heights_m(tree.row, tree.column),
                  range.lowest_m + 0.56f * (range.highest_m - range.lowest_m));
}

TEST(Scenery, HasAnAircraftThatKeepsClearOfTheGroundAndComesAround)
{
    const Terrain terrain = mountains();
    const Scenery scenery = usual_scenery(terrain);
    ASSERT_TRUE(scenery.aircraft);
    const CirclingAircraft& aircraft = *scenery.aircraft;
    for (int i = 0; i < 100; ++i) {
        const double seconds = aircraft.period_s * i / 100.0;
        const GridPoint at = place_of(aircraft, terrain.cell_size_m, seconds);
        const auto ground_m = ground_height_m(terrain, at.row, at.column);
        EXPECT_GT(at.height_m, ground_m.value_or(0.0) + 50.0);
        // It goes where it is headed.
        const GridPoint next = place_of(aircraft, terrain.cell_size_m, seconds + 0.01);
        const double east_m = (next.column - at.column) * terrain.cell_size_m.x;
        const double north_m = (at.row - next.row) * terrain.cell_size_m.y;
        const SineCosine heading = sine_cosine(heading_of(aircraft, seconds));
        EXPECT_NEAR((east_m * heading.sine + north_m * heading.cosine) / std::hypot(east_m, north_m), 1.0,
                    1e-3);
    }
    EXPECT_NEAR(place_of(aircraft, terrain.cell_size_m, aircraft.period_s).column,
                place_of(aircraft, terrain.cell_size_m, 0.0).column, 1e-6);
}

TEST(Scenery, TakesAnyGround)
{
    for (const auto& [rows, columns] : {std::pair{0, 0}, {1, 1}, {1, 40}, {3, 2}}) {
        const Terrain none{Grid<float>(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns),
                                       std::numeric_limits<float>::quiet_NaN()),
                           {5.0, 9.0}};
        EXPECT_TRUE(usual_scenery(none).trees.empty());
    }
    const Terrain plane = make_plane({.grid = {.rows = 50, .columns = 50}});
    EXPECT_TRUE(usual_scenery(plane).towers.empty());
    EXPECT_GT(usual_scenery(plane).clouds->height_m, 0.0);
}

TEST(Scenery, ReachesUpToItsHighest)
{
    const Scenery scenery{.towers = {{.height_m = 70.0}}, .clouds = CloudLayer{.height_m = 900.0}};
    const HeightRange range = height_range(scenery, {100.0f, 500.0f});
    EXPECT_EQ(range.lowest_m, 100.0f);
    EXPECT_EQ(range.highest_m, 900.0f);
    EXPECT_EQ(height_range({.towers = {{.height_m = 70.0}}}, {100.0f, 500.0f}).highest_m, 570.0f);
}

} // namespace
} // namespace duskline
