#include <duskline/geometry/grid.h>

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <limits>
#include <utility>

namespace duskline {
namespace {

TEST(Grid, HoldsItsValuesRowAfterRow)
{
    Grid<int> grid(2, 3, 7);
    grid(1, 0) = 4;
    EXPECT_EQ(grid.rows(), 2U);
    EXPECT_EQ(grid.columns(), 3U);
    EXPECT_EQ(grid.size(), 6U);
    EXPECT_EQ(grid.data()[3], 4);
    EXPECT_EQ(grid.row(1)[0], 4);
    EXPECT_EQ(grid.values()[5], 7);
    EXPECT_FALSE(grid.empty());
}

TEST(Grid, MovesAndCopiesOnlyWhenAsked)
{
    static_assert(
        !std::is_copy_constructible_v<Grid<int>> && std::is_nothrow_move_constructible_v<Grid<int>>);
    Grid<int> grid(2, 2, 1);
    Grid<int> copy = grid.copy();
    copy(0, 0) = 9;
    EXPECT_EQ(grid(0, 0), 1);
    const int* values = grid.data();
    const Grid<int> moved = std::move(grid);
    EXPECT_EQ(moved.data(), values);
}

TEST(Grid, WithoutRowsOrColumnsIsEmpty)
{
    EXPECT_TRUE(Grid<int>().empty());
    EXPECT_TRUE(Grid<int>(0, 5).empty());
    EXPECT_TRUE(Grid<int>(5, 0).empty());
    EXPECT_EQ(Grid<int>(5, 0).rows(), 5U);
    EXPECT_TRUE((GridView<int>().empty()));
    EXPECT_TRUE((Grid<int>(0, 5).copy().empty()));
}

TEST(Grid, SizesThatCannotBeAddressedAreRefusedAndNotWrappedAround)
{
    const std::size_t half = std::size_t{1} << 32U;
    EXPECT_THROW(Grid<float>(half, half), InvalidInput) << "2^64 values, which wraps to none";
    EXPECT_THROW(Grid<float>(half, half + 1), InvalidInput);
    EXPECT_THROW(Grid<float>(std::numeric_limits<std::size_t>::max(), 1), InvalidInput);
    EXPECT_THROW(Grid<float>(std::size_t{1} << 61U, 1), InvalidInput) << "2^63 bytes";
}

TEST(GridView, ReachesRowsThroughTheirStride)
{
    Grid<int> grid(4, 5, 0);
    for (std::size_t i = 0; i < 20; ++i)
        grid.values()[i] = static_cast<int>(i);
    const GridView<int> window = grid.view().window(1, 2, 2, 3);
    EXPECT_EQ(window.rows(), 2U);
    EXPECT_EQ(window.columns(), 3U);
    EXPECT_EQ(window.row_stride(), 5U);
    EXPECT_EQ(window.size(), 6U);
    EXPECT_EQ(window(0, 0), 7);
    EXPECT_EQ(window(1, 2), 14);
    EXPECT_EQ(window.row(1).size(), 3U);
    EXPECT_EQ(window.window(1, 1, 1, 1)(0, 0), 13);
    window(0, 1) = 100;
    EXPECT_EQ(grid(1, 3), 100);
    const GridView<const int> read_only = window;
    EXPECT_EQ(read_only(0, 1), 100);
    EXPECT_EQ(read_only.row_stride(), 5U);
}

TEST(GridView, ValuesBeyondTheFourBillionthAreTheirOwn)
{
    // Address space only: no memory is used but for the page that is written.
    constexpr std::size_t rows = 70000;
    void* space = mmap(nullptr, rows * rows, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (space == MAP_FAILED)
        GTEST_SKIP() << "no 5 GB of address space";
    const GridView<char> view(static_cast<char*>(space), rows, 10, rows);
    view(rows - 1, 9) = 'x';
    EXPECT_EQ(static_cast<const char*>(space)[(rows - 1) * rows + 9], 'x');
    EXPECT_EQ(view.window(rows - 1, 8, 1, 2)(0, 1), 'x');
    EXPECT_EQ(view.row(rows - 1)[9], 'x');
    munmap(space, rows * rows);
}

} // namespace
} // namespace duskline
