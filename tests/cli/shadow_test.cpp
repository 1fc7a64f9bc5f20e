#include "raster_run.h"

#include <duskline/casting/casters.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/products/shadow_classes.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace duskline::cli_test {
namespace {

using raster_test::MadeRaster;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ShadowCommand : public RasterRun {
protected:
    /// What the library says of a file, with a flat earth.
    Terrain terrain_of(const std::string& name) const
    {
        HeightFile file(path(name).string());
        return read_terrain(file);
    }

    /// Runs `duskline shadow ARGUMENTS...` and expects it to succeed; its summary.
    nlohmann::json shadow(const Arguments& arguments) const
    {
        Arguments command = {"shadow", "--json", "--overwrite"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished.exit_code == 0 ? nlohmann::json::parse(finished.out) : nlohmann::json();
    }
};

std::vector<float> as_floats(const ShadowMask& mask)
{
    std::vector<float> values;
    for (const Lit lit : mask.values())
        values.push_back(static_cast<float>(lit));
    return values;
}

TEST_F(ShadowCommand, WritesAMaskOnTheGridOfTheInput)
{
    make(hills(90, 120));
    const auto summary = shadow({"dem.tif", "shadow.tif", "--azimuth", "200", "--altitude", "12.5"});
    const ReadRaster mask = read("shadow.tif");
    const ReadRaster dem = read("dem.tif");
    EXPECT_EQ(mask.geotransform, dem.geotransform);
    EXPECT_EQ(mask.crs_name, dem.crs_name);
    EXPECT_EQ(mask.no_data, 255.0);
    const auto count = [&](float value) {
        return static_cast<std::size_t>(std::ranges::count(mask.values, value));
    };
    EXPECT_EQ(count(0.0F) + count(1.0F) + count(255.0F), 90U * 120U);
    EXPECT_GT(count(0.0F), 500U);
    EXPECT_EQ(summary["shadow"], count(0.0F));
    EXPECT_EQ(summary["lit"], count(1.0F));
    EXPECT_EQ(summary["no_data"], count(255.0F));
    EXPECT_EQ(summary["cells"], 90 * 120);
    EXPECT_EQ(mask(40, 30), 255.0F);
    EXPECT_THAT(files(), ElementsAre("dem.tif", "shadow.tif"));
}

TEST_F(ShadowCommand, TagsSayTheLightAndTheAssumptions)
{
    make(hills(40, 50));
    shadow({"dem.tif", "a.tif", "--azimuth", "200", "--altitude", "12.5", "-z", "2", "--caster", "sweep"});
    ReadRaster mask = read("a.tif");
    EXPECT_EQ(mask.tags["LIGHT_AZIMUTH"], "200");
    EXPECT_EQ(mask.tags["LIGHT_ALTITUDE"], "12.5");
    EXPECT_EQ(mask.tags["Z_FACTOR"], "2");
    EXPECT_EQ(mask.tags["CURVATURE"], "0.857143");
    EXPECT_EQ(mask.tags["CASTER"], "sweep");
    EXPECT_EQ(mask.tags["ENCODING"], "0 shadow, 1 lit, 255 no data");
    EXPECT_THAT(mask.tags["SOFTWARE"], ::testing::StartsWith("duskline "));
    EXPECT_THAT(mask.tags["ASSUMPTIONS"], HasSubstr("metres"));
    EXPECT_EQ(mask.description, "sunlit azimuth 200, altitude 12.5");

    shadow({"dem.tif", "b.tif", "--time", "2026-06-21T18:30+02:00", "--flat"});
    mask = read("b.tif");
    EXPECT_EQ(mask.tags["LIGHT_TIME_UTC"], "2026-06-21T16:30:00Z");
    EXPECT_EQ(mask.tags["CURVATURE"], "0");
    EXPECT_EQ(mask.description, "sunlit 2026-06-21T18:30:00+02:00");
    EXPECT_GT(std::stod(mask.tags["REFRACTION"]), 0.01);
}

struct Stored {
    const char* name;
    std::vector<std::string> creation_options;
    double x_step;
    double y_step;
};

// Larger than a slab of a stream in both directions, in blocks of every shape, read and written.
TEST_F(ShadowCommand, StreamsTheBytesOfAWholeCast)
{
    for (const Stored& stored :
         {Stored{"tiles", {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=128"}, 10, -10},
          Stored{"tall tiles, mirrored", {"TILED=YES", "BLOCKXSIZE=512", "BLOCKYSIZE=16"}, -10, 10},
          Stored{"strips, south up", {"BLOCKYSIZE=7", "COMPRESS=LZW"}, 10, 10}}) {
        MadeRaster dem = hills(700, 600);
        dem.creation_options = stored.creation_options;
        dem.geotransform = std::array{500000.0, stored.x_step, 0.0, 4000000.0, 0.0, stored.y_step};
        make(dem);
        const Terrain terrain = terrain_of("dem.tif");
        for (const double azimuth : {0.0, 90.0, 180.0, 270.0, 45.0, 203.0, 100.3, 292.67}) {
            const DirectionalLight light = {Angle::from_degrees(azimuth), Angle::from_degrees(9.0)};
            for (const auto& [name, output] : {std::pair{"sweep", "TILED=YES"},
                                               {"sweep", "TILED=NO"},
                                               {"strider", azimuth < 180.0 ? "TILED=YES" : "TILED=NO"}}) {
                shadow({"dem.tif", "mask.tif", "--azimuth", std::to_string(azimuth), "--altitude", "9",
                        "--flat", "--caster", name, "--co", output});
                ReadRaster mask = read("mask.tif");
                if (stored.y_step > 0)
                    for (std::size_t top = 0; top < 350; ++top)
                        std::swap_ranges(mask.values.begin() + static_cast<std::ptrdiff_t>(top * 600),
                                         mask.values.begin() + static_cast<std::ptrdiff_t>((top + 1) * 600),
                                         mask.values.begin()
                                             + static_cast<std::ptrdiff_t>((699 - top) * 600));
                if (stored.x_step < 0)
                    for (std::size_t row = 0; row < 700; ++row)
                        std::reverse(mask.values.begin() + static_cast<std::ptrdiff_t>(row * 600),
                                     mask.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * 600));
                ASSERT_EQ(mask.values, as_floats(caster_named(name).cast(terrain, light, {})))
                    << stored.name << ", azimuth " << azimuth << ", " << name << ", " << output;
            }
        }
    }
}

TEST_F(ShadowCommand, TheNumberOfThreadsChangesNothing)
{
    make(hills(600, 400));
    shadow({"dem.tif", "one.tif", "--azimuth", "100.3", "--altitude", "7", "-j", "1"});
    shadow({"dem.tif", "many.tif", "--azimuth", "100.3", "--altitude", "7", "-j", "5"});
    EXPECT_EQ(read("one.tif").values, read("many.tif").values);
}

TEST_F(ShadowCommand, EveryCasterCanBeAskedFor)
{
    make(hills(80, 60));
    const Terrain terrain = terrain_of("dem.tif");
    for (const Caster& caster : kCasters) {
        const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", "11", "--flat",
                                     "--caster", std::string(caster.name)});
        EXPECT_EQ(summary["caster"], caster.name);
        const DirectionalLight light = {Angle::from_degrees(31.0), Angle::from_degrees(11.0)};
        EXPECT_EQ(read("mask.tif").values, as_floats(caster.cast(terrain, light, {}))) << caster.name;
    }
}

TEST_F(ShadowCommand, TheEarthFallsAwayUnlessItIsFlat)
{
    // A wall 100 m high, 40 km off: lower than the ray from a flat ground's end by the curvature there.
    MadeRaster dem{
        .rows = 3, .columns = 401, .geotransform = std::array{500000.0, 100.0, 0.0, 4e6, 0.0, -100.0}};
    dem.value = [](std::size_t, std::size_t, std::size_t column) { return column == 400 ? 100.0 : 0.0; };
    make(dem);
    const HeightFile file(path("dem.tif").string());
    for (const char* curvature : {"0", "0.857142857", "1"}) {
        shadow({"dem.tif", "mask.tif", "--azimuth", "90", "--altitude", "0.2", "--curvature", curvature,
                "--caster", "ray"});
        const ReadRaster mask = read("mask.tif");
        HeightFile again(path("dem.tif").string());
        Terrain terrain = read_terrain(again);
        CurvedEarth({.coefficient = std::stod(curvature),
                     .radius_m = file.ground().body->local_radius_m,
                     .tangent_row = 1.0,
                     .tangent_column = 200.0},
                    terrain.cell_size_m, 401)
            .lower(terrain.heights_m.view());
        const ShadowMask expected =
            cast_by_ray(terrain, {.azimuth = Angle::from_degrees(90), .altitude = Angle::from_degrees(0.2)});
        EXPECT_EQ(mask.values, as_floats(expected)) << curvature;
    }
}

TEST_F(ShadowCommand, ShadowHeightsAreTheGroundWhereItIsLitAndAboveItInTheShadow)
{
    make(hills(400, 300));
    for (const char* caster : {"sweep", "fast-ray"}) {
        shadow({"dem.tif", "mask.tif", "--azimuth", "203", "--altitude", "10", "--caster", caster});
        shadow({"dem.tif", "heights.tif", "--heights", "--azimuth", "203", "--altitude", "10", "--caster",
                caster});
        const ReadRaster mask = read("mask.tif");
        const ReadRaster heights = read("heights.tif");
        const ReadRaster dem = read("dem.tif");
        EXPECT_EQ(heights.no_data, -9999.0);
        for (std::size_t i = 0; i < dem.values.size(); ++i) {
            if (mask.values[i] == 255.0F)
                ASSERT_EQ(heights.values[i], -9999.0F);
            else if (mask.values[i] == 1.0F)
                ASSERT_EQ(heights.values[i], dem.values[i]) << i;
            else
                ASSERT_GT(heights.values[i], dem.values[i] - 2e-4) << i;
        }
    }
}

TEST_F(ShadowCommand, ShadowHeightsComeInTheUnitOfTheInput)
{
    MadeRaster dem{.rows = 5, .columns = 40, .unit = "ft"};
    dem.value = [](std::size_t, std::size_t, std::size_t column) { return column == 39 ? 1000.0 : 500.0; };
    make(dem);
    shadow({"dem.tif", "heights.tif", "--heights", "--azimuth", "90", "--altitude", "30", "--flat"});
    const ReadRaster heights = read("heights.tif");
    EXPECT_FLOAT_EQ(heights(2, 39), 1000.0F);
    // 10 m = 32.81 ft per cell, falling by its tangent.
    EXPECT_NEAR(heights(2, 38), 1000.0 - 10.0 / 0.3048 * std::tan(M_PI / 6), 1e-2);
    EXPECT_FLOAT_EQ(heights(2, 5), 500.0F);
    shadow({"dem.tif", "twice.tif", "--heights", "--azimuth", "90", "--altitude", "30", "--flat", "-z", "2"});
    EXPECT_NEAR(read("twice.tif")(2, 38), 1000.0 - 5.0 / 0.3048 * std::tan(M_PI / 6), 1e-2);
}

TEST_F(ShadowCommand, ClassesTellSelfShadedFromCast)
{
    make(hills(70, 80));
    shadow({"dem.tif", "classes.tif", "--classes", "--azimuth", "31", "--altitude", "11", "--flat",
            "--caster", "fast-ray"});
    const Terrain terrain = terrain_of("dem.tif");
    const DirectionalLight light = {Angle::from_degrees(31.0), Angle::from_degrees(11.0)};
    const ShadowClasses expected = shadow_classes(terrain, cast_by_fast_ray(terrain, light), light);
    const ReadRaster classes = read("classes.tif");
    for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_EQ(classes.values[i], static_cast<float>(expected.values()[i])) << i;
    EXPECT_THAT(classes.values, Contains(1.0F));
    EXPECT_THAT(classes.values, Contains(2.0F));
}

TEST_F(ShadowCommand, SoftEdgesAreTheVisibleShareOfTheDisc)
{
    make(hills(90, 120));
    const Terrain terrain = terrain_of("dem.tif");
    const auto summary = shadow({"dem.tif", "soft.tif", "--soft", "--azimuth", "31", "--altitude", "11",
                                 "--flat", "--sun-size", "0.9"});
    const VisibleFraction expected = visible_fraction(terrain,
                                                      {.azimuth = Angle::from_degrees(31.0),
                                                       .altitude = Angle::from_degrees(11.0),
                                                       .angular_diameter = Angle::from_degrees(0.9)},
                                                      caster_named("exact"));
    ReadRaster soft = read("soft.tif");
    std::size_t between = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const float share = expected.values()[i];
        ASSERT_EQ(soft.values[i], std::isnan(share) ? -9999.0F : share) << i;
        between += share > 0.0F && share < 1.0F ? 1U : 0U;
    }
    EXPECT_GT(between, 10U);
    EXPECT_EQ(summary["partly_lit"], between);
    EXPECT_EQ(summary["light_diameter_deg"], 0.9);
    EXPECT_EQ(summary["lit"].get<std::size_t>() + summary["shadow"].get<std::size_t>() + between
                  + summary["no_data"].get<std::size_t>(),
              90U * 120U);
    EXPECT_EQ(soft.no_data, -9999.0);
    EXPECT_EQ(soft.tags["LIGHT_DIAMETER"], "0.9");
    EXPECT_THAT(soft.tags["ENCODING"], HasSubstr("disc"));
    EXPECT_THAT(soft.description, ::testing::StartsWith("visible share"));
}

