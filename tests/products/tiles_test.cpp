#include <duskline/geometry/invalid_input.h>
#include <duskline/products/tiles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace duskline {
namespace {

using Grey = Grid<std::uint8_t>;

std::vector<Grey> plain_tiles(std::size_t count, std::size_t rows, std::size_t columns)
{
    std::vector<Grey> tiles;
    for (std::size_t i = 0; i < count; ++i)
        tiles.emplace_back(rows, columns, static_cast<std::uint8_t>(100 + i));
    return tiles;
}

TEST(MeanOfCells, IsTheMeanOfWholeCells)
{
    Grey map(4, 6);
    for (std::size_t y = 0; y < 4; ++y)
        for (std::size_t x = 0; x < 6; ++x)
            map(y, x) = static_cast<std::uint8_t>(10 * y + x);
    const Grey small = mean_of_cells(map.view(), 2, 2);
    EXPECT_EQ(small(0, 0), 6); // 0 1 2 10 11 12
    EXPECT_EQ(small(1, 1), 29);
    EXPECT_TRUE(std::ranges::equal(mean_of_cells(map.view(), 4, 6).values(), map.values()));
}

TEST(MeanOfCells, TakesEveryCellOnceWhereSizesDoNotDivide)
{
    const Grey map(7, 5, 200);
    const Grey small = mean_of_cells(map.view(), 3, 2);
    EXPECT_TRUE(std::ranges::all_of(small.values(), [](std::uint8_t value) { return value == 200; }));
    Grey spot(7, 5, 0);
    spot(6, 4) = 255;
    EXPECT_GT(mean_of_cells(spot.view(), 3, 2)(2, 1), 0) << "the last cell belongs to the last pixel";
}

TEST(MeanOfCells, RefusesSizesItCannotMake)
{
    const Grey map(4, 6, 0);
    EXPECT_THROW(mean_of_cells(map.view(), 5, 6), InvalidInput);
    EXPECT_THROW(mean_of_cells(map.view(), 0, 6), InvalidInput);
}

TEST(Tiles, LieRowAfterRowWithoutAGap)
{
    const auto tiles = plain_tiles(5, 2, 3);
    const Grey atlas = tiled(tiles, {.columns = 3});
    ASSERT_EQ(atlas.rows(), 4U);
    ASSERT_EQ(atlas.columns(), 9U);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TilePlace place = tile_place({.columns = 3}, i, 2, 3);
        EXPECT_EQ(atlas(place.row, place.column), 100 + i);
        EXPECT_EQ(atlas(place.row + 1, place.column + 2), 100 + i);
    }
    EXPECT_EQ(atlas(3, 8), 0) << "no tile, no light";
}

TEST(Tiles, KeepTheirDistanceAndHaveCaptionsOverThem)
{
    const TileLayout layout = {.columns = 2, .gap = 3, .caption = 14};
    const auto tiles = plain_tiles(2, 30, 60);
    const std::vector<std::string> captions = {"08:15", ""};
    const Grey sheet = tiled(tiles, layout, captions);
    EXPECT_EQ(sheet.rows(), 3U + 14U + 30U + 3U);
    EXPECT_EQ(sheet.columns(), 3U + 60U + 3U + 60U + 3U);
    const auto text_pixels = [&](std::size_t first_column) {
        std::size_t count = 0;
        for (std::size_t y = 3; y < 17; ++y)
            for (std::size_t x = first_column; x < first_column + 60; ++x)
                count += sheet(y, x) > 200 ? 1U : 0U;
        return count;
    };
    // Points of the glyphs 0, 8, :, 1, 5 are 12 + 13 + 2 + 8 + 11, each 2 x 2 pixels.
    EXPECT_EQ(text_pixels(3), 4U * (12U + 13U + 2U + 8U + 11U));
    EXPECT_EQ(text_pixels(66), 0U);
    EXPECT_EQ(sheet(17, 3), 100);
    EXPECT_EQ(sheet(46, 66 + 59), 101);
}

TEST(Tiles, FillTheirRowsWhereTheyCan)
{
    EXPECT_EQ(columns_for(24, 100, 100), 6U);
    EXPECT_EQ(columns_for(12, 100, 100), 4U);
    EXPECT_EQ(columns_for(7, 100, 100), 4U);
    EXPECT_EQ(columns_for(1, 100, 100), 1U);
    EXPECT_EQ(columns_for(4, 1, 1000), 1U);
}

TEST(Tiles, OfDifferentSizesOrNoneAreRefused)
{
    std::vector<Grey> tiles = plain_tiles(2, 2, 3);
    tiles.emplace_back(3, 2, std::uint8_t{0});
    EXPECT_THROW(tiled(tiles, {}), InvalidInput);
    EXPECT_THROW(tiled({}, {}), InvalidInput);
    EXPECT_THROW(tiled(plain_tiles(1, 2, 2), {.columns = 0}), InvalidInput);
}

} // namespace
} // namespace duskline
