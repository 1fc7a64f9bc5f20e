#include <duskline/geometry/cell_rectangle.h>

#include <gtest/gtest.h>

namespace duskline {
namespace {

TEST(CellRectangle, UnitedHoldsBoth)
{
    EXPECT_EQ(united({2, 3, 4, 5}, {1, 10, 2, 2}), (CellRectangle{1, 3, 5, 9}));
    EXPECT_EQ(united({2, 3, 4, 5}, {3, 4, 1, 1}), (CellRectangle{2, 3, 4, 5}));
}

TEST(CellRectangle, UnitedWithNoneIsTheOther)
{
    EXPECT_EQ(united({}, {1, 10, 2, 2}), (CellRectangle{1, 10, 2, 2}));
    EXPECT_EQ(united({1, 10, 2, 2}, {7, 7, 0, 3}), (CellRectangle{1, 10, 2, 2}));
}

TEST(CellRectangle, GrowsUpToTheBordersOfItsGrid)
{
    EXPECT_EQ(grown({5, 6, 2, 3}, 2, 100, 100), (CellRectangle{3, 4, 6, 7}));
    EXPECT_EQ(grown({1, 6, 2, 3}, 4, 5, 11), (CellRectangle{0, 2, 5, 9}));
    EXPECT_EQ(grown({5, 6, 0, 3}, 2, 100, 100), CellRectangle{});
}

} // namespace
} // namespace duskline