TEST_F(ShadowCommand, ASunOfNoSizeHasHardEdges)
{
    make(hills(60, 70));
    shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", "11"});
    shadow({"dem.tif", "soft.tif", "--soft", "--sun-size", "0", "--azimuth", "31", "--altitude", "11"});
    const ReadRaster mask = read("mask.tif");
    const ReadRaster soft = read("soft.tif");
    for (std::size_t i = 0; i < mask.values.size(); ++i)
        ASSERT_EQ(soft.values[i], mask.values[i] == 255.0F ? -9999.0F : mask.values[i]) << i;
}

TEST_F(ShadowCommand, ASunHalfUpLightsByHalfAndWarnsOfNothing)
{
    MadeRaster dem{.rows = 8, .columns = 9};
    dem.value = [](std::size_t, std::size_t, std::size_t) { return 12.0; };
    make(dem);
    const auto summary =
        shadow({"dem.tif", "soft.tif", "--soft", "--azimuth", "90", "--altitude", "0", "--flat"});
    for (const float share : read("soft.tif").values)
        ASSERT_NEAR(share, 0.5F, 2e-3F);
    EXPECT_EQ(summary["partly_lit"], 72);
    EXPECT_THAT(summary["warnings"].dump(), ::testing::Not(HasSubstr("dark")));
    EXPECT_THAT(
        shadow({"dem.tif", "night.tif", "--soft", "--azimuth", "90", "--altitude", "-1"})["warnings"].dump(),
        HasSubstr("everything is dark"));
}

