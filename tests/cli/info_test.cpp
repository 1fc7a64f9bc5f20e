#include "raster_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace duskline::cli_test {
namespace {

using ::testing::HasSubstr;

class InfoCommand : public RasterRun {};

TEST_F(InfoCommand, SaysWhatItMakesOfAFile)
{
    raster_test::MadeRaster dem{.rows = 4, .columns = 6, .type = "Int16", .no_data = 0.0, .unit = "ft"};
    make(dem);
    const Finished finished = run({"info", "dem.tif"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.err, "");
    for (const char* part : {"dem.tif: GTiff, 4 rows x 6 columns", "Int16", "0.3048 to 92.964 m",
                             "4.17 % without", "10 x 10 m", "UTM zone 33N", "Earth, radius 63", " kernels, "})
        EXPECT_THAT(finished.out, HasSubstr(part));
}

TEST_F(InfoCommand, SaysItInJsonToo)
{
    raster_test::MadeRaster dem{
        .rows = 4, .columns = 6, .geotransform = std::array{5e5, 10.0, 0.0, 4e6, 0.0, 10.0}};
    make(dem);
    const Finished finished = run({"info", "dem.tif", "--json", "-j", "3"});
    const auto info = nlohmann::json::parse(finished.out);
    EXPECT_EQ(info["rows"], 4);
    EXPECT_EQ(info["columns"], 6);
    EXPECT_EQ(info["heights"]["lowest_m"], 0.0);
    EXPECT_EQ(info["heights"]["highest_m"], 305.0);
    EXPECT_EQ(info["heights"]["no_data_cells"], 0);
    EXPECT_EQ(info["cell_size_m"], nlohmann::json::parse("[10.0, 10.0]"));
    EXPECT_EQ(info["rows_flipped"], true);
    EXPECT_EQ(info["body"]["name"], "Earth");
    EXPECT_NEAR(info["centre"]["latitude_deg"].get<double>(), 36.14, 0.01);
    EXPECT_EQ(info["machine"]["threads"], 3);
    EXPECT_THAT(info["machine"]["runnable_kernels"].dump(), HasSubstr("scalar"));
    EXPECT_THAT(info["notes"].dump(), HasSubstr("taken as metres"));
}

TEST_F(InfoCommand, ReadsWithTheSameOptionsAsTheOthers)
{
    raster_test::MadeRaster dem{.rows = 4, .columns = 6};
    make(dem);
    const auto info = nlohmann::json::parse(run({"info", "dem.tif", "--json", "-z", "2", "--z-unit", "ft",
                                                 "--cell-size", "3.5", "--nodata", "305"})
                                                .out);
    EXPECT_NEAR(info["heights"]["highest_m"].get<double>(), 304.0 * 0.6096, 1e-3);
    EXPECT_EQ(info["heights"]["no_data_cells"], 1);
    EXPECT_EQ(info["cell_size_m"][1], 3.5);
}

TEST_F(InfoCommand, ARasterWithoutDataHasNoRange)
{
    raster_test::MadeRaster dem{.no_data = 5.0};
    dem.value = [](std::size_t, std::size_t, std::size_t) { return 5.0; };
    make(dem);
    const Finished finished = run({"info", "dem.tif"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.out, HasSubstr("heights    none"));
    EXPECT_THAT(finished.err, HasSubstr("no data in any cell"));
}

} // namespace
} // namespace duskline::cli_test
