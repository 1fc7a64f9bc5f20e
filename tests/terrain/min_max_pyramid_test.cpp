#include "terrains.h"

#include <duskline/terrain/min_max_pyramid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace duskline {
namespace {

HeightRange range_of_block(const HeightField& field, std::size_t level, std::size_t row, std::size_t column)
{
    const std::size_t size = std::size_t{1} << level;
    HeightRange range;
    for (std::size_t y = row * size; y <= std::min((row + 1) * size, field.rows() - 1); ++y)
        for (std::size_t x = column * size; x <= std::min((column + 1) * size, field.columns() - 1); ++x)
            range.include(field.heights_m(y, x));
    return range;
}

TEST(MinMaxPyramid, EveryBlockHoldsTheLowestAndHighestOfItsSamplesBordersIncluded)
{
    for_seeds(60, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const HeightField field = terrain;
        const MinMaxPyramid pyramid(field);
        ASSERT_GE(pyramid.levels(), 1U);
        for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
            const std::size_t size = std::size_t{1} << level;
            for (std::size_t row = 0; row == 0 || row * size < field.rows() - 1; ++row)
                for (std::size_t column = 0; column == 0 || column * size < field.columns() - 1; ++column) {
                    const HeightRange range = pyramid.range(level, row, column);
                    const HeightRange expected = range_of_block(field, level, row, column);
                    ASSERT_EQ(range.lowest_m, expected.lowest_m) << level << ' ' << row << ' ' << column;
                    ASSERT_EQ(range.highest_m, expected.highest_m) << level << ' ' << row << ' ' << column;
                }
        }
        const std::size_t top = std::size_t{1} << pyramid.levels();
        EXPECT_GE(top, std::max(field.rows(), field.columns()) - 1);
        EXPECT_EQ(pyramid.total().highest_m, height_range(field).highest_m);
        EXPECT_EQ(pyramid.total().lowest_m, height_range(field).lowest_m);
    });
}

TEST(MinMaxPyramid, NothingHasNoLevelsAndNoDataAnEmptyRange)
{
    EXPECT_EQ(MinMaxPyramid(HeightField{}).levels(), 0U);
    EXPECT_GT(MinMaxPyramid(HeightField{}).total().lowest_m, 1e30f);
    const Terrain holes{Grid<float>(3, 3, std::numeric_limits<float>::quiet_NaN()), {1.0, 1.0}};
    EXPECT_EQ(MinMaxPyramid(holes).total().lowest_m, std::numeric_limits<float>::infinity());
    EXPECT_EQ(MinMaxPyramid(holes).total().highest_m, -std::numeric_limits<float>::infinity());
}

TEST(MinMaxPyramid, ProgressNeverFallsAndEndsAtOne)
{
    Dice dice(1);
    const Terrain terrain = random_terrain(dice, {.smallest = 60, .largest = 60});
    double last = 0.0;
    const auto progress = [&](double done) {
        EXPECT_GE(done, last);
        last = done;
        return true;
    };
    const MinMaxPyramid pyramid(terrain, {.threads = 2, .progress = progress});
    EXPECT_EQ(last, 1.0);
}

} // namespace
} // namespace duskline