TEST_F(ShadowCommand, AntialiasedEdgesAreTheLitShareOfCells)
{
    make(hills(90, 120));
    const Terrain terrain = terrain_of("dem.tif");
    const DirectionalLight light = {Angle::from_degrees(31.0), Angle::from_degrees(11.0)};
    const auto summary =
        shadow({"dem.tif", "aa.tif", "--antialias", "--azimuth", "31", "--altitude", "11", "--flat"});
    const LitFraction expected = super_sampled_lit_fraction(terrain, cast_by_exact(terrain, light), light);
    const ReadRaster lit = read("aa.tif");
    for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_EQ(lit.values[i], std::isnan(expected.values()[i]) ? -9999.0F : expected.values()[i]) << i;
    EXPECT_GT(summary["partly_lit"], 10);
}

TEST_F(ShadowCommand, AsksForOneResultAtATime)
{
    make(hills(20, 20));
    const std::array results = {"--soft", "--antialias", "--classes", "--heights"};
    for (const char* one : results)
        for (const char* other : results)
            if (one != other) {
                const Finished finished =
                    run({"shadow", "dem.tif", "a.tif", "--azimuth", "9", "--altitude", "9", one, other});
                EXPECT_EQ(finished.exit_code, 2);
                EXPECT_THAT(finished.err, HasSubstr("excludes"));
            }
    const Finished picture =
        run({"shadow", "dem.tif", "a.png", "--soft", "--azimuth", "9", "--altitude", "9"});
    EXPECT_EQ(picture.exit_code, 2);
    EXPECT_THAT(picture.err, HasSubstr("cannot hold"));
}

