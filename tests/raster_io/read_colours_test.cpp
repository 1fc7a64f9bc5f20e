#include "made_raster.h"

#include <duskline/raster_io/read_colours.h>

#include <gmock/gmock.h>

#include <fstream>

namespace duskline {
namespace {

using namespace raster_test;
using ::testing::HasSubstr;

using Rgba = std::array<std::uint8_t, 4>;

// Bands of 8 bits whose numbers say where they are: 100 band + 10 row + column, less what does not fit.
MadeRaster picture(std::vector<std::string> colours)
{
    MadeRaster raster;
    raster.type = "Byte";
    raster.colours = std::move(colours);
    raster.value = [](std::size_t band, std::size_t row, std::size_t column) {
        return static_cast<double>((60 * band + 10 * row + column) % 256);
    };
    return raster;
}

class ReadColours : public FolderTest {
protected:
    Grid<Rgba> read(const MadeRaster& colours, const MadeRaster& heights = {}) const
    {
        const HeightFile like(made(heights));
        return read_colours(made(colours, "colours.tif"), like);
    }

    std::string refusal(const MadeRaster& colours, const MadeRaster& heights = {}) const
    {
        try {
            read(colours, heights);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(ReadColours, ThatLieOnTheSameCellsComeByteForByte)
{
    const Grid<Rgba> grid = read(picture({"red", "green", "blue"}));
    EXPECT_EQ(grid.rows(), 4U);
    EXPECT_EQ(grid.columns(), 6U);
    EXPECT_EQ(grid(0, 0), (Rgba{60, 120, 180, 255}));
    EXPECT_EQ(grid(3, 5), (Rgba{95, 155, 215, 255}));
}

TEST_F(ReadColours, AlphaComesAlong)
{
    EXPECT_EQ(read(picture({"red", "green", "blue", "alpha"}))(1, 2), (Rgba{72, 132, 192, 252}));
}

TEST_F(ReadColours, GreyIsAllThreeColours)
{
    EXPECT_EQ(read(picture({"grey"}))(1, 2), (Rgba{72, 72, 72, 255}));
    EXPECT_EQ(read(picture({"grey", "alpha"}))(1, 2), (Rgba{72, 72, 72, 132}));
}

TEST_F(ReadColours, ASouthUpPictureLiesOverNorthUpHeights)
{
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.geotransform = std::array{500000.0, 10.0, 0.0, 3999960.0, 0.0, 10.0};
    const Grid<Rgba> grid = read(colours);
    EXPECT_EQ(grid(0, 0), (Rgba{90, 150, 210, 255})); // the file's last row
    EXPECT_EQ(grid(3, 5), (Rgba{65, 125, 185, 255}));
}

TEST_F(ReadColours, SouthUpHeightsGetNorthUpColours)
{
    MadeRaster heights;
    heights.geotransform = std::array{500000.0, 10.0, 0.0, 3999960.0, 0.0, 10.0};
    const Grid<Rgba> grid = read(picture({"red", "green", "blue"}), heights);
    EXPECT_EQ(grid(0, 0), (Rgba{60, 120, 180, 255}));
    EXPECT_EQ(grid(3, 5), (Rgba{95, 155, 215, 255}));
}

TEST_F(ReadColours, OfAPictureThatCoversAPartAreTransparentElsewhere)
{
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.geotransform = std::array{500030.0, 10.0, 0.0, 4000000.0, 0.0, -10.0}; // three cells further east
    const Grid<Rgba> grid = read(colours);
    EXPECT_EQ(grid(2, 1)[3], 0);
    EXPECT_EQ(grid(2, 4), (Rgba{81, 141, 201, 255}));
}

TEST_F(ReadColours, FromFinerCellsAreAveraged)
{
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.rows = 40;
    colours.columns = 60;
    colours.geotransform = std::array{500000.0, 1.0, 0.0, 4000000.0, 0.0, -1.0};
    colours.value = [](std::size_t, std::size_t row, std::size_t column) {
        return (row + column) % 2 == 0 ? 200.0 : 100.0;
    };
    EXPECT_NEAR(read(colours)(2, 3)[1], 150, 2);
}

TEST_F(ReadColours, InAnotherCoordinateSystemAreWarped)
{
    MadeRaster heights;
    heights.rows = 40;
    heights.columns = 40;
    heights.geotransform = std::array{500000.0, 1000.0, 0.0, 4020000.0, 0.0, -1000.0};
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.rows = 200;
    colours.columns = 200;
    colours.crs = "EPSG:4326";
    colours.geotransform = std::array{14.9, 0.005, 0.0, 36.6, 0.0, -0.005};
    colours.value = [](std::size_t band, std::size_t row, std::size_t column) {
        return static_cast<double>(band == 1 ? column : band == 2 ? row : 7);
    };
    const Grid<Rgba> grid = read(colours, heights);
    // The centre of cell (9, 10) is 15.11686 E 36.23933 N by PROJ: 42.9 columns and 71.6 rows from the centre
    // of the first pixel.
    EXPECT_NEAR(grid(9, 10)[0], 43, 1);
    EXPECT_NEAR(grid(9, 10)[1], 72, 1);
    EXPECT_EQ(grid(9, 10)[2], 7);
    EXPECT_EQ(grid(9, 10)[3], 255);
}

TEST_F(ReadColours, WithoutAPlaceMustHaveTheHeightsSize)
{
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.geotransform = std::nullopt;
    colours.crs = "";
    EXPECT_EQ(read(colours)(3, 5), (Rgba{95, 155, 215, 255}));
    colours.columns = 7;
    EXPECT_THAT(refusal(colours), HasSubstr("has no georeference, and 4 rows x 7 columns"));
}

TEST_F(ReadColours, MustHave8Bits)
{
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.type = "UInt16";
    EXPECT_THAT(refusal(colours), HasSubstr("holds UInt16, not colours of 8 bits"));
}

TEST_F(ReadColours, ThatAreNotThereAreMissed)
{
    const HeightFile like(made({}));
    EXPECT_THROW(read_colours(path("nothing.tif"), like), InputError);
    std::ofstream(path("words.txt")) << "no colours here\n";
    EXPECT_THROW(read_colours(path("words.txt"), like), InputError);
}

TEST_F(ReadColours, ComeOnFinerCellsOverTheSameGround)
{
    // Blocks of 2 x 2 cells of the finer grid lie in one of the heights; the colours have the finer cells.
    MadeRaster colours = picture({"red", "green", "blue"});
    colours.rows = 8;
    colours.columns = 12;
    colours.geotransform = std::array{500000.0, 5.0, 0.0, 4000000.0, 0.0, -5.0};
    const HeightFile like(made({}));
    const Grid<Rgba> placed = read_colours(made(colours, "colours.tif"), like, 8, 12);
    colours.geotransform = {};
    colours.crs = "";
    const Grid<Rgba> unplaced = read_colours(made(colours, "unplaced.tif"), like, 8, 12);
    ASSERT_EQ(placed.rows(), 8U);
    ASSERT_EQ(placed.columns(), 12U);
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 12; ++x) {
            const auto red = static_cast<std::uint8_t>(60 + 10 * y + x);
            ASSERT_EQ(placed(y, x)[0], red);
            ASSERT_EQ(unplaced(y, x)[0], red);
        }
}

TEST_F(ReadColours, OfTheHeightsSizeAreResampledToFinerCells)
{
    for (const bool placed : {true, false}) {
        MadeRaster colours = picture({"red", "green", "blue"});
        colours.value = [](std::size_t, std::size_t, std::size_t column) {
            return 20.0 * static_cast<double>(column);
        };
        if (!placed) {
            colours.geotransform = {};
            colours.crs = "";
        }
        const HeightFile like(made({}));
        const Grid<Rgba> grid = read_colours(made(colours, "colours.tif"), like, 8, 12);
        for (std::size_t x = 2; x < 10; ++x)
            EXPECT_NEAR(grid(4, x)[0], 20.0 * ((static_cast<double>(x) + 0.5) / 2.0 - 0.5), 1.0)
                << placed << x;
        EXPECT_EQ(grid(4, 6)[3], 255);
    }
}

} // namespace
} // namespace duskline
