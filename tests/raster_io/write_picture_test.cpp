#include "raster_io/made_raster.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/write_picture.h>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace duskline {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

Grid<Pixel> coloured(std::uint8_t opacity)
{
    Grid<Pixel> picture(3, 5);
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 5; ++column)
            picture(row, column) = {static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(column), 7,
                                    255};
    picture(1, 2)[3] = opacity;
    return picture;
}

Grid<Pixel> read(const std::string& path, int bands)
{
    Grid<Pixel> picture(3, 5, Pixel{0, 0, 0, 255});
    auto* dataset = GDALDataset::Open(path.c_str());
    EXPECT_EQ(dataset->GetRasterCount(), bands);
    EXPECT_EQ(dataset->RasterIO(GF_Read, 0, 0, 5, 3, picture.data(), 5, 3, GDT_Byte, bands, nullptr, 4, 20, 1,
                                nullptr),
              CE_None);
    GDALClose(dataset);
    return picture;
}

using WritePicture = raster_test::FolderTest;

TEST_F(WritePicture, KeepsEveryPixelAndLeavesOutOpacityThatSaysNothing)
{
    for (const int opacity : {255, 30}) {
        const Grid<Pixel> picture = coloured(static_cast<std::uint8_t>(opacity));
        write_picture(path("picture.png"), picture.view(), true);
        const Grid<Pixel> again = read(path("picture.png"), opacity == 255 ? 3 : 4);
        EXPECT_TRUE(std::ranges::equal(picture.values(), again.values()));
    }
}

TEST_F(WritePicture, KeepsGreyOnesGrey)
{
    Grid<std::uint8_t> grey(3, 5);
    for (std::size_t i = 0; i < grey.size(); ++i)
        grey.values()[i] = static_cast<std::uint8_t>(17 * i);
    write_picture(path("grey.png"), grey.view());
    const Grid<Pixel> again = read(path("grey.png"), 1);
    for (std::size_t i = 0; i < grey.size(); ++i)
        EXPECT_EQ(again.values()[i][0], grey.values()[i]);
}

TEST_F(WritePicture, ReplacesNothingUnasked)
{
    write_picture(path("picture.png"), coloured(255).view());
    EXPECT_THROW(write_picture(path("picture.png"), coloured(255).view()), OutputError);
}

TEST_F(WritePicture, WantsAnExtensionThatSaysAFormatOfColours)
{
    EXPECT_THROW(write_picture(path("picture.nothing"), coloured(255).view()), InvalidInput);
    EXPECT_THROW(write_picture(path("no/such/folder/picture.png"), coloured(255).view()), OutputError);
    EXPECT_TRUE(files().empty());
}

} // namespace
} // namespace duskline