TEST_F(ShadowCommand, PicturesAreBlackAndWhite)
{
    make(hills(60, 70));
    shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", "11"});
    const auto summary = shadow({"dem.tif", "mask.png", "--azimuth", "31", "--altitude", "11"});
    const ReadRaster mask = read("mask.tif");
    const ReadRaster picture = read("mask.png");
    EXPECT_EQ(picture.no_data, 128.0);
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        const float expected = mask.values[i] == 1.0F ? 255.0F : mask.values[i] == 0.0F ? 0.0F : 128.0F;
        ASSERT_EQ(picture.values[i], expected);
    }
}

TEST_F(ShadowCommand, ValuesCanBeChosen)
{
    make(hills(60, 70));
    const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", "11",
                                 "--shadow-value", "1", "--lit-value", "0", "--dst-nodata", "7"});
    const ReadRaster mask = read("mask.tif");
    EXPECT_EQ(mask.no_data, 7.0);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(mask.values, 1.0F)), summary["shadow"]);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(mask.values, 7.0F)), summary["no_data"]);
    EXPECT_EQ(mask(40, 30), 7.0F);
}

TEST_F(ShadowCommand, WhatIsTooLargeForMemoryIsCastInWindowsWithTheSameBytes)
{
    make(hills(900, 800));
    const std::vector<Arguments> all{{},
                                     {"--caster", "fast-ray"},
                                     {"--caster", "line-march"},
                                     {"--caster", "line-march-bilinear"},
                                     {"--classes"},
                                     {"--heights"},
                                     {"--flat"}};
    for (const std::string azimuth : {"203", "20", "100.3", "290"})
        for (const Arguments& how : azimuth == "100.3" ? all : std::vector<Arguments>{{}}) {
            SCOPED_TRACE(testing::Message() << azimuth << " " << testing::PrintToString(how));
            Arguments whole{"dem.tif", "whole.tif", "--azimuth", azimuth, "--altitude", "25", "--overwrite"};
            whole.insert(whole.end(), how.begin(), how.end());
            Arguments windows = whole;
            windows[1] = "windows.tif";
            windows.insert(
                windows.end(),
                {"--memory", how == Arguments{"--heights"} || how == Arguments{"--classes"} ? "4.6" : "3.2"});
            const auto of_whole = shadow(whole);
            const auto of_windows = shadow(windows);
            EXPECT_THAT(of_windows["notes"].dump(), HasSubstr("windows"));
            EXPECT_THAT(of_whole["notes"].dump(), Not(HasSubstr("windows")));
            for (const char* count : {"lit", "shadow", "no_data"})
                EXPECT_EQ(of_whole[count], of_windows[count]);
            EXPECT_EQ(read("whole.tif").values, read("windows.tif").values);
        }
}

