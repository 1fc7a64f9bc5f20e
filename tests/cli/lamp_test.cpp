// duskline shadow --point.

#include "raster_run.h"

#include <duskline/casting/lamps.h>
#include <duskline/raster_io/map_place.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/ground_height.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace duskline::cli_test {
namespace {

using raster_test::MadeRaster;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LampCommand : public RasterRun {
protected:
    Terrain terrain_of(const std::string& name) const
    {
        HeightFile file(path(name).string());
        return read_terrain(file);
    }

    nlohmann::json shadow(const Arguments& arguments) const
    {
        Arguments command = {"shadow", "--json", "--overwrite", "dem.tif", "out.tif"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished.exit_code == 0 ? nlohmann::json::parse(finished.out) : nlohmann::json();
    }

    void expect_refused(const Arguments& arguments, const std::string& why) const
    {
        Arguments command = {"shadow", "dem.tif", "refused.tif"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = run(command);
        EXPECT_EQ(finished.exit_code, 2) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(why));
        EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
        EXPECT_THAT(files(), ElementsAre("dem.tif"));
    }
};

template <typename Answers>
std::vector<float> as_floats(const Answers& answers)
{
    std::vector<float> values;
    for (const auto answer : answers.values())
        values.push_back(static_cast<float>(answer));
    return values;
}

// In the order of the library, whatever the file's.
std::vector<float> turned_round(const ReadRaster& raster, bool rows, bool columns)
{
    std::vector<float> values;
    for (std::size_t y = 0; y < raster.rows; ++y)
        for (std::size_t x = 0; x < raster.columns; ++x)
            values.push_back(raster(rows ? raster.rows - 1 - y : y, columns ? raster.columns - 1 - x : x));
    return values;
}

TEST_F(LampCommand, StandsAtMapCoordinatesWhicheverWayTheFileRuns)
{
    for (const auto& [x_step, y_step] :
         {std::pair{10.0, -10.0}, std::pair{10.0, 10.0}, std::pair{-10.0, -10.0}}) {
        MadeRaster dem = hills(70, 90);
        dem.geotransform = std::array{500000.0, x_step, 0.0, 4000000.0, 0.0, y_step};
        make(dem);
        const Terrain terrain = terrain_of("dem.tif");
        // The centre of the file's row 20, column 30, and a bit.
        const std::string x = std::to_string(500000.0 + 30.5 * x_step + 2.5);
        const std::string y = std::to_string(4000000.0 + 20.5 * y_step + 2.5);
        const auto summary = shadow({"--point", x + "," + y + ",500", "--flat"});
        // y grows to the north: 2.5 m more is a quarter row towards row 0.
        const double row = y_step < 0.0 ? 19.75 : 69.0 - 20.25;
        const double column = x_step > 0.0 ? 30.25 : 89.0 - 29.75;
        EXPECT_DOUBLE_EQ(summary["lamps"][0]["row"], row);
        EXPECT_DOUBLE_EQ(summary["lamps"][0]["column"], column);
        const ShadowMask expected = cast_by_ray(terrain, PointLight{{row, column, 500.0}});
        EXPECT_EQ(turned_round(read("out.tif"), y_step > 0.0, x_step < 0.0), as_floats(expected));
        EXPECT_GT(std::ranges::count(expected.values(), Lit::no), 100);
        EXPECT_GT(std::ranges::count(expected.values(), Lit::yes), 100);
    }
}

TEST_F(LampCommand, StandsAboveTheGroundAndSinksWithItBelowTheHorizon)
{
    // Cells of 500 m: at the corner the ground has fallen by some 20 m.
    MadeRaster dem = hills(60, 80);
    dem.geotransform = std::array{400000.0, 500.0, 0.0, 4000000.0, 0.0, -500.0};
    make(dem);
    HeightFile file(path("dem.tif").string());
    const EarthCurvature curvature{.coefficient = 1.0,
                                   .radius_m = file.ground().body->local_radius_m,
                                   .tangent_row = 29.5,
                                   .tangent_column = 39.5};
    Terrain lowered = read_terrain(file);
    const double ground_m = ground_height_m(lowered, 5.25, 70.5).value();
    CurvedEarth(curvature, lowered.cell_size_m, 80).lower(lowered.heights_m.view());
    const PointLight lamp{{5.25, 70.5, ground_height_m(lowered, 5.25, 70.5).value() + 12.5}};

    const auto above = shadow({"--point", "435500,3997125,+12.5", "--curvature", "1"});
    EXPECT_NEAR(above["lamps"][0]["height_m"], ground_m + 12.5, 0.01);
    const auto mask = read("out.tif").values;
    EXPECT_EQ(mask, as_floats(cast_by_ray(lowered, lamp)));
    EXPECT_THAT(above["warnings"], testing::IsEmpty());

    // The same height, given as such.
    shadow({"--point", "435500,3997125," + above["lamps"][0]["height_m"].dump(), "--curvature", "1"});
    const auto same = read("out.tif").values;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
        differ += mask[i] != same[i];
    EXPECT_LE(differ, 2U);
}

TEST_F(LampCommand, SeveralLightTogether)
{
    make(hills(60, 80));
    const Terrain terrain = terrain_of("dem.tif");
    const Caster& exact = caster_named("exact");
    const Arguments points = {"--point", "500205,3999695,400", "--point", "500605,3999795,300",
                              "--point", "499905,3999595,350", "--flat"};
    const std::array lamps = {PointLight{{30.0, 20.0, 400.0}}, PointLight{{20.0, 60.0, 300.0}},
                              PointLight{{40.0, -10.0, 350.0}}};
    const auto with = [&](const std::string& option) {
        Arguments arguments = points;
        if (!option.empty())
            arguments.push_back(option);
        return shadow(arguments);
    };
    const auto summary = with("");
    EXPECT_EQ(read("out.tif").values, as_floats(lit_by_any(exact, terrain, lamps)));
    EXPECT_EQ(summary["lamps"].size(), 3U);
    EXPECT_THAT(summary["notes"].dump(), HasSubstr("outside the raster"));
    EXPECT_EQ(read("out.tif").tags["LIGHT_POINTS"],
              "500205,3999695,400; 500605,3999795,300; 499905,3999595,350");
    EXPECT_THAT(read("out.tif").tags["ENCODING"], HasSubstr("at least one lamp"));
    EXPECT_EQ(read("out.tif").description, "lit, 3 lamps");

    const auto counted = with("--count");
    std::vector<float> counts = as_floats(count_lamps(exact, terrain, lamps));
    std::ranges::replace(counts, 65535.0F, 255.0F);
    EXPECT_EQ(read("out.tif").values, counts);
    EXPECT_EQ(counted["lit"], summary["lit"]);
    EXPECT_EQ(counted["shadow"], summary["shadow"]);

    with("--heights");
    const ShadowField shadows = shadow_heights_of_any(exact, terrain, lamps);
    ReadRaster heights = read("out.tif");
    EXPECT_EQ(heights.tags["ENCODING"], "height a point needs to be in the light, metres; -9999 no data");
    for (std::size_t i = 0; i < heights.values.size(); ++i) {
        const float ground_m = terrain.heights_m.values()[i];
        const float expected = std::isnan(ground_m) ? -9999.0F : std::max(ground_m, shadows.values()[i]);
        ASSERT_EQ(heights.values[i], expected) << i;
    }
}

TEST_F(LampCommand, TagsAndSummarySayWhereItStands)
{
    make(hills(30, 40));
    const auto summary = shadow({"--point", "500205,3999895,1e3"});
    ReadRaster mask = read("out.tif");
    EXPECT_EQ(mask.tags["LIGHT_POINTS"], "500205,3999895,1000");
    EXPECT_EQ(mask.tags.count("LIGHT_AZIMUTH"), 0U);
    EXPECT_EQ(mask.tags["CASTER"], "exact");
    EXPECT_EQ(mask.description, "lit, lamp at 500205,3999895,1000");
    EXPECT_FALSE(summary.contains("azimuth_deg"));
    EXPECT_EQ(summary["lamps"][0]["x"], 500205.0);
    EXPECT_EQ(summary["lamps"][0]["row"], 10.0);
    EXPECT_EQ(summary["lamps"][0]["column"], 20.0);
}

TEST_F(LampCommand, WarnsOfALampUnderTheGroundAndOfOneFarAway)
{
    make(hills(30, 40));
    const auto sunk = shadow({"--point", "500205,3999895,-500"});
    EXPECT_THAT(sunk["warnings"].dump(), HasSubstr("m below the ground: it lights nothing"));
    EXPECT_EQ(sunk["lit"], 0);
    const auto far = shadow({"--point", "11.5,46.5,3000"}); // degrees, in a raster of metres
    EXPECT_THAT(far["warnings"].dump(), HasSubstr("km outside the raster"));
}

TEST_F(LampCommand, RefusesWhatIsNoLampAndWritesNothing)
{
    make(hills(30, 40));
    expect_refused({"--point", "500205,3999895"}, "--point must be X,Y,Z");
    expect_refused({"--point", "500205,3999895,30,4"}, "--point must be X,Y,Z");
    expect_refused({"--point", "500205,,30"}, "Y of --point must be a finite number");
    expect_refused({"--point", "nan,3999895,30"}, "X of --point must be a finite number");
    expect_refused({"--point", "500205,3999895,high"}, "Z of --point must be a finite number");
    expect_refused({"--point", "400000,3999895,+30"}, "no ground at that place");
    expect_refused({"--point", "500205,3999895,30", "--azimuth", "9", "--altitude", "9"}, "not both");
    expect_refused({"--point", "500205,3999895,30", "--time", "2026-06-21T18:30Z"}, "not both");
    expect_refused({"--point", "500205,3999895,30", "--sun-size", "1"}, "--sun-size");
    expect_refused({"--point", "500205,3999895,30", "--classes"}, "--classes");
    expect_refused({"--point", "500205,3999895,30", "--count", "--heights"}, "--count");
    expect_refused({"--azimuth", "9", "--altitude", "9", "--count"}, "give --point too");
    expect_refused({"--point", "500205,3999895,30", "--caster", "sweep"}, "these do: ray, fast-ray, exact");
}

} // namespace
} // namespace duskline::cli_test
