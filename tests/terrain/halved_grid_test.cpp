#include <duskline/terrain/halved_grid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

TEST(HalvedGrid, HoldsTheMeansOfTheDataOfSquares)
{
    const float none = std::numeric_limits<float>::quiet_NaN();
    Grid<float> fine(3, 5, 1.0f);
    fine(0, 0) = 2.0f;
    fine(1, 1) = 4.0f;
    fine(0, 2) = none;
    fine(1, 2) = 7.0f;
    fine(2, 4) = 9.0f;

    const Grid<float> half = halved(fine.view());

    ASSERT_EQ(half.rows(), 2U);
    ASSERT_EQ(half.columns(), 3U);
    EXPECT_EQ(half(0, 0), 2.0f);
    EXPECT_EQ(half(0, 1), 3.0f); // of three
    EXPECT_EQ(half(1, 2), 9.0f); // of one
}

TEST(HalvedGrid, HasNoDataWhereThereAreNone)
{
    Grid<float> fine(2, 4, std::numeric_limits<float>::quiet_NaN());
    fine(0, 3) = 5.0f;

    const Grid<float> half = halved(fine.view());

    EXPECT_TRUE(std::isnan(half(0, 0)));
    EXPECT_EQ(half(0, 1), 5.0f);
}

} // namespace
} // namespace duskline