TEST_F(ShadowCommand, ClassesByACasterWhoseBeamsBeginAtTheBorderAreNotCastInWindows)
{
    make(hills(900, 800));
    for (const std::string caster : {"sweep", "strider"}) {
        const Finished finished = run({"shadow", "dem.tif", "mask.tif", "--azimuth", "203", "--altitude",
                                       "25", "--classes", "--caster", caster, "--memory", "3.2"});
        EXPECT_EQ(finished.exit_code, 5);
        EXPECT_THAT(finished.err, HasSubstr("--caster exact"));
        EXPECT_THAT(files(), ElementsAre("dem.tif"));
    }
}

TEST_F(ShadowCommand, WindowsThatShadowsMakeTooLargeAreRefused)
{
    make(hills(900, 800));
    const Finished finished =
        run({"shadow", "dem.tif", "mask.tif", "--azimuth", "203", "--altitude", "0.5", "--memory", "1.5"});
    EXPECT_EQ(finished.exit_code, 5);
    EXPECT_THAT(finished.err, HasSubstr("--caster sweep"));
    EXPECT_THAT(files(), ElementsAre("dem.tif"));
    EXPECT_EQ(run({"shadow", "dem.tif", "mask.tif", "--azimuth", "203", "--altitude", "9", "--memory", "0"})
                  .exit_code,
              2);
}

