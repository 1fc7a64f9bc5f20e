#include "made_raster.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/read_height_field.h>

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

namespace duskline {
namespace {

using namespace raster_test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<float> heights_of(HeightFile& file)
{
    const Terrain terrain = read_terrain(file);
    return {terrain.heights_m.values().begin(), terrain.heights_m.values().end()};
}

std::vector<float> heights_of(const std::string& path, const ReadOptions& options = {})
{
    HeightFile file(path, options);
    return heights_of(file);
}

/// What a function throws, as text; empty when it throws nothing of that kind.
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

std::string why_not(const std::string& path, const ReadOptions& options = {})
{
    return refusal<InputError>([&] { HeightFile(path, options); });
}

class ReadHeights : public FolderTest {};
class ReadSharedHeights : public ::testing::Test {};

TEST_F(ReadHeights, ComeInMetresRowByRow)
{
    HeightFile file(made({.rows = 2, .columns = 3}));
    EXPECT_THAT(heights_of(file), ElementsAre(0.0F, 1.0F, 2.0F, 100.0F, 101.0F, 102.0F));
    EXPECT_EQ(file.rows(), 2U);
    EXPECT_EQ(file.columns(), 3U);
    EXPECT_EQ(file.ground().cell_size_m.x, 10.0);
    EXPECT_EQ(file.ground().cell_size_m.y, 10.0);
    EXPECT_EQ(file.ground().grid_north.degrees(), 0.0);
    EXPECT_EQ(file.ground().body->name, "Earth");
    EXPECT_THAT(file.facts().warnings, IsEmpty());
}

TEST_F(ReadHeights, ComeFromEveryIntegerAndFloatType)
{
    for (const char* type :
         {"Byte", "Int16", "UInt16", "Int32", "UInt32", "Float32", "Float64", "Int64", "UInt64"}) {
        MadeRaster raster{.rows = 1, .columns = 3, .type = type};
        raster.value = [](std::size_t, std::size_t, std::size_t x) { return 7.0 + static_cast<double>(x); };
        EXPECT_THAT(heights_of(made(raster)), ElementsAre(7.0F, 8.0F, 9.0F)) << type;
    }
}

TEST_F(ReadHeights, AnyWindowHasTheHeightsOfTheWhole)
{
    MadeRaster raster{.rows = 70, .columns = 90, .type = "Int16"};
    raster.creation_options = {"TILED=YES", "BLOCKXSIZE=32", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"};
    HeightFile file(made(raster));
    Grid<float> window(41, 37);
    file.read(5, 20, window.view());
    for (std::size_t y = 0; y < 41; ++y)
        for (std::size_t x = 0; x < 37; ++x)
            ASSERT_EQ(window(y, x), static_cast<float>(100 * (y + 5) + x + 20)) << y << ' ' << x;
    EXPECT_EQ(file.facts().block_rows, 16U);
    EXPECT_EQ(file.facts().block_columns, 32U);
    EXPECT_EQ(file.facts().compression, "DEFLATE");
}

TEST_F(ReadHeights, WindowsOfALargerGridLeaveItsOtherCellsAlone)
{
    HeightFile file(made({.rows = 2, .columns = 2}));
    Grid<float> grid(4, 5, -1.0F);
    file.read(0, 0, grid.view().window(1, 2, 2, 2));
    EXPECT_EQ(grid(1, 1), -1.0F);
    EXPECT_EQ(grid(1, 2), 0.0F);
    EXPECT_EQ(grid(2, 3), 101.0F);
    EXPECT_EQ(grid(2, 4), -1.0F);
    EXPECT_EQ(grid(3, 2), -1.0F);
}

// No data

struct Void {
    const char* type;
    std::optional<double> declared;
    double stored;
    bool is_void;
};

void PrintTo(const Void& v, std::ostream* out)
{
    *out << v.type << ' ' << v.stored << " declared " << v.declared.value_or(kNaN);
}

class ReadVoids : public FolderTest, public ::testing::WithParamInterface<Void> {
protected:
    std::string path(const std::string& name) const { return FolderTest::path(name); }
};

TEST_P(ReadVoids, AreNaNAndNothingElseIs)
{
    MadeRaster raster{.rows = 1, .columns = 3, .type = GetParam().type, .no_data = GetParam().declared};
    raster.value = [](std::size_t, std::size_t, std::size_t x) { return x == 1 ? GetParam().stored : 5.0; };
    HeightFile file(made(raster));
    const std::vector<float> heights = heights_of(file);
    EXPECT_EQ(std::isnan(heights[1]), GetParam().is_void) << heights[1];
    EXPECT_EQ(heights[0], 5.0F);
    EXPECT_EQ(heights[2], 5.0F);
    EXPECT_EQ(file.tally().cells, 3U);
    EXPECT_EQ(file.tally().no_data, GetParam().is_void ? 1U : 0U);
}

INSTANTIATE_TEST_SUITE_P(
    All, ReadVoids,
    ::testing::Values(Void{"Float32", -9999.0, -9999.0, true}, Void{"Int16", -32768.0, -32768.0, true},
                      Void{"Int16", -9999.0, -32768.0,
                           true},                        // the other customary void beside a declared one
                      Void{"Int16", {}, -32768.0, true}, //
                      Void{"Int16", {}, -9999.0, true},  //
                      Void{"Int16", -32768.0, -9999.0, false}, // a deep sea, when something else is declared
                      Void{"Int16", 0.0, 0.0, true},           //
                      Void{"Int16", {}, 0.0, false},           //
                      Void{"Byte", 255.0, 255.0, true},        //
                      Void{"UInt16", 65535.0, 65535.0, true},  //
                      Void{"UInt16", {}, 65535.0, false},      //
                      Void{"Float32", {}, kNaN, true},         //
                      Void{"Float32", kNaN, kNaN, true},       //
                      Void{"Float32", -9999.0, kNaN, true},    //
                      Void{"Float32", {}, kInfinity, true},    //
                      Void{"Float32", {}, -kInfinity, true},   //
                      Void{"Float32", -3.4028234663852886e38, -3.40282306074e38, true}, //
                      Void{"Float64", -1.7976931348623157e308, -1.7976931348623157e308, true},
                      Void{"Float32", {}, 9.969209968386869e36, true}, //
                      Void{"Float32", {}, 8848.86, false},             //
                      Void{"Float64", {}, -10994.0, false},            //
                      Void{"Int32", -2147483648.0, -2147483648.0, true}));

TEST_F(ReadHeights, WithoutDataAreCountedByTheirReason)
{
    MadeRaster raster{.rows = 1, .columns = 6, .no_data = -1.0};
    raster.value = [](std::size_t, std::size_t, std::size_t x) {
        const std::array<double, 6> stored = {3.0, -1.0, kNaN, kInfinity, -32768.0, 4.0};
        return stored[x];
    };
    HeightFile file(made(raster));
    heights_of(file);
    EXPECT_EQ(file.tally().cells, 6U);
    EXPECT_EQ(file.tally().no_data, 4U);
    EXPECT_EQ(file.tally().undeclared_voids, 2U);
    EXPECT_EQ(file.tally().infinities, 1U);
}

TEST_F(ReadHeights, TakeOneMoreNoDataValueWhenAskedTo)
{
    EXPECT_THAT(heights_of(made({.rows = 1, .columns = 3, .no_data = 2.0}), {.no_data = 0.0}),
                ElementsAre(::testing::NanSensitiveFloatEq(std::nanf("")), 1.0F,
                            ::testing::NanSensitiveFloatEq(std::nanf(""))));
}

TEST_F(ReadHeights, AnAlphaBandSaysWhereThereIsData)
{
    MadeRaster raster{.rows = 1, .columns = 4, .type = "UInt16", .colours = {"grey", "alpha"}};
    raster.value = [](std::size_t band, std::size_t, std::size_t x) {
        return band == 1 ? 10.0 : (x == 2 ? 0.0 : 65535.0);
    };
    HeightFile file(made(raster));
    EXPECT_TRUE(file.facts().has_mask);
    const auto heights = heights_of(file);
    EXPECT_TRUE(std::isnan(heights[2]));
    EXPECT_EQ(heights[3], 10.0F);
    EXPECT_EQ(file.tally().no_data, 1U);
    EXPECT_THAT(file.facts().warnings, IsEmpty()) << "an alpha band is no rival for heights";
}

// Units

TEST_F(ReadHeights, ScaleAndOffsetOfTheFileAreApplied)
{
    MadeRaster raster{
        .rows = 1, .columns = 3, .type = "Int16", .no_data = 1.0, .scale = 0.25, .offset = 100.0};
    const auto heights = heights_of(made(raster));
    EXPECT_EQ(heights[0], 100.0F);
    EXPECT_TRUE(std::isnan(heights[1])) << "no data is compared before scaling";
    EXPECT_EQ(heights[2], 100.5F);
}

struct Unit {
    const char* written;
    double metres;
};

TEST_F(ReadHeights, UnitsOfTheBandAreUnderstood)
{
    for (const Unit unit : {Unit{"m", 1.0}, Unit{"metre", 1.0}, Unit{"ft", 0.3048}, Unit{"foot", 0.3048},
                            Unit{"US survey foot", 1200.0 / 3937.0}, Unit{"sftUS", 1200.0 / 3937.0},
                            Unit{"ftUS", 1200.0 / 3937.0}, Unit{"cm", 0.01}, Unit{"km", 1000.0}}) {
        HeightFile file(made({.rows = 1, .columns = 3, .unit = unit.written}));
        EXPECT_FLOAT_EQ(heights_of(file)[2], static_cast<float>(2.0 * unit.metres)) << unit.written;
        EXPECT_THAT(file.facts().warnings, IsEmpty()) << unit.written;
    }
}

TEST_F(ReadHeights, UnknownUnitsAreTakenAsMetresWithAWarning)
{
    HeightFile file(made({.unit = "cubits"}));
    EXPECT_EQ(file.facts().metres_per_unit, 1.0);
    EXPECT_THAT(file.facts().warnings, ElementsAre(HasSubstr("'cubits'")));
}

TEST_F(ReadHeights, TheVerticalPartOfTheCoordinateSystemSaysTheUnit)
{
    // NAD83 / California zone 3 (ftUS) + NAVD88 height (ftUS)
    HeightFile file(made(
        {.geotransform = std::array{6000000.0, 30.0, 0.0, 2000000.0, 0.0, -30.0}, .crs = "EPSG:2227+6360"}));
    EXPECT_NEAR(file.facts().metres_per_unit, 1200.0 / 3937.0, 1e-12);
    EXPECT_EQ(file.facts().height_unit, "US survey feet");
    EXPECT_NEAR(file.ground().cell_size_m.x, 30.0 * 1200.0 / 3937.0, 1e-9);
    EXPECT_THAT(file.facts().warnings, IsEmpty());
}

TEST_F(ReadHeights, AMapInFeetWithoutAHeightUnitIsWarnedAbout)
{
    const std::string path =
        made({.geotransform = std::array{6000000.0, 30.0, 0.0, 2000000.0, 0.0, -30.0}, .crs = "EPSG:2227"});
    HeightFile file(path);
    EXPECT_EQ(file.facts().metres_per_unit, 1.0);
    EXPECT_THAT(file.facts().warnings,
                ElementsAre(AllOf(HasSubstr("US survey feet"), HasSubstr("--z-unit"))));
    HeightFile asked(path, {.metres_per_unit = 0.3048});
    EXPECT_THAT(asked.facts().warnings, IsEmpty());
    EXPECT_EQ(asked.facts().height_unit, "feet");
}

TEST_F(ReadHeights, AreMultipliedByTheZFactor)
{
    EXPECT_THAT(heights_of(made({.rows = 1, .columns = 3}), {.z_factor = 2.5}),
                ElementsAre(0.0F, 2.5F, 5.0F));
}

TEST_F(ReadHeights, OptionsOutOfRangeAreRefused)
{
    const std::string path = made({});
    for (const ReadOptions& options :
         {ReadOptions{.z_factor = 0.0}, ReadOptions{.z_factor = kNaN}, ReadOptions{.metres_per_unit = -1.0},
          ReadOptions{.cell_size_m = 0.0}, ReadOptions{.cell_size_m = kNaN}, ReadOptions{.band = 2}})
        EXPECT_THROW(HeightFile(path, options), InvalidInput);
}

TEST_F(ReadHeights, FarFromTheCentreOfAPlanetKeepTheirMillimetres)
{
    MadeRaster raster{.rows = 1, .columns = 4, .type = "Float64", .no_data = -1e9};
    raster.value = [](std::size_t, std::size_t, std::size_t x) {
        return x == 3 ? -1e9 : 1737400.0 + 0.001 * static_cast<double>(x);
    };
    HeightFile file(made(raster));
    const auto heights = heights_of(file);
    EXPECT_EQ(file.facts().base_m, 1737000.0);
    EXPECT_NEAR(heights[2] - heights[0], 0.002, 1e-4);
    EXPECT_EQ(heights[0], 400.0F);
    EXPECT_TRUE(std::isnan(heights[3]));
}

// Bands

TEST_F(ReadHeights, ComeFromTheBandThatIsAskedFor)
{
    MadeRaster raster{.rows = 1, .columns = 1, .colours = {"grey", "grey"}};
    raster.value = [](std::size_t band, std::size_t, std::size_t) {
        return 10.0 * static_cast<double>(band);
    };
    const std::string path = made(raster);
    EXPECT_THAT(heights_of(path, {.band = 2}), ElementsAre(20.0F));
    HeightFile file(path);
    EXPECT_THAT(heights_of(file), ElementsAre(10.0F));
    EXPECT_THAT(file.facts().warnings, ElementsAre(HasSubstr("--band")));
}

TEST_F(ReadHeights, ColourPicturesAreRefused)
{
    const std::string rgb = made({.type = "Byte", .colours = {"red", "green", "blue"}}, "rgb.tif");
    EXPECT_THAT(why_not(rgb), HasSubstr("colour picture"));
    EXPECT_EQ(why_not(rgb, {.band = 2}), "") << "someone may keep heights in a colour band";
    const std::string greys = made({.type = "Byte", .colours = {"grey", "grey", "grey"}}, "grey.tif");
    EXPECT_THAT(why_not(greys), HasSubstr("colour picture"));
    const std::string wide =
        made({.type = "UInt16", .colours = {"red", "green", "blue", "alpha"}}, "rgba.tif");
    EXPECT_THAT(why_not(wide), HasSubstr("colour picture"));
    const std::string palette = made({.type = "Byte", .colours = {"palette"}}, "palette.tif");
    EXPECT_THAT(why_not(palette), HasSubstr("palette"));
}

TEST_F(ReadHeights, ComplexNumbersAreRefused)
{
    const std::string path = made({.type = "CFloat32"});
    EXPECT_THAT(why_not(path), HasSubstr("complex"));
    EXPECT_THAT(why_not(path, {.band = 1}), HasSubstr("complex"));
}

// Files that are none

TEST_F(ReadHeights, SayWhyAFileCannotBeRead)
{
    EXPECT_THAT(why_not(path("missing.tif")), HasSubstr("no such file"));
    EXPECT_THAT(why_not(path("")), HasSubstr("is a folder"));
    std::ofstream(path("empty.tif"));
    EXPECT_THAT(why_not(path("empty.tif")), HasSubstr("is empty"));
    std::ofstream(path("text.tif")) << "these are no heights\n";
    EXPECT_THAT(why_not(path("text.tif")), HasSubstr("not recognized"));
    for (const char* name : {"missing.tif", "", "empty.tif", "text.tif"})
        EXPECT_THAT(why_not(path(name)), AllOf(HasSubstr(path(name)), ::testing::Not(HasSubstr("\n"))));
}

TEST_F(ReadHeights, StopWhereATruncatedFileBreaksOff)
{
    const std::string file = made({.rows = 300, .columns = 300});
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_THAT(refusal<InputError>([&] { heights_of(file); }),
                AllOf(HasSubstr(file), HasSubstr("cannot be read")));
}

TEST_F(ReadHeights, ComeFromArchivesToo)
{
    made({.rows = 1, .columns = 2}, "a.tif");
    ASSERT_EQ(std::system(("cd '" + path("") + "' && gzip -k a.tif").c_str()), 0);
    HeightFile file("/vsigzip/" + path("a.tif.gz"));
    EXPECT_THAT(heights_of(file), ElementsAre(0.0F, 1.0F));
    EXPECT_TRUE(file.is_made_of(path("a.tif.gz")));
    EXPECT_FALSE(file.is_made_of(path("a.tif")));
}

TEST_F(ReadHeights, MoreThanMemoryHoldsAreRefusedBeforeAnythingIsRead)
{
    std::ofstream(path("huge.vrt")) << "<VRTDataset rasterXSize=\"500000\" rasterYSize=\"500000\">"
                                       "<VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>";
    HeightFile file(path("huge.vrt"));
    EXPECT_EQ(file.rows(), 500000U);
    EXPECT_THAT(refusal<UnsupportedOnThisMachine>([&] { read_terrain(file); }),
                AllOf(HasSubstr("500000 rows x 500000 columns"), HasSubstr("931.3 GiB")));
}

TEST_F(ReadHeights, StopWhenAskedTo)
{
    HeightFile file(made({.rows = 64, .columns = 64}));
    EXPECT_THROW(read_terrain(file, {.progress = [](double) { return false; }}), Cancelled);
}

TEST_F(ReadHeights, AFileIsItselfUnderAnyName)
{
    const std::string file = made({}, "a.tif");
    made({}, "b.tif");
    std::filesystem::create_hard_link(file, path("hard.tif"));
    std::filesystem::create_symlink("a.tif", path("soft.tif"));
    HeightFile opened(path("soft.tif"));
    for (const char* name : {"a.tif", "hard.tif", "soft.tif", "./a.tif"})
        EXPECT_TRUE(opened.is_made_of(path(name))) << name;
    EXPECT_FALSE(opened.is_made_of(path("b.tif")));
    EXPECT_FALSE(opened.is_made_of(path("new.tif")));
}

// The shared elevation data

std::vector<float> shared_heights(const std::string& name, const ReadOptions& options = {})
{
    return heights_of(shared_data(name), options);
}

class SharedFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(SharedFormat, HasTheHeightsOfThePlainGeoTiff)
{
    DUSKLINE_NEED_SHARED_DATA(GetParam());
    DUSKLINE_NEED_SHARED_DATA("hawaii/hawaii_utm5n_512.tif");
    const std::vector<float> plain = shared_heights("hawaii/hawaii_utm5n_512.tif");
    HeightFile file(shared_data(GetParam()));
    const std::vector<float> heights = heights_of(file);
    ASSERT_EQ(heights.size(), plain.size());
    const bool whole = file.facts().sample_type != "Float32";
    for (std::size_t i = 0; i < plain.size(); ++i)
        ASSERT_NEAR(heights[i], plain[i], whole ? 0.5001 : 0.01) << GetParam() << " cell " << i;
    const bool has_georeference = !std::string(GetParam()).ends_with(".png");
    EXPECT_NEAR(file.ground().cell_size_m.x, has_georeference ? 300.0 : 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, SharedFormat,
                         ::testing::Values("awkward/hawaii512.asc", "awkward/hawaii512.nc",
                                           "awkward/hawaii512_f32.flt", "awkward/hawaii512_i16.bil",
                                           "awkward/hawaii512_u16.png", "awkward/southup_f32.tif"));

TEST_F(ReadSharedHeights, VoidsOfFujiAreNoData)
{
    DUSKLINE_NEED_SHARED_DATA("fuji/mt_fuji_90m.tif");
    HeightFile file(shared_data("fuji/mt_fuji_90m.tif"));
    const auto heights = heights_of(file);
    EXPECT_GT(file.tally().no_data, 0U);
    EXPECT_EQ(file.tally().undeclared_voids, 0U);
    for (const float height : heights)
        ASSERT_TRUE(std::isnan(height) || (height > -100.0F && height < 3800.0F)) << height;
}

TEST_F(ReadSharedHeights, NaNAndDeclaredHolesAreTheSameSea)
{
    DUSKLINE_NEED_SHARED_DATA("awkward/sea_nan_f32.tif");
    HeightFile nan(shared_data("awkward/sea_nan_f32.tif"));
    HeightFile declared(shared_data("awkward/sea_nodata_-9999_f32.tif"));
    const auto a = heights_of(nan);
    const auto b = heights_of(declared);
    EXPECT_GT(nan.tally().no_data, 1000U);
    EXPECT_EQ(nan.tally().no_data, declared.tally().no_data);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << i;
}

} // namespace
} // namespace duskline
