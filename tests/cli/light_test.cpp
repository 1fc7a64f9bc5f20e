// duskline light.

#include "raster_run.h"

#include <duskline/casting/casters.h>
#include <duskline/casting/finer_mask.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/products/light_map.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/refined.h>

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace duskline::cli_test {
namespace {

using namespace angle_literals;
using raster_test::MadeRaster;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::size_t kRows = 60;
constexpr std::size_t kColumns = 80;

// Every band of a raster, in the order of the file.
struct Bands {
    std::string type;
    std::vector<std::vector<float>> values;
    std::vector<bool> is_opacity;
};

Bands bands_of(const std::string& path)
{
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    if (!dataset)
        throw std::runtime_error("cannot read " + path);
    const int columns = dataset->GetRasterXSize();
    const int rows = dataset->GetRasterYSize();
    Bands bands;
    bands.type = GDALGetDataTypeName(dataset->GetRasterBand(1)->GetRasterDataType());
    for (int i = 1; i <= dataset->GetRasterCount(); ++i) {
        GDALRasterBand& band = *dataset->GetRasterBand(i);
        bands.values.emplace_back(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        bands.is_opacity.push_back(band.GetColorInterpretation() == GCI_AlphaBand);
        if (band.RasterIO(GF_Read, 0, 0, columns, rows, bands.values.back().data(), columns, rows,
                          GDT_Float32, 0, 0, nullptr)
            != CE_None)
            throw std::runtime_error("cannot read the values of " + path);
    }
    return bands;
}

class LightCommand : public RasterRun {
protected:
    LightCommand()
    {
        make(hills(kRows, kColumns));
        HeightFile file(path("dem.tif").string());
        terrain_ = read_terrain(file);
    }

    nlohmann::json light(const Arguments& arguments) const
    {
        Arguments command = {"light", "--json", "--overwrite", "dem.tif"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished.exit_code == 0 ? nlohmann::json::parse(finished.out) : nlohmann::json();
    }

    Bands bands(const std::string& name) const { return bands_of(path(name).string()); }

    void expect_refused(const Arguments& arguments, const std::string& why, int exit_code = 2) const
    {
        const auto before = files();
        Arguments command = {"light", "dem.tif"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(why));
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_EQ(files(), before);
    }

    // What the library says, as floats with -9999 for no data.
    static std::vector<float> as_file(const Grid<float>& light)
    {
        std::vector<float> values(light.values().begin(), light.values().end());
        std::ranges::replace_if(
            values, [](float value) { return std::isnan(value); }, -9999.0F);
        return values;
    }

    LightMap map_of(const std::vector<MapLight>& lights, const LightMapOptions& options = {}) const
    {
        return light_map(terrain_, upward_normals(terrain_), lights, options);
    }

    Terrain terrain_;
};

constexpr DirectionalLight kSun{.azimuth = 203_deg, .altitude = 20_deg};
const Arguments kSunOptions = {"--azimuth", "203", "--altitude", "20", "--flat"};

Arguments with(Arguments arguments, const Arguments& more)
{
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST_F(LightCommand, IsTheLightMapOfTheLibraryByEveryModel)
{
    const ShadowMask mask = cast_by_exact(terrain_, kSun);
    for (const NamedLightModel& model : kLightModels) {
        const auto summary =
            light(with(kSunOptions, {"out.tif", "--model", std::string(model.name), "--ot", "Float32"}));
        const LightMap expected = map_of({{.source = kSun, .lit = mask.view()}},
                                         {.model = model.model, .ambient = model.usual_ambient});
        EXPECT_EQ(bands("out.tif").values.at(0), as_file(expected.channels.at(0))) << model.name;
        EXPECT_EQ(summary["model"], model.name);
        EXPECT_EQ(summary["ambient"], model.usual_ambient);
        EXPECT_EQ(read("out.tif").no_data, -9999.0);
    }
}

TEST_F(LightCommand, HillshadeHasTheNumbersOfGdaldem)
{
    // A place, so that the earth is round for the shadows; gdaldem's slopes know nothing of that.
    light({"ours.tif", "--model", "hillshade", "--azimuth", "315", "--altitude", "35", "--no-shadows"});
    const Finished gdaldem =
        run_program({"gdaldem", "hillshade", "-q", "-az", "315", "-alt", "35", "dem.tif", "theirs.tif"});
    if (gdaldem.exit_code == 127)
        GTEST_SKIP() << "there is no gdaldem here";
    ASSERT_EQ(gdaldem.exit_code, 0) << gdaldem.err;
    const auto ours = bands("ours.tif").values.at(0);
    const auto theirs = bands("theirs.tif").values.at(0);
    std::size_t compared = 0;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (theirs[i] == 0.0F) // at the border and around holes gdaldem says nothing
            continue;
        ASSERT_NEAR(ours[i], theirs[i], 1.0F) << i;
        differ += ours[i] != theirs[i] ? 1U : 0U;
        ++compared;
    }
    EXPECT_GT(compared, 4000U);
    EXPECT_LE(differ, compared / 1000) << "only what is rounded the other way";
    EXPECT_EQ(read("ours.tif").no_data, 0.0);

    light({"dark.tif", "--model", "hillshade", "--azimuth", "315", "--altitude", "35"});
    const auto dark = bands("dark.tif").values.at(0);
    std::size_t shaded = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        ASSERT_TRUE(dark[i] == ours[i] || dark[i] == 1.0F) << i;
        shaded += dark[i] != ours[i] ? 1U : 0U;
    }
    EXPECT_GT(shaded, 100U);
}

TEST_F(LightCommand, WritesBytesWordsAndRealsWithOpacityWhereNeeded)
{
    const ShadowMask mask = cast_by_exact(terrain_, kSun);
    const Grid<float> expected =
        map_of({{.source = kSun, .lit = mask.view()}}, {.ambient = 0.25}).channels.at(0).copy();
    const Arguments options = with(kSunOptions, {"--ambient", "0.25"});
    for (const std::string output : {"out.png", "out.tif"})
        for (const std::string type : {"Byte", "UInt16"}) {
            light(with(options, {output, "--ot", type}));
            const Bands found = bands(output);
            ASSERT_EQ(found.type, type);
            ASSERT_EQ(found.is_opacity, (std::vector<bool>{false, true})); // the hills have a hole
            const float most = type == "Byte" ? 255.0F : 65535.0F;
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const float value = expected.values()[i];
                ASSERT_EQ(found.values[1][i], std::isnan(value) ? 0.0F : most);
                ASSERT_EQ(found.values[0][i], std::isnan(value) ? 0.0F : std::floor(value * most + 0.5F));
            }
        }
    light(with(options, {"cog.tif", "--of", "COG"}));
    light(with(options, {"bytes.png"}));
    EXPECT_EQ(bands("cog.tif").values, bands("bytes.png").values);
}

TEST_F(LightCommand, WithoutHolesThereIsNoOpacity)
{
    MadeRaster dem = hills(30, 40);
    dem.no_data = {};
    dem.value = [](std::size_t, std::size_t, std::size_t column) { return static_cast<double>(column % 7); };
    make(dem);
    light(with(kSunOptions, {"out.tif"}));
    EXPECT_EQ(bands("out.tif").values.size(), 1U);
}

TEST_F(LightCommand, SeveralLightsAddUpInTheirColours)
{
    const DirectionalLight second{.azimuth = 90_deg, .altitude = 40_deg};
    // The centre of row 10, column 20, 30 m above the ground, which --flat leaves where it is.
    const PointLight lamp{{10.0, 20.0, static_cast<double>(terrain_.heights_m(10, 20)) + 30.0}};
    const ShadowMask mask = cast_by_exact(terrain_, kSun);
    const ShadowMask lamp_mask = cast_by_exact(terrain_, lamp);
    const LightMap expected =
        map_of({{.source = kSun, .lit = mask.view(), .strength = 0.5, .colour = {1.0F, 0.8F, 0.6F}},
                {.source = second, .strength = 0.25},
                {.source = lamp,
                 .lit = lamp_mask.view(),
                 .strength = 2.0,
                 .colour = {1.0F, 0.0F, 0.0F},
                 .reach_m = 50}},
               {.ambient = 0.125, .ambient_colour = {0.4F, 0.6F, 1.0F}});
    const auto summary =
        light({"out.tif", "--flat", "--ot", "Float32", "--ambient", "0.125", "--ambient-colour", "#6699ff",
               "--light", "azimuth=203,altitude=20,colour=#ffcc99,strength=0.5", "--light",
               "azimuth=90,altitude=40,strength=0.25,shadows=no", "--light",
               "point=500205,3999895,+30,color=#ff0000,strength=2,reach=50"});
    const Bands found = bands("out.tif");
    ASSERT_EQ(found.values.size(), 3U);
    for (std::size_t c = 0; c < 3; ++c) {
        const auto values = as_file(expected.channels.at(c));
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_NEAR(found.values[c][i], values[i], 1e-6) << c << ' ' << i;
    }
    EXPECT_EQ(summary["lights"].size(), 3U);
    EXPECT_EQ(summary["lights"][1]["shadows"], false);
    EXPECT_EQ(summary["lights"][2]["reach_m"], 50.0);
    EXPECT_EQ(summary["channels"], 3);
    auto tags = read("out.tif").tags;
    EXPECT_THAT(tags["LIGHTS"], HasSubstr("azimuth=203,altitude=20,colour=#ffcc99,strength=0.5; azimuth=90"));
    EXPECT_EQ(tags["AMBIENT"], "0.125");
}

TEST_F(LightCommand, LightsBySpecAreThoseByOptions)
{
    light(with(kSunOptions, {"one.tif"}));
    light({"two.tif", "--flat", "--light", "azimuth=203,altitude=20"});
    EXPECT_EQ(bands("one.tif").values, bands("two.tif").values);
    light({"one.tif", "--flat", "--time", "2026-06-21T07:30+02:00"});
    light({"two.tif", "--flat", "--light", "time=2026-06-21T07:30+02:00"});
    EXPECT_EQ(bands("one.tif").values, bands("two.tif").values);
    EXPECT_EQ(read("two.tif").tags["LIGHT_TIME_UTC"], "2026-06-21T05:30:00Z");
    light({"one.tif", "--flat", "--point", "500205,3999895,+30", "--point", "500605,3999795,300"});
    light(
        {"two.tif", "--flat", "--light", "point=500205,3999895,+30", "--light", "point=500605,3999795,300"});
    EXPECT_EQ(bands("one.tif").values, bands("two.tif").values);
}

TEST_F(LightCommand, WithoutALightItComesFromTheNorthWest)
{
    const auto summary = light({"out.tif"});
    EXPECT_EQ(summary["lights"][0]["azimuth_deg"], 315.0);
    EXPECT_THAT(summary["notes"].dump(), HasSubstr("no light was given"));
}

TEST_F(LightCommand, SoftAndAntialiasedShadowsAreThoseOfTheLibrary)
{
    const Arguments options = with(kSunOptions, {"--ot", "Float32"});
    light(with(options, {"soft.tif", "--soft", "--sun-size", "4"}));
    DirectionalLight wide = kSun;
    wide.angular_diameter = 4_deg;
    const VisibleFraction seen = visible_fraction(terrain_, wide, caster_named("exact"));
    EXPECT_EQ(bands("soft.tif").values.at(0),
              as_file(map_of({{.source = wide, .lit = seen.view()}}).channels.at(0)));
    light(with(options, {"drawn.tif", "--antialias"}));
    const LitFraction share = super_sampled_lit_fraction(terrain_, cast_by_exact(terrain_, kSun), kSun);
    EXPECT_EQ(bands("drawn.tif").values.at(0),
              as_file(map_of({{.source = kSun, .lit = share.view()}}).channels.at(0)));
    EXPECT_EQ(read("drawn.tif").tags["SHADOWS"], "antialiased");
}

TEST_F(LightCommand, AFinerMapIsCastAnewFromTheGroundBetweenSamples)
{
    const auto summary = light(with(kSunOptions, {"fine.tif", "--size", "320", "--ot", "Float32"}));
    EXPECT_EQ(summary["columns"], 320);
    EXPECT_EQ(summary["rows"], 240);
    const Terrain finer = refined(terrain_, 240, 320);
    const ShadowMask mask = finer_mask(terrain_, cast_by_exact(terrain_, kSun), kSun, finer);
    const MapLight sun{.source = kSun, .lit = mask.view()};
    const LightMap expected =
        light_map(finer, refined(upward_normals(terrain_), 240, 320), std::span(&sun, 1));
    EXPECT_EQ(bands("fine.tif").values.at(0), as_file(expected.channels.at(0)));
    const ReadRaster raster = read("fine.tif");
    EXPECT_THAT(raster.geotransform, ElementsAre(500000.0, 2.5, 0.0, 4000000.0, 0.0, -2.5));

    light(with(kSunOptions, {"wide.tif", "--size", "160x60"}));
    EXPECT_EQ(read("wide.tif").columns, 160U);
    EXPECT_EQ(read("wide.tif").rows, kRows);
}

TEST_F(LightCommand, ALampStandsWhereItStandsOnAFinerMapToo)
{
    const Arguments lamp = {"--flat", "--point", "500405,3999695,400", "--ot", "Float32", "--ambient", "0"};
    light(with(lamp, {"coarse.tif"}));
    light(with(lamp, {"fine.tif", "--size", "240"}));
    const ReadRaster coarse = read("coarse.tif");
    const ReadRaster fine = read("fine.tif");
    // An odd multiple has every sample: the middle one of nine.
    std::size_t lit = 0;
    for (std::size_t y = 0; y < kRows; ++y)
        for (std::size_t x = 0; x < kColumns; ++x) {
            ASSERT_NEAR(fine(3 * y + 1, 3 * x + 1), coarse(y, x), 1e-4) << y << ' ' << x;
            lit += coarse(y, x) > 0.0F ? 1U : 0U;
        }
    EXPECT_GT(lit, 1000U);
}

TEST_F(LightCommand, MultipliesATextureOnTheMapsOwnGrid)
{
    MadeRaster colours{.rows = 2 * kRows, .columns = 2 * kColumns, .type = "Byte"};
    colours.colours = {"red", "green", "blue", "alpha"};
    colours.geotransform = std::array{500000.0, 5.0, 0.0, 4000000.0, 0.0, -5.0};
    colours.value = [](std::size_t band, std::size_t row, std::size_t column) {
        return band == 4 ? (row < 10 ? 0.0 : 255.0)
                         : static_cast<double>((row + 2 * column + 40 * band) % 256);
    };
    make(colours, "colours.tif");
    const Arguments options = with(kSunOptions, {"--size", "160"});
    light(with(options, {"light.tif", "--ot", "Float32"}));
    light(with(options, {"lit.tif", "--texture", "colours.tif"}));
    const auto light_values = bands("light.tif").values.at(0);
    const Bands lit = bands("lit.tif");
    ASSERT_EQ(lit.values.size(), 4U);
    for (std::size_t i = 0; i < light_values.size(); ++i) {
        const bool nothing = light_values[i] == -9999.0F || i / 160 < 10;
        ASSERT_EQ(lit.values[3][i], nothing ? 0.0F : 255.0F) << i;
        for (std::size_t band = 1; band <= 3 && !nothing; ++band)
            ASSERT_NEAR(lit.values[band - 1][i],
                        light_values[i] * static_cast<float>(colours.value(band, i / 160, i % 160)), 0.501)
                << i;
    }
}

TEST_F(LightCommand, PackedNormalsAreOffByLittleAndOnlyBecauseTheyArePacked)
{
    light(with(kSunOptions, {"exact.tif", "--ot", "Float32"}));
    light(with(kSunOptions, {"packed.tif", "--ot", "Float32", "--normals", "packed"}));
    const auto exact = bands("exact.tif").values.at(0);
    const auto packed = bands("packed.tif").values.at(0);
    float worst = 0.0F;
    for (std::size_t i = 0; i < exact.size(); ++i)
        worst = std::max(worst, std::abs(exact[i] - packed[i]));
    EXPECT_GT(worst, 0.001F);
    EXPECT_LT(worst, 0.007F); // the sine of 0.4 degrees
    EXPECT_EQ(read("packed.tif").tags["NORMALS"], "packed");
}

TEST_F(LightCommand, SouthUpRastersGetTheSameMapAndPicturesTheRightWayUp)
{
    light(with(kSunOptions, {"north_up.tif"}));
    MadeRaster turned = hills(kRows, kColumns);
    const auto value = turned.value;
    turned.geotransform = std::array{500000.0, 10.0, 0.0, 4000000.0 - 10.0 * kRows, 0.0, 10.0};
    turned.value = [value](std::size_t band, std::size_t row, std::size_t column) {
        return value(band, kRows - 1 - row, column);
    };
    make(turned);
    light(with(kSunOptions, {"south_up.tif"}));
    light(with(kSunOptions, {"south_up.png"}));
    const ReadRaster expected = read("north_up.tif");
    const ReadRaster raster = read("south_up.tif");
    const ReadRaster picture = read("south_up.png");
    for (std::size_t y = 0; y < kRows; ++y)
        for (std::size_t x = 0; x < kColumns; ++x) {
            ASSERT_EQ(raster(kRows - 1 - y, x), expected(y, x));
            ASSERT_EQ(picture(y, x), expected(y, x));
        }
    EXPECT_EQ(raster.geotransform, *turned.geotransform);
    EXPECT_EQ(picture.geotransform, expected.geotransform);
}

TEST_F(LightCommand, AMeshHasAVertexForEveryCellWithData)
{
    const auto summary = light(with(kSunOptions, {"out.ply"}));
    light(with(kSunOptions, {"out.tif"}));
    const std::string mesh = read_file("out.ply");
    const Bands picture = bands("out.tif");
    std::size_t data = 0;
    for (const float opacity : picture.values.at(1))
        data += opacity > 0.0F ? 1U : 0U;
    ASSERT_LT(data, kRows * kColumns);
    EXPECT_THAT(mesh.substr(0, 4000), HasSubstr("element vertex " + std::to_string(data) + "\n"));
    EXPECT_THAT(mesh.substr(0, 4000), HasSubstr("comment x 0, y 0 is 500400 3999700 of "));
    EXPECT_THAT(mesh.substr(0, 4000), HasSubstr("comment LIGHTS=azimuth=203,altitude=20"));
    EXPECT_EQ(summary["output"], "out.ply");
    // The first vertex's colour is the first cell's light.
    const auto first = static_cast<unsigned char>(mesh.at(mesh.find("end_header\n") + 11 + 24));
    EXPECT_EQ(static_cast<float>(first), picture.values.at(0).front());
}

TEST_F(LightCommand, AMeshIsTheGroundAsItIsOnARoundEarthToo)
{
    MadeRaster dem = hills(40, 40);
    dem.geotransform = std::array{400000.0, 1000.0, 0.0, 4000000.0, 0.0, -1000.0};
    make(dem);
    light({"out.ply", "--azimuth", "203", "--altitude", "20"});
    const std::string mesh = read_file("out.ply");
    float height = 0.0F;
    std::memcpy(&height, mesh.data() + mesh.find("end_header\n") + 11 + 8, sizeof(height));
    EXPECT_NEAR(height, dem.value(1, 0, 0), 0.001);
}

TEST_F(LightCommand, SaysWhereAndHowItWasMade)
{
    light(with(kSunOptions, {"out.tif"}));
    ReadRaster raster = read("out.tif");
    EXPECT_EQ(raster.tags["LIGHT_AZIMUTH"], "203");
    EXPECT_EQ(raster.tags["LIGHT_MODEL"], "lambert");
    EXPECT_EQ(raster.tags["SHADOWS"], "hard");
    EXPECT_EQ(raster.tags["ENCODING"], "light from 0 to 255; opacity 0 no data");
    EXPECT_EQ(raster.geotransform, (std::array{500000.0, 10.0, 0.0, 4000000.0, 0.0, -10.0}));
    EXPECT_THAT(raster.crs_name, HasSubstr("33N"));
}

TEST_F(LightCommand, ANightIsTheAmbientLight)
{
    const auto summary = light({"out.tif", "--azimuth", "90", "--altitude", "-3", "--ambient", "0.4"});
    EXPECT_THAT(summary["warnings"].dump(), HasSubstr("not above the horizon"));
    EXPECT_NEAR(summary["mean_light"], 0.4, 1e-6);
}

TEST_F(LightCommand, RefusesLightsThatAreNone)
{
    const auto spec = [&](const std::string& text, const std::string& why) {
        expect_refused({"out.tif", "--light", text}, why);
    };
    spec("azimuth=90", "--light 'azimuth=90': --azimuth needs --altitude");
    spec("90,45", "it must be KEY=VALUE");
    spec("azimuth=90,altitude=95", "altitude must be from -90 to 90, got 95");
    spec("azimuth=90,altitude=45,hue=3", "it has no key 'hue'; there are: azimuth");
    spec("azimuth=90,altitude=45,azimuth=91", "it has 'azimuth' twice");
    spec("azimuth=90,altitude=45,colour=red", "colour must be #RRGGBB such as #ffcc88, got 'red'");
    spec("azimuth=90,altitude=45,strength=-1", "strength must be from 0");
    spec("azimuth=90,altitude=45,reach=100", "a sun has no reach");
    spec("azimuth=90,altitude=45,shadows=maybe", "shadows must be yes or no");
    spec("point=500205,3999895", "--point must be X,Y,Z");
    spec("point=500205,3999895,300,altitude=45", "a lamp has no altitude");
    spec("point=400000,3999895,+30", "no ground at that place");
    spec("time=yesterday", "--time");
    expect_refused({"out.tif", "--light", "azimuth=90,altitude=45", "--azimuth", "9", "--altitude", "9"},
                   "give every light by --light");
    expect_refused({"out.tif", "--azimuth", "9"}, "--azimuth needs --altitude");
    expect_refused({"out.tif", "--point", "500205,3999895,300", "--soft"}, "all the lights are lamps");
    expect_refused({"out.tif", "--light", "point=500205,3999895,300", "--antialias"},
                   "all the lights are lamps");
    expect_refused({"out.tif", "--point", "500205,3999895,300", "--caster", "sweep"}, "these do: ray");
}

TEST_F(LightCommand, RefusesMapsThatCannotBe)
{
    expect_refused({"out.tif", "--model", "phong"}, "no light model is called 'phong'; there are: lambert");
    expect_refused({"out.tif", "--ambient", "1.5"}, "--ambient must be from 0 to 1");
    expect_refused({"out.tif", "--ambient-colour", "#12345"}, "--ambient-colour must be #RRGGBB");
    expect_refused({"out.tif", "--normals", "small"}, "--normals must be exact or packed");
    expect_refused({"out.tif", "--size", "79"},
                   "--size must be at least that of the raster, 80x60, got 79x59");
    expect_refused({"out.tif", "--size", "80x"}, "height of --size must be a whole number");
    expect_refused({"out.tif", "--ot", "Int16"}, "--ot must be Byte, UInt16 or Float32");
    expect_refused({"out.png", "--ot", "Float32"}, "PNG cannot hold");
    expect_refused({"out.jpg", "--ot", "UInt16"}, "JPEG cannot hold samples of type UInt16");
    expect_refused({"out.ply", "--ot", "UInt16"}, "a mesh has colours of 8 bits");
    expect_refused({"out.ply", "--co", "COMPRESS=NONE"}, "--co is for GDAL's formats");
    expect_refused({"out.tif", "--texture", "nothing.tif"}, "'nothing.tif': no such file", 3);
    expect_refused({"dem.tif", "--overwrite"}, "it is the input", 4);
    write_file("there.ply", "");
    expect_refused({"there.ply"}, "--overwrite", 4);
    expect_refused({"nowhere/out.ply"}, "nowhere", 4);
    EXPECT_NE(run({"light", "dem.tif", "out.tif", "--soft", "--antialias"}).exit_code, 0);
    EXPECT_NE(run({"light", "dem.tif", "out.tif", "--soft", "--no-shadows"}).exit_code, 0);
    EXPECT_THAT(files(), Not(testing::Contains("out.tif")));
}

} // namespace
} // namespace duskline::cli_test