TEST_F(ShadowCommand, ANightIsDarkWithAWarning)
{
    make(hills(30, 40));
    for (const char* altitude : {"-10", "0"}) {
        const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", altitude});
        EXPECT_EQ(summary["lit"], 0);
        EXPECT_EQ(summary["shadow"].get<std::size_t>() + summary["no_data"].get<std::size_t>(), 30U * 40U);
        EXPECT_THAT(summary["warnings"].dump(), HasSubstr("everything is dark"));
    }
    shadow({"dem.tif", "heights.tif", "--heights", "--azimuth", "31", "--altitude", "-1"});
    for (const float height : read("heights.tif").values)
        ASSERT_EQ(height, -9999.0F) << "no height is in the sun";
}

TEST_F(ShadowCommand, ALightOverheadLightsAll)
{
    make(hills(30, 40));
    const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", "31", "--altitude", "90"});
    EXPECT_EQ(summary["shadow"], 0);
}

TEST_F(ShadowCommand, AzimuthsGoRoundTheCompass)
{
    make(hills(60, 70));
    shadow({"dem.tif", "a.tif", "--azimuth", "725", "--altitude", "11"});
    shadow({"dem.tif", "b.tif", "--azimuth", "5", "--altitude", "11"});
    shadow({"dem.tif", "c.tif", "--azimuth", "-355", "--altitude", "11"});
    EXPECT_EQ(read("a.tif").values, read("b.tif").values);
    EXPECT_EQ(read("c.tif").values, read("b.tif").values);
    EXPECT_EQ(read("a.tif").tags["LIGHT_AZIMUTH"], "5");
}

TEST_F(ShadowCommand, ARotatedRasterHasTheShadowsOfItsGrid)
{
    MadeRaster straight = hills(90, 110);
    make(straight, "straight.tif");
    const double c = 10.0 * std::cos(20.0 * M_PI / 180.0);
    const double s = 10.0 * std::sin(20.0 * M_PI / 180.0);
    MadeRaster rotated = hills(90, 110); // turned by 20 degrees clockwise
    rotated.geotransform = std::array{500000.0, c, -s, 4000000.0, -s, -c};
    make(rotated, "rotated.tif");
    shadow({"straight.tif", "a.tif", "--azimuth", "100", "--altitude", "9"});
    shadow({"rotated.tif", "b.tif", "--azimuth", "120", "--altitude", "9"});
    EXPECT_EQ(read("a.tif").values, read("b.tif").values);
    EXPECT_EQ(read("b.tif").tags["LIGHT_AZIMUTH"], "120");
    EXPECT_EQ(read("b.tif").geotransform, read("rotated.tif").geotransform);
}

