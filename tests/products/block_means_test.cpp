#include <duskline/products/block_means.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

Grid<float> plane(std::size_t rows, std::size_t columns)
{
    Grid<float> grid(rows, columns);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x)
            grid(y, x) = 3.0f + 0.5f * static_cast<float>(x) - 0.25f * static_cast<float>(y);
    return grid;
}

TEST(BlockMeans, GiveAPlaneBackUpToItsBorder)
{
    // 37 and 50 are no multiples of 8: the rest of a side goes on as the blocks before it.
    const Grid<float> grid = plane(37, 50);
    const BlockMeans means(grid.view(), 8);
    std::vector<float> row(50);
    for (std::size_t y = 0; y < 37; ++y) {
        means.row(y, row);
        for (std::size_t x = 0; x < 50; ++x)
            ASSERT_NEAR(row[x], grid(y, x), 1e-4f) << y << ", " << x;
    }
}

TEST(BlockMeans, PassOverHolesAndFillThem)
{
    Grid<float> grid(64, 64, 5.0f);
    for (std::size_t y = 8; y < 24; ++y)
        for (std::size_t x = 16; x < 40; ++x)
            grid(y, x) = std::numeric_limits<float>::quiet_NaN();
    const BlockMeans means(grid.view(), 8);
    std::vector<float> row(64);
    for (std::size_t y = 0; y < 64; ++y) {
        means.row(y, row);
        for (std::size_t x = 0; x < 64; ++x)
            if (!std::isnan(grid(y, x))) {
                ASSERT_NEAR(row[x], 5.0f, 1e-5f) << y << ", " << x;
            }
    }
}

TEST(BlockMeans, SmoothAnEdgeIntoTheGaussiansErrorFunction)
{
    Grid<float> grid(256, 256, 0.0f);
    for (std::size_t y = 0; y < 256; ++y)
        for (std::size_t x = 128; x < 256; ++x)
            grid(y, x) = 1.0f;
    BlockMeans means(grid.view(), 4);
    means.smooth(20.0);
    std::vector<float> row(256);
    means.row(100, row);
    for (std::size_t x = 60; x < 196; ++x) {
        const double offset = (static_cast<double>(x) - 127.5) / 20.0;
        EXPECT_NEAR(row[x], 0.5 * std::erfc(-offset / std::sqrt(2.0)), 0.02) << x;
    }
}

} // namespace
} // namespace duskline
