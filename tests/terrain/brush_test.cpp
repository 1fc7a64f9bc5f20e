#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/brush.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

constexpr CellSize kCells = {10.0, 20.0};
constexpr auto kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Brush, RaisesMostInTheMiddleAndNothingBeyondItsRadius)
{
    Grid<float> heights_m(21, 41, 5.0f);
    const CellRectangle changed =
        stroke(heights_m.view(), kCells, {10.0, 20.0, 0.0}, {.radius_m = 60.0, .amount_m = 8.0});
    EXPECT_EQ(heights_m(10, 20), 13.0f);
    EXPECT_GT(heights_m(10, 23), heights_m(10, 25));
    EXPECT_EQ(heights_m(10, 23), heights_m(10, 17));
    EXPECT_EQ(heights_m(11, 20), heights_m(10, 22)); // both 20 m away
    for (std::size_t row = 0; row < 21; ++row)
        for (std::size_t column = 0; column < 41; ++column) {
            const bool inside =
                row - changed.first_row < changed.rows && column - changed.first_column < changed.columns;
            if (!inside) {
                EXPECT_EQ(heights_m(row, column), 5.0f);
            }
        }
    EXPECT_EQ(changed.rows, 7U);
    EXPECT_EQ(changed.columns, 13U);
}

TEST(Brush, LowersWhatItHasRaised)
{
    Grid<float> heights_m(9, 9, 100.0f);
    stroke(heights_m.view(), kCells, {4.0, 4.0, 0.0}, {.amount_m = 16.0});
    stroke(heights_m.view(), kCells, {4.0, 4.0, 0.0}, {.effect = BrushEffect::lower, .amount_m = 16.0});
    for (const float height_m : heights_m.values())
        EXPECT_NEAR(height_m, 100.0f, 1e-4f);
}

TEST(Brush, SmoothsTowardsTheNeighboursAndLeavesAPlaneAlone)
{
    Grid<float> heights_m(9, 9);
    for (std::size_t row = 0; row < 9; ++row)
        for (std::size_t column = 0; column < 9; ++column)
            heights_m(row, column) = static_cast<float>(3 * row + column);
    heights_m(4, 4) += 90.0f;
    stroke(heights_m.view(), {1.0, 1.0}, {4.0, 4.0, 0.0},
           {.effect = BrushEffect::smooth, .radius_m = 0.5, .smoothing = 1.0});
    EXPECT_NEAR(heights_m(4, 4), 16.0f + 10.0f, 1e-4f);
    const Grid<float> before_m = heights_m.copy();
    stroke(heights_m.view(), {1.0, 1.0}, {1.0, 1.0, 0.0},
           {.effect = BrushEffect::smooth, .radius_m = 0.5, .smoothing = 1.0});
    EXPECT_NEAR(heights_m(1, 1), before_m(1, 1), 1e-4f);
}

TEST(Brush, WorksAtBordersAndLeavesHoles)
{
    Grid<float> heights_m(5, 5, 0.0f);
    heights_m(0, 1) = kNaN;
    const CellRectangle corner =
        stroke(heights_m.view(), {1.0, 1.0}, {0.0, 0.0, 0.0}, {.radius_m = 2.5, .amount_m = 1.0});
    EXPECT_EQ(corner.first_row, 0U);
    EXPECT_EQ(corner.rows, 3U);
    EXPECT_TRUE(std::isnan(heights_m(0, 1)));
    EXPECT_EQ(heights_m(0, 0), 1.0f);
    EXPECT_EQ(stroke(heights_m.view(), {1.0, 1.0}, {-9.0, 2.0, 0.0}, {.radius_m = 2.5}).rows, 0U);
}

TEST(Brush, RefusesWhatIsOutOfRange)
{
    Grid<float> heights_m(5, 5, 0.0f);
    EXPECT_THROW(stroke(heights_m.view(), kCells, {}, {.radius_m = 0.0}), InvalidInput);
    EXPECT_THROW(stroke(heights_m.view(), kCells, {}, {.amount_m = -1.0}), InvalidInput);
    EXPECT_THROW(stroke(heights_m.view(), kCells, {}, {.smoothing = 1.5}), InvalidInput);
    EXPECT_THROW(stroke(heights_m.view(), {0.0, 1.0}, {}, {}), InvalidInput);
}

} // namespace
} // namespace duskline