struct Small {
    std::size_t rows;
    std::size_t columns;
};

TEST_F(ShadowCommand, TheSmallestRastersHaveShadowsToo)
{
    for (const Small size : {Small{1, 1}, Small{1, 50}, Small{50, 1}}) {
        MadeRaster dem{.rows = size.rows, .columns = size.columns};
        dem.value = [&](std::size_t, std::size_t row, std::size_t column) {
            return row + 1 == size.rows && column + 1 == size.columns ? 100.0 : 0.0;
        };
        make(dem);
        const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", size.columns > 1 ? "90" : "180",
                                     "--altitude", "45", "--flat"});
        EXPECT_EQ(summary["shadow"], size.rows * size.columns == 1 ? 0 : 9);
    }
}

TEST_F(ShadowCommand, WithoutDataNothingIsSaidOfAnyCell)
{
    for (const double nothing : {std::nan(""), HUGE_VAL, -HUGE_VAL, -9999.0}) {
        MadeRaster dem{.rows = 20, .columns = 30};
        dem.value = [&](std::size_t, std::size_t, std::size_t) { return nothing; };
        make(dem);
        const auto summary = shadow({"dem.tif", "mask.tif", "--azimuth", "90", "--altitude", "45"});
        EXPECT_EQ(summary["no_data"], 600);
        EXPECT_THAT(summary["warnings"].dump(), HasSubstr("no data in any cell")) << nothing;
    }
}

TEST_F(ShadowCommand, ASummaryIsPrintedUnlessQuiet)
{
    make(hills(30, 40));
    const Finished loud = run({"shadow", "dem.tif", "a.tif", "--azimuth", "9", "--altitude", "9"});
    EXPECT_THAT(loud.out, HasSubstr("a.tif: "));
    EXPECT_EQ(loud.err, "");
    const Finished quiet = run({"shadow", "dem.tif", "b.tif", "--azimuth", "9", "--altitude", "9", "-q"});
    EXPECT_EQ(quiet.out + quiet.err, "");
    const Finished verbose = run({"shadow", "dem.tif", "c.tif", "--azimuth", "9", "--altitude", "9", "-v"});
    EXPECT_THAT(verbose.err, HasSubstr("s in all"));
}

TEST_F(ShadowCommand, ProgressShowsOnATerminal)
{
    if (!has_terminals())
        GTEST_SKIP() << "no terminal can be opened on this machine";
    make(hills(600, 700));
    const Finished finished =
        run_on_terminal({"shadow", "dem.tif", "a.tif", "--azimuth", "9", "--altitude", "9"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("0...10...20"));
    EXPECT_THAT(finished.err, ::testing::EndsWith("100 - done.\n"));
}

TEST_F(ShadowCommand, CloudOptimisedAndOtherFormatsAreWritten)
{
    make(hills(300, 200));
    shadow({"dem.tif", "mask.tif", "--azimuth", "9", "--altitude", "9"});
    const auto expected = read("mask.tif").values;
    shadow({"dem.tif", "cog.tif", "--of", "COG", "--azimuth", "9", "--altitude", "9"});
    EXPECT_EQ(read("cog.tif").values, expected);
    shadow({"dem.tif", "mask.img", "--azimuth", "9", "--altitude", "9"});
    EXPECT_EQ(read("mask.img").values, expected);
    EXPECT_EQ(read("mask.img").tags["LIGHT_AZIMUTH"], "9");
}

} // namespace
} // namespace duskline::cli_test
