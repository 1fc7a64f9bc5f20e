#include "made_raster.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/raster_writer.h>

#include <gdal_priv.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numeric>

namespace duskline {
namespace {

using namespace raster_test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Closer {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Closer>;

Dataset opened(const std::string& path)
{
    return Dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
}

std::vector<float> values_of(const std::string& path, int band = 1)
{
    const Dataset dataset = opened(path);
    if (!dataset)
        return {};
    const int columns = dataset->GetRasterXSize();
    const int rows = dataset->GetRasterYSize();
    std::vector<float> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    EXPECT_EQ(dataset->GetRasterBand(band)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns,
                                                     rows, GDT_Float32, 0, 0, nullptr),
              CE_None);
    return values;
}

template <typename Error, typename Work>
std::string refusal(const Work& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

const RasterContent kMask = {.samples = Samples::byte,
                             .no_data = 255.0,
                             .classes = true,
                             .description = "sunlit",
                             .tags = {{"LIGHT_AZIMUTH", "200"}, {"SOFTWARE", "duskline"}}};

class WriteRasters : public FolderTest {
protected:
    /// A raster of counted bytes over a 5 x 7 input, written to `name` in one go.
    void write_counted(const std::string& name, const WriteOptions& options = {}) const
    {
        const HeightFile like(made({.rows = 5, .columns = 7}));
        RasterWriter writer(path(name), like, kMask, options);
        writer.write(0, 0, counted().view());
        writer.finish();
    }

    static Grid<std::uint8_t> counted()
    {
        Grid<std::uint8_t> grid(5, 7);
        std::iota(grid.values().begin(), grid.values().end(), std::uint8_t{0});
        return grid;
    }

    std::vector<std::string> files_but_input() const
    {
        std::vector<std::string> names = files();
        std::erase_if(names, [](const std::string& name) { return name.starts_with("heights.tif"); });
        return names;
    }
};

TEST_F(WriteRasters, AreReadBackAsWritten)
{
    write_counted("mask.tif");
    const std::vector<float> values = values_of(path("mask.tif"));
    ASSERT_EQ(values.size(), 35U);
    for (std::size_t i = 0; i < 35; ++i)
        EXPECT_EQ(values[i], static_cast<float>(i));
    EXPECT_THAT(files_but_input(), ElementsAre("mask.tif"));
}

TEST_F(WriteRasters, LieOnTheGridOfTheInputAndSayWhatTheyAre)
{
    write_counted("mask.tif");
    const Dataset input = opened(path("heights.tif"));
    const Dataset mask = opened(path("mask.tif"));
    std::array<double, 6> expected{};
    std::array<double, 6> actual{};
    ASSERT_EQ(input->GetGeoTransform(expected.data()), CE_None);
    ASSERT_EQ(mask->GetGeoTransform(actual.data()), CE_None);
    EXPECT_EQ(actual, expected);
    EXPECT_TRUE(mask->GetSpatialRef()->IsSame(input->GetSpatialRef()));
    EXPECT_STREQ(mask->GetMetadataItem("LIGHT_AZIMUTH"), "200");
    EXPECT_STREQ(mask->GetRasterBand(1)->GetDescription(), "sunlit");
    EXPECT_EQ(mask->GetRasterBand(1)->GetNoDataValue(), 255.0);
    EXPECT_STREQ(mask->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), "DEFLATE");
    int width = 0;
    int height = 0;
    mask->GetRasterBand(1)->GetBlockSize(&width, &height);
    EXPECT_EQ(width, 256);
    EXPECT_EQ(height, 256);
}

TEST_F(WriteRasters, WithRowsAndColumnsOfTheirOwnCoverTheSameGround)
{
    const HeightFile like(made({.rows = 60, .columns = 40}));
    RasterContent content = kMask;
    content.rows = 30;
    content.columns = 10;
    RasterWriter writer(path("small.tif"), like, content);
    const Grid<std::uint8_t> values(30, 10, 7);
    writer.write(0, 0, values.view());
    writer.finish();
    const Dataset small = opened(path("small.tif"));
    ASSERT_TRUE(small);
    EXPECT_EQ(small->GetRasterXSize(), 10);
    EXPECT_EQ(small->GetRasterYSize(), 30);
    std::array<double, 6> gt{};
    ASSERT_EQ(small->GetGeoTransform(gt.data()), CE_None);
    EXPECT_THAT(gt, ElementsAre(500000.0, 40.0, 0.0, 4000000.0, 0.0, -20.0));
}

TEST_F(WriteRasters, PointRastersStayPointRasters)
{
    {
        const Dataset input(GDALDataset::Open(made({}).c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
        input->SetMetadataItem("AREA_OR_POINT", "Point");
    }
    const HeightFile like(path("heights.tif"));
    RasterWriter writer(path("mask.tif"), like, kMask);
    writer.write(0, 0, Grid<std::uint8_t>(4, 6, 1).view());
    writer.finish();
    const Dataset mask = opened(path("mask.tif"));
    EXPECT_STREQ(mask->GetMetadataItem("AREA_OR_POINT"), "Point");
    std::array<double, 6> gt{};
    mask->GetGeoTransform(gt.data());
    EXPECT_EQ(gt[0], like.facts().geotransform->at(0));
}

TEST_F(WriteRasters, BlocksMayComeInAnyOrder)
{
    const HeightFile like(made({.rows = 130, .columns = 150}));
    for (const bool flipped : {false, true}) {
        const std::string name = path(flipped ? "backwards.tif" : "forwards.tif");
        RasterWriter writer(name, like, kMask,
                            {.creation_options = {"BLOCKXSIZE=64", "BLOCKYSIZE=32", "TILED=YES"}});
        EXPECT_EQ(writer.block_rows(), 32U);
        EXPECT_EQ(writer.block_columns(), 64U);
        std::vector<std::pair<std::size_t, std::size_t>> blocks;
        for (std::size_t y = 0; y < 130; y += 32)
            for (std::size_t x = 0; x < 150; x += 64)
                blocks.emplace_back(y, x);
        if (flipped)
            std::reverse(blocks.begin(), blocks.end());
        for (const auto& [y, x] : blocks) {
            Grid<std::uint8_t> block(std::min<std::size_t>(32, 130 - y), std::min<std::size_t>(64, 150 - x));
            for (std::size_t r = 0; r < block.rows(); ++r)
                for (std::size_t c = 0; c < block.columns(); ++c)
                    block(r, c) = static_cast<std::uint8_t>((y + r) * 3 + (x + c) * 7);
            writer.write(y, x, block.view());
        }
        writer.finish();
        const auto values = values_of(name);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(values[i], static_cast<float>(static_cast<std::uint8_t>(i / 150 * 3 + i % 150 * 7)))
                << i;
    }
}

TEST_F(WriteRasters, AreTurnedBackToTheOrderOfTheFile)
{
    for (const auto& gt :
         {std::array{0.0, 9.0, 0.0, 50.0, 0.0, 9.0}, std::array{0.0, -9.0, 0.0, 50.0, 0.0, -9.0},
          std::array{0.0, -9.0, 0.0, 50.0, 0.0, 9.0}}) {
        MadeRaster raster{.rows = 5, .columns = 7, .geotransform = gt};
        raster.value = [](std::size_t, std::size_t row, std::size_t column) {
            return static_cast<double>(row * 7 + column);
        };
        HeightFile file(made(raster));
        const Terrain terrain = read_terrain(file);
        RasterWriter writer(path("copy.tif"), file, {.samples = Samples::real}, {.overwrite = true});
        for (std::size_t first : {std::size_t{0}, std::size_t{2}}) {
            const std::size_t rows = first == 0 ? 2 : 3;
            writer.write(first, 0, HeightField(terrain).heights_m.window(first, 0, rows, 4));
            writer.write(first, 4, HeightField(terrain).heights_m.window(first, 4, rows, 3));
        }
        writer.finish();
        EXPECT_EQ(values_of(path("copy.tif")), values_of(path("heights.tif"))) << gt[1] << ' ' << gt[5];
    }
}

TEST_F(WriteRasters, ColoursGoToBandsOfTheirOwn)
{
    const HeightFile like(made({.rows = 2, .columns = 2}));
    const Grid<std::array<std::uint8_t, 3>> rgb(2, 2, {10, 20, 30});
    for (const char* name : {"relief.tif", "relief.png", "relief.jpg"}) {
        RasterWriter writer(path(name), like, {.samples = Samples::rgb});
        writer.write(0, 0, rgb.view());
        writer.finish();
        EXPECT_NEAR(values_of(path(name), 2)[3], 20.0F, 3.0F) << name;
        EXPECT_EQ(opened(path(name))->GetRasterBand(3)->GetColorInterpretation(), GCI_BlueBand) << name;
    }
    const Grid<std::array<std::uint8_t, 4>> rgba(2, 2, {10, 20, 30, 40});
    for (const char* name : {"a.tif", "a.png"}) {
        RasterWriter writer(path(name), like, {.samples = Samples::rgba});
        writer.write(0, 0, rgba.view());
        writer.finish();
        EXPECT_EQ(values_of(path(name), 4)[0], 40.0F) << name;
        EXPECT_EQ(opened(path(name))->GetRasterBand(4)->GetColorInterpretation(), GCI_AlphaBand) << name;
    }
}

TEST_F(WriteRasters, BandsOfAnyNumberAreWrittenOneByOneEachWithItsWords)
{
    const HeightFile like(made({.rows = 5, .columns = 7}));
    const RasterContent content = {
        .samples = Samples::byte,
        .no_data = 255.0,
        .tags = {{"SOFTWARE", "duskline"}},
        .bands = {{"morning", "", {{"TIME", "08:00"}}}, {"noon", "", {}}, {"evening", "h", {}}}};
    RasterWriter writer(path("day.tif"), like, content);
    for (const std::size_t band : {2U, 0U, 1U}) {
        Grid<std::uint8_t> values = counted();
        for (std::uint8_t& value : values.values())
            value = static_cast<std::uint8_t>(value + 50 * band);
        writer.write_band(band, 0, 0, GridView<const std::uint8_t>(values.view()));
    }
    writer.finish();
    const Dataset dataset = opened(path("day.tif"));
    ASSERT_EQ(dataset->GetRasterCount(), 3);
    for (const int band : {1, 2, 3}) {
        EXPECT_EQ(values_of(path("day.tif"), band)[8], static_cast<float>(8 + 50 * (band - 1)));
        EXPECT_EQ(dataset->GetRasterBand(band)->GetNoDataValue(), 255.0);
    }
    EXPECT_STREQ(dataset->GetRasterBand(3)->GetDescription(), "evening");
    EXPECT_STREQ(dataset->GetRasterBand(3)->GetUnitType(), "h");
    EXPECT_STREQ(dataset->GetRasterBand(1)->GetMetadataItem("TIME"), "08:00");
    EXPECT_STREQ(dataset->GetMetadataItem("INTERLEAVE", "IMAGE_STRUCTURE"), "BAND");
}

TEST_F(WriteRasters, BandsOfRealsAreTurnedBackToTheOrderOfTheFile)
{
    const HeightFile like(
        made({.rows = 2, .columns = 3, .geotransform = {{0.0, 10.0, 0.0, 0.0, 0.0, 10.0}}}));
    RasterWriter writer(path("two.tif"), like, {.samples = Samples::real, .bands = {{"a"}, {"b"}}});
    Grid<float> values(2, 3);
    std::iota(values.values().begin(), values.values().end(), 0.5F);
    writer.write_band(0, 0, 0, GridView<const float>(values.view()));
    writer.write_band(1, 0, 0, GridView<const float>(values.view()));
    writer.finish();
    EXPECT_THAT(values_of(path("two.tif"), 2), ElementsAre(3.5F, 4.5F, 5.5F, 0.5F, 1.5F, 2.5F));
}

struct Format {
    const char* name;
    const char* format; // --of; empty: by extension
    const char* expected;
};

TEST_F(WriteRasters, GoToTheFormatOfTheExtensionOrTheOneAskedFor)
{
    for (const Format& format :
         {Format{"a.tif", "", "GTiff"}, Format{"a.TIFF", "", "GTiff"}, Format{"a.png", "", "PNG"},
          Format{"a.img", "", "HFA"}, Format{"b.asc", "", "AAIGrid"}, Format{"a.nc", "", "netCDF"},
          Format{"cog.tif", "COG", "GTiff"}, Format{"a.bil", "EHdr", "EHdr"},
          Format{"noextension", "gtiff", "GTiff"}}) {
        write_counted(format.name, {.format = format.format});
        const Dataset written = opened(path(format.name));
        ASSERT_TRUE(written) << format.name;
        EXPECT_STREQ(written->GetDriver()->GetDescription(), format.expected);
        EXPECT_EQ(values_of(path(format.name))[34], 34.0F) << format.name;
    }
    for (const std::string& name : files())
        EXPECT_FALSE(name.starts_with(".duskline")) << name;
    EXPECT_STREQ(opened(path("cog.tif"))->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
    EXPECT_TRUE(std::filesystem::exists(path("a.hdr"))) << "the header moves along with its raster";
}

TEST_F(WriteRasters, FormatsThatAreNoneAreRefused)
{
    const HeightFile like(made({}));
    const auto why_not = [&](const std::string& name, const WriteOptions& options,
                             const RasterContent& content) {
        return refusal<InvalidInput>([&] { RasterWriter(path(name), like, content, options); });
    };
    EXPECT_THAT(why_not("mask.xyzzy", {}, kMask), HasSubstr("--of"));
    EXPECT_THAT(why_not("mask", {}, kMask), HasSubstr("--of"));
    EXPECT_THAT(why_not("mask.tif", {.format = "GTif"}, kMask), HasSubstr("'GTif'"));
    EXPECT_THAT(why_not("mask.tif", {.format = "SRTMHGT"}, {.samples = Samples::rgb}), HasSubstr("SRTMHGT"));
    EXPECT_THAT(why_not("heights.png", {}, {.samples = Samples::real}), HasSubstr("PNG cannot hold heights"));
    EXPECT_THAT(why_not("mask.tif", {.creation_options = {"COMPRESS"}}, kMask), HasSubstr("KEY=VALUE"));
    EXPECT_THAT(why_not("mask.tif", {.creation_options = {"COMPRES=LZW"}}, kMask), HasSubstr("COMPRES"));
    EXPECT_THAT(why_not("mask.png", {.creation_options = {"ZLEVEL=99"}}, kMask), HasSubstr("ZLEVEL"));
    EXPECT_THAT(files(), ElementsAre("heights.tif"));
}

TEST_F(WriteRasters, CreationOptionsReplaceOursOneByOne)
{
    write_counted("a.tif", {.creation_options = {"compress=LZW"}});
    EXPECT_STREQ(opened(path("a.tif"))->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), "LZW");
    write_counted("b.tif", {.creation_options = {"COMPRESS=NONE", "TILED=NO"}});
    EXPECT_EQ(opened(path("b.tif"))->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), nullptr);
}

TEST_F(WriteRasters, ExistingFilesStayUnlessOverwritten)
{
    std::ofstream(path("mask.tif")) << "precious";
    EXPECT_THAT(refusal<OutputError>([&] { write_counted("mask.tif"); }), HasSubstr("--overwrite"));
    EXPECT_EQ(std::filesystem::file_size(path("mask.tif")), 8U);
    std::ofstream(path("mask.tif.aux.xml")) << "old statistics";
    write_counted("mask.tif", {.overwrite = true});
    EXPECT_EQ(values_of(path("mask.tif"))[34], 34.0F);
    EXPECT_THAT(files_but_input(), ElementsAre("mask.tif"));
}

TEST_F(WriteRasters, TheOldFileStaysUntilTheNewOneIsWhole)
{
    std::ofstream(path("mask.tif")) << "precious";
    const HeightFile like(made({.rows = 5, .columns = 7}));
    {
        RasterWriter writer(path("mask.tif"), like, kMask, {.overwrite = true});
        writer.write(0, 0, counted().view());
        EXPECT_EQ(std::filesystem::file_size(path("mask.tif")), 8U);
    }
    EXPECT_EQ(std::filesystem::file_size(path("mask.tif")), 8U);
    EXPECT_THAT(files_but_input(), ElementsAre("mask.tif")) << "an unfinished raster leaves nothing";
}

TEST_F(WriteRasters, LinksAreFollowed)
{
    std::filesystem::create_directory(path("results"));
    std::ofstream(path("results/real.tif")) << "old";
    std::filesystem::create_symlink("results/real.tif", path("link.tif"));
    write_counted("link.tif", {.overwrite = true});
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.tif")));
    EXPECT_EQ(values_of(path("results/real.tif"))[34], 34.0F);
}

TEST_F(WriteRasters, NeverReplaceTheirInput)
{
    const std::string input = made({}, "a.tif");
    std::filesystem::create_hard_link(input, path("hard.tif"));
    std::filesystem::create_symlink("a.tif", path("soft.tif"));
    const HeightFile like(input);
    for (const char* name : {"a.tif", "hard.tif", "soft.tif", "./a.tif"})
        EXPECT_THAT(refusal<OutputError>([&] { RasterWriter(path(name), like, kMask, {.overwrite = true}); }),
                    HasSubstr("it is the input"))
            << name;
    std::ofstream(path("mosaic.vrt"))
        << "<VRTDataset rasterXSize=\"6\" rasterYSize=\"4\"><VRTRasterBand "
           "dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename "
           "relativeToVRT=\"1\">a.tif</SourceFilename><SourceBand>1</SourceBand>"
           "</SimpleSource></VRTRasterBand></VRTDataset>";
    const HeightFile mosaic(path("mosaic.vrt"));
    EXPECT_THAT(
        refusal<OutputError>([&] { RasterWriter(path("a.tif"), mosaic, kMask, {.overwrite = true}); }),
        HasSubstr("it is the input"));
}

TEST_F(WriteRasters, CompanionsOfARasterReplaceNoneOfTheInput)
{
    const HeightFile like(made({.rows = 5, .columns = 7, .format = "EHdr"}, "dem.flt"));
    const auto before = std::filesystem::file_size(path("dem.hdr"));
    const auto why_not = [&](const WriteOptions& options) {
        return refusal<OutputError>([&] { RasterWriter(path("dem.bil"), like, kMask, options); });
    };
    EXPECT_THAT(why_not({}), HasSubstr("dem.hdr"));
    EXPECT_THAT(why_not({.overwrite = true}), AllOf(HasSubstr("dem.hdr"), HasSubstr("input")));
    EXPECT_EQ(std::filesystem::file_size(path("dem.hdr")), before);
    EXPECT_FALSE(std::filesystem::exists(path("dem.bil")));
}

TEST_F(WriteRasters, SayWhyAPlaceCannotBeWritten)
{
    const HeightFile like(made({}));
    const auto why_not = [&](const std::string& target) {
        return refusal<OutputError>([&] { RasterWriter(target, like, kMask, {.overwrite = true}); });
    };
    EXPECT_THAT(why_not(path("nowhere/mask.tif")), AllOf(HasSubstr("no folder"), HasSubstr("nowhere")));
    EXPECT_THAT(why_not(path("heights.tif/mask.tif")), HasSubstr("is no folder"));
    EXPECT_THAT(why_not(path("")), HasSubstr("name of a file"));
    EXPECT_THAT(why_not(path(".")), HasSubstr("it is a folder"));
    EXPECT_THAT(why_not("/dev/full"), HasSubstr("no ordinary file"));
    EXPECT_THAT(why_not("/proc/mask.tif"), HasSubstr("/proc"));
    EXPECT_THAT(files(), ElementsAre("heights.tif"));
}

TEST_F(WriteRasters, GoToVirtualFilesToo)
{
    const HeightFile like(made({.rows = 5, .columns = 7}));
    RasterWriter writer("/vsimem/mask.tif", like, kMask);
    writer.write(0, 0, counted().view());
    writer.finish();
    EXPECT_EQ(values_of("/vsimem/mask.tif")[34], 34.0F);
    EXPECT_THAT(refusal<OutputError>([&] { RasterWriter("/vsimem/mask.tif", like, kMask); }),
                HasSubstr("--overwrite"));
    VSIUnlink("/vsimem/mask.tif");
    {
        RasterWriter unfinished("/vsimem/mask.tif", like, kMask);
        unfinished.write(0, 0, counted().view());
    }
    VSIStatBufL status = {};
    EXPECT_NE(VSIStatL("/vsimem/mask.tif", &status), 0);
}

TEST_F(WriteRasters, StopWhenAskedToWhileCopying)
{
    std::ofstream(path("mask.png")) << "precious";
    const HeightFile like(made({.rows = 5, .columns = 7}));
    {
        RasterWriter writer(path("mask.png"), like, kMask, {.overwrite = true});
        writer.write(0, 0, counted().view());
        EXPECT_THROW(writer.finish([](double) { return false; }), Cancelled);
    }
    EXPECT_EQ(std::filesystem::file_size(path("mask.png")), 8U);
    EXPECT_THAT(files_but_input(), ElementsAre("mask.png"));
}

TEST_F(WriteRasters, KeepTheirPlaceWhenTheyReplaceAPicture)
{
    for (int time = 0; time < 2; ++time) {
        write_counted("mask.png", {.overwrite = true});
        EXPECT_THAT(files_but_input(), ElementsAre("mask.png", "mask.png.aux.xml"));
        std::array<double, 6> gt{};
        EXPECT_EQ(opened(path("mask.png"))->GetGeoTransform(gt.data()), CE_None);
    }
}

TEST_F(WriteRasters, PicturesOfSouthUpAndMirroredRastersAreTheRightWayUp)
{
    for (const auto& [x_step, y_step] :
         {std::pair{10.0, -10.0}, std::pair{10.0, 10.0}, std::pair{-10.0, -10.0}, std::pair{-10.0, 10.0}}) {
        MadeRaster raster{.rows = 5, .columns = 7};
        raster.geotransform = std::array{500000.0, x_step, 0.0, 4000000.0, 0.0, y_step};
        const HeightFile like(made(raster));
        RasterWriter writer(path("picture.png"), like, {.samples = Samples::byte}, {.overwrite = true});
        writer.write(0, 0, counted().view()); // north on top, as everything in the library
        writer.finish();
        const std::vector<float> values = values_of(path("picture.png"));
        for (std::size_t i = 0; i < 35; ++i)
            ASSERT_EQ(values[i], static_cast<float>(i));
        const double west = x_step > 0.0 ? 500000.0 : 500000.0 - 70.0;
        const double north = y_step < 0.0 ? 4000000.0 : 4000000.0 + 50.0;
        std::array<double, 6> gt{};
        ASSERT_EQ(opened(path("picture.png"))->GetGeoTransform(gt.data()), CE_None);
        EXPECT_THAT(gt, ElementsAre(west, 10.0, 0.0, north, 0.0, -10.0));
    }
}

template <typename Pixel>
void write_pixels(RasterWriter& writer, Pixel pixel)
{
    const Grid<Pixel> pixels(4, 6, pixel);
    writer.write(0, 0, pixels.view());
    writer.finish();
}

TEST_F(WriteRasters, HoldGreyAndColoursOfEveryDepthWithAndWithoutOpacity)
{
    const HeightFile like(made({}));
    const auto written = [&](Samples samples, auto pixel, const std::string& name) {
        RasterWriter writer(path(name), like, {.samples = samples}, {.overwrite = true});
        write_pixels(writer, pixel);
        Dataset dataset = opened(path(name));
        for (int band = 1; band <= dataset->GetRasterCount(); ++band) {
            const bool opacity = band == dataset->GetRasterCount() && band % 2 == 0;
            EXPECT_EQ(dataset->GetRasterBand(band)->GetColorInterpretation() == GCI_AlphaBand, opacity)
                << name;
            EXPECT_EQ(values_of(path(name), band).at(23), static_cast<float>(10 * band))
                << name << ' ' << band;
        }
        return std::pair(dataset->GetRasterCount(), dataset->GetRasterBand(1)->GetRasterDataType());
    };
    using Byte = std::uint8_t;
    using Word = std::uint16_t;
    for (const std::string name : {"samples.tif", "samples.png"}) {
        EXPECT_EQ(written(Samples::byte_alpha, std::array<Byte, 2>{10, 20}, name), std::pair(2, GDT_Byte));
        EXPECT_EQ(written(Samples::word, Word{10}, name), std::pair(1, GDT_UInt16));
        EXPECT_EQ(written(Samples::word_alpha, std::array<Word, 2>{10, 20}, name), std::pair(2, GDT_UInt16));
        EXPECT_EQ(written(Samples::rgb_words, std::array<Word, 3>{10, 20, 30}, name),
                  std::pair(3, GDT_UInt16));
        EXPECT_EQ(written(Samples::rgba_words, std::array<Word, 4>{10, 20, 30, 40}, name),
                  std::pair(4, GDT_UInt16));
    }
    EXPECT_EQ(written(Samples::rgb_reals, std::array<float, 3>{10, 20, 30}, "samples.tif"),
              std::pair(3, GDT_Float32));
    EXPECT_THAT(refusal<InvalidInput>([&] {
                    const RasterWriter writer(path("samples.jpg"), like, {.samples = Samples::word});
                }),
                HasSubstr("JPEG cannot hold samples of type UInt16"));
}

TEST_F(WriteRasters, DeclareNoDataInEveryBand)
{
    const HeightFile like(made({}));
    RasterWriter writer(path("reals.tif"), like, {.samples = Samples::rgb_reals, .no_data = -9999.0});
    write_pixels(writer, std::array<float, 3>{1, 2, 3});
    for (int band = 1; band <= 3; ++band)
        EXPECT_EQ(opened(path("reals.tif"))->GetRasterBand(band)->GetNoDataValue(), -9999.0);
}

} // namespace
} // namespace duskline
