#include "terrains.h"

#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/refined.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace duskline {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Refined, FinerCellsCoverTheSameGround)
{
    // Two cells in six: the centres lie a sixth of a cell from the border, then a third apart.
    const std::vector<FinerPlace> places = finer_places(6, 2);
    const double expected[] = {-1.0 / 3.0, 0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 4.0 / 3.0};
    const std::size_t nearest[] = {0, 0, 0, 1, 1, 1};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(places[i].place, expected[i], 1e-12) << i;
        EXPECT_EQ(places[i].nearest, nearest[i]) << i;
    }
    const Terrain terrain{Grid<float>(2, 3, 5.0f), {10.0, 20.0}};
    const Terrain finer = refined(terrain, 8, 9);
    EXPECT_DOUBLE_EQ(finer.cell_size_m.y, 5.0);
    EXPECT_DOUBLE_EQ(finer.cell_size_m.x, 10.0 / 3.0);
}

TEST(Refined, IsTheGroundBetweenSamplesWhereverThereIsGround)
{
    for_seeds(20, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const std::size_t rows = terrain.heights_m.rows() + dice.below(90);
        const std::size_t columns = terrain.heights_m.columns() * (1 + dice.below(4));
        const Terrain finer = refined(terrain, rows, columns, {.threads = 2});
        const HeightRange heights = height_range(terrain);
        const double rounding_m = 4e-7 * std::max(std::abs(heights.lowest_m), std::abs(heights.highest_m));
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                const FinerPlace down = finer_place(y, rows, terrain.heights_m.rows());
                const FinerPlace across = finer_place(x, columns, terrain.heights_m.columns());
                ASSERT_EQ(std::isnan(finer.heights_m(y, x)),
                          std::isnan(terrain.heights_m(down.nearest, across.nearest)));
                const auto ground_m = ground_height_m(terrain, down.place, across.place);
                if (ground_m && !std::isnan(finer.heights_m(y, x))) {
                    ASSERT_NEAR(finer.heights_m(y, x), *ground_m, rounding_m);
                }
            }
    });
}

TEST(Refined, OddMultiplesKeepEverySample)
{
    Dice dice(4);
    const Terrain terrain = random_terrain(dice, {.smallest = 10, .largest = 20});
    const Terrain finer = refined(terrain, 3 * terrain.heights_m.rows(), 5 * terrain.heights_m.columns());
    for (std::size_t y = 0; y < terrain.heights_m.rows(); ++y)
        for (std::size_t x = 0; x < terrain.heights_m.columns(); ++x) {
            const float sample = terrain.heights_m(y, x);
            const float kept = finer.heights_m(3 * y + 1, 5 * x + 2);
            ASSERT_TRUE(kept == sample || (std::isnan(kept) && std::isnan(sample))) << y << ' ' << x;
        }
}

TEST(Refined, OneCellAndOneForOneAreThemselves)
{
    const Terrain one{Grid<float>(1, 1, 7.0f), {1.0, 1.0}};
    const Terrain twelve = refined(one, 4, 3);
    for (const float height : twelve.heights_m.values())
        EXPECT_EQ(height, 7.0f);
    Dice dice(9);
    const Terrain terrain = random_terrain(dice, {.smallest = 20, .largest = 30});
    const Terrain same = refined(terrain, terrain.heights_m.rows(), terrain.heights_m.columns());
    EXPECT_EQ(
        std::memcmp(same.heights_m.data(), terrain.heights_m.data(), same.heights_m.size() * sizeof(float)),
        0);
    EXPECT_TRUE(refined(Grid<float>(0, 5).view(), 0, 9).empty());
}

TEST(Refined, NeverLeavesTheHeightsAroundAHoleAndAtTheBorder)
{
    Terrain terrain{Grid<float>(3, 3, 10.0f), {1.0, 1.0}};
    terrain.heights_m(0, 0) = 20.0f;
    terrain.heights_m(1, 1) = kNan;
    const Terrain finer = refined(terrain, 24, 24);
    for (std::size_t y = 0; y < 24; ++y)
        for (std::size_t x = 0; x < 24; ++x) {
            const bool hole = y / 8 == 1 && x / 8 == 1;
            ASSERT_EQ(std::isnan(finer.heights_m(y, x)), hole) << y << ' ' << x;
            if (!hole) {
                ASSERT_TRUE(finer.heights_m(y, x) >= 10.0f && finer.heights_m(y, x) <= 20.0f)
                    << y << ' ' << x;
            }
        }
    EXPECT_EQ(finer.heights_m(0, 0), 20.0f);
}

TEST(Refined, NormalsStayUnitVectorsAndTurnEvenly)
{
    NormalField bend{Grid<float>(1, 2), Grid<float>(1, 2), Grid<float>(1, 2)};
    const Vector3 left = upward_normal({0.5, 0.0});
    const Vector3 right = upward_normal({-0.5, 0.0});
    bend.east(0, 0) = static_cast<float>(left.x);
    bend.east(0, 1) = static_cast<float>(right.x);
    std::ranges::fill(bend.north.values(), 0.0f);
    std::ranges::fill(bend.up.values(), static_cast<float>(left.z));
    const NormalField finer = refined(bend, 3, 9);
    for (std::size_t x = 0; x < 9; ++x) {
        EXPECT_NEAR(std::hypot(finer.east(1, x), finer.up(1, x)), 1.0, 1e-6);
        if (x > 0) {
            EXPECT_GE(finer.east(1, x), finer.east(1, x - 1));
        }
    }
    EXPECT_NEAR(finer.east(0, 0), left.x, 1e-6);
    EXPECT_NEAR(finer.up(1, 4), 1.0, 0.02);
}

TEST(Refined, RefusesACoarserGrid)
{
    const Terrain terrain{Grid<float>(4, 6, 1.0f), {1.0, 1.0}};
    EXPECT_THROW(refined(terrain, 3, 6), InvalidInput);
    EXPECT_THROW(refined(terrain, 4, 5), InvalidInput);
}

} // namespace
} // namespace duskline
