#include "stopped_run.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>

namespace duskline::cli_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;

class HoursCommand : public StoppedRun {
protected:
    Finished hours(const Arguments& more, const std::string& output = "out.tif") const
    {
        Arguments arguments = {"hours", "dem.tif", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    void expect_refusal(const Arguments& more, int exit_code, const std::string& says) const
    {
        const Finished finished = hours(more, "refused.tif");
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_THAT(finished.err, HasSubstr(says));
        EXPECT_FALSE(std::filesystem::exists(path("refused.tif")));
    }

    void make_flat(std::size_t rows = 6, std::size_t columns = 8) const
    {
        raster_test::MadeRaster flat{.rows = rows, .columns = columns};
        flat.value = [](std::size_t, std::size_t, std::size_t) { return 100.0; };
        make(flat);
    }

    // A valley of 45 degrees that runs north-south, on the equator and the prime meridian.
    void make_valley() const
    {
        raster_test::MadeRaster valley{.rows = 3, .columns = 401};
        valley.geotransform = {-0.02, 0.0001, 0.0, 0.00015, 0.0, -0.0001};
        valley.crs = "EPSG:4326";
        valley.value = [](std::size_t, std::size_t, std::size_t column) {
            return 11.1319491 * std::abs(static_cast<double>(column) - 200.0);
        };
        make(valley);
    }

    std::vector<float> band(int number, const std::string& name = "out.tif") const
    {
        GDALAllRegister();
        const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path(name).c_str(), GDAL_OF_RASTER));
        const int columns = dataset->GetRasterXSize();
        const int rows = dataset->GetRasterYSize();
        std::vector<float> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        EXPECT_EQ(dataset->GetRasterBand(number)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(),
                                                           columns, rows, GDT_Float32, 0, 0, nullptr),
                  CE_None);
        return values;
    }
};

TEST_F(HoursCommand, FlatGroundHasTheAlmanacsDayLength)
{
    make_flat();
    for (const char* date : {"2026-06-21", "2026-12-21", "2026-03-20"}) {
        const Finished finished = hours({"--date", date, "--overwrite"});
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
        const Finished almanac = run({"sun", "dem.tif", "--date", date, "--json"});
        const double daylight_s = nlohmann::json::parse(almanac.out)["day"]["daylight_s"];
        EXPECT_THAT(read("out.tif").values,
                    Each(FloatNear(static_cast<float>(daylight_s / 3600.0), 1.5f / 3600.0f)))
            << date;
    }
}

TEST_F(HoursCommand, AValleyOf45DegreesOnTheEquatorHasSixHoursOnTheEquinox)
{
    make_valley();
    const Finished finished = hours({"--date", "2026-03-20", "--limb", "centre", "--pressure", "0", "--flat",
                                     "--light-times", "--refine"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NEAR(band(1)[401 + 200], 6.0, 15.0 / 3600.0);
    // Solar noon is at 12:07:30.
    EXPECT_NEAR(band(2)[401 + 200], 9.0 + 7.5 / 60.0, 30.0 / 3600.0);
    EXPECT_NEAR(band(3)[401 + 200], 15.0 + 7.5 / 60.0, 30.0 / 3600.0);
    // As almanacs count, the edge of the disc and refraction make it two minutes more.
    ASSERT_EQ(hours({"--date", "2026-03-20", "--flat", "--light-times", "--refine", "--overwrite"}).exit_code,
              0);
    EXPECT_NEAR(band(1)[401 + 200], 6.0 + 2.3 / 60.0, 20.0 / 3600.0);
}

TEST_F(HoursCommand, SaysWhatItsBandsAre)
{
    make(hills(60, 70));
    const Finished finished =
        hours({"--date", "2026-06-21", "--utc-offset", "+01:00", "--light-times", "--step", "20", "--json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto summary = nlohmann::json::parse(finished.out);
    EXPECT_EQ(summary["command"], "hours");
    EXPECT_EQ(summary["days"], 1);
    EXPECT_GT(summary["no_data"].get<int>(), 0);
    EXPECT_GT(summary["suns"].get<int>(), 40);
    const ReadRaster raster = read("out.tif");
    EXPECT_EQ(raster.no_data, -9999.0);
    EXPECT_EQ(raster(40, 30), -9999.0f) << "a hole";
    EXPECT_EQ(raster.description, "hours of sun a day, 2026-06-21");
    EXPECT_EQ(raster.tags.at("SUN_LIMB"), "upper");
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path("out.tif").c_str(), GDAL_OF_RASTER));
    ASSERT_EQ(dataset->GetRasterCount(), 3);
    EXPECT_STREQ(dataset->GetRasterBand(2)->GetDescription(),
                 "first light, hours after 00:00 of 2026-06-21 by UTC+01:00");
    EXPECT_STREQ(dataset->GetRasterBand(3)->GetDescription(),
                 "last light, hours after 00:00 of 2026-06-21 by UTC+01:00");
    EXPECT_STREQ(dataset->GetRasterBand(3)->GetUnitType(), "h");
}

TEST_F(HoursCommand, TimesOfLightFollowTheClock)
{
    make_flat();
    ASSERT_EQ(hours({"--date", "2026-06-21", "--light-times"}).exit_code, 0);
    const float utc = band(2)[0];
    ASSERT_EQ(
        hours({"--date", "2026-06-21", "--light-times", "--utc-offset", "-03:30", "--overwrite"}).exit_code,
        0);
    EXPECT_NEAR(band(2)[0], utc - 3.5f, 1e-5f);
}

TEST_F(HoursCommand, ListsAndPeriodsAreTheMeanOfTheirDaysOrAll)
{
    make(hills(40, 50));
    ASSERT_EQ(hours({"--date", "2026-06-01", "--step", "30"}, "a.tif").exit_code, 0);
    ASSERT_EQ(hours({"--date", "2026-06-04", "--step", "30"}, "b.tif").exit_code, 0);
    ASSERT_EQ(hours({"--dates", "2026-06-01,2026-06-04", "--step", "30"}, "list.tif").exit_code, 0);
    ASSERT_EQ(hours({"--from", "2026-06-01", "--to", "2026-06-06", "--every", "3", "--step", "30", "--total"},
                    "total.tif")
                  .exit_code,
              0);
    const auto a = read("a.tif");
    const auto b = read("b.tif");
    const auto list = read("list.tif");
    const auto total = read("total.tif");
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const bool hole = a.values[i] == -9999.0f;
        EXPECT_NEAR(list.values[i], hole ? -9999.0f : (a.values[i] + b.values[i]) / 2.0f, 1e-4f);
        EXPECT_NEAR(total.values[i], hole ? -9999.0f : 3.0f * (a.values[i] + b.values[i]), 1e-3f);
    }
}

TEST_F(HoursCommand, TheThreadsChangeNothing)
{
    make(hills(80, 90));
    ASSERT_EQ(hours({"--date", "2026-06-21", "--step", "15", "-j", "1"}, "one.tif").exit_code, 0);
    ASSERT_EQ(hours({"--date", "2026-06-21", "--step", "15", "-j", "3"}, "three.tif").exit_code, 0);
    EXPECT_EQ(read("one.tif").values, read("three.tif").values);
}

TEST_F(HoursCommand, APolarNightHasNoSunAndAPolarDayAll)
{
    raster_test::MadeRaster flat{.rows = 4, .columns = 4};
    flat.value = [](std::size_t, std::size_t, std::size_t) { return 5.0; };
    flat.geotransform = {15.6, 0.0001, 0.0, 78.2, 0.0, -0.0001};
    flat.crs = "EPSG:4326";
    make(flat);
    const Finished night = hours({"--date", "2026-12-21"});
    ASSERT_EQ(night.exit_code, 0) << night.err;
    EXPECT_THAT(night.err, HasSubstr("the sun does not rise"));
    EXPECT_THAT(read("out.tif").values, Each(0.0f));
    ASSERT_EQ(hours({"--date", "2026-06-21", "--flat", "--overwrite"}).exit_code, 0);
    EXPECT_EQ(read("out.tif")(0, 0), 24.0f);
}

const Arguments kFiveDays = {"--from", "2026-06-01", "--to",     "2026-06-05",
                             "--step", "60",         "--resume", "--json"};

TEST_F(HoursCommand, GoesOnWhereItWasStoppedByCtrlC)
{
    make(hills(40, 50));
    ASSERT_EQ(hours(kFiveDays, "whole.tif").exit_code, 0);
    Arguments job = {"hours", "dem.tif", "out.tif"};
    job.insert(job.end(), kFiveDays.begin(), kFiveDays.end());
    const Finished stopped = run_until({".checkpoint", 2, SIGINT}, job);
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("'out.tif.checkpoint' keeps 2 of 5 days"));
    EXPECT_THAT(files(), ElementsAre("dem.tif", "out.tif.checkpoint", "whole.tif"));
    const Finished resumed = run(job);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(nlohmann::json::parse(resumed.out)["days_resumed"], 2);
    EXPECT_EQ(read("out.tif").values, read("whole.tif").values);
    EXPECT_THAT(files(), ElementsAre("dem.tif", "out.tif", "whole.tif"));
}

TEST_F(HoursCommand, GoesOnWhereItWasKilled)
{
    make(hills(40, 50));
    ASSERT_EQ(hours(kFiveDays, "whole.tif").exit_code, 0);
    Arguments job = {"hours", "dem.tif", "out.tif"};
    job.insert(job.end(), kFiveDays.begin(), kFiveDays.end());
    EXPECT_EQ(run_until({".checkpoint", 3, SIGKILL}, job).exit_code, 137);
    EXPECT_FALSE(std::filesystem::exists(path("out.tif")));
    const Finished resumed = run(job);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(nlohmann::json::parse(resumed.out)["days_resumed"], 3);
    EXPECT_EQ(read("out.tif").values, read("whole.tif").values);
}

TEST_F(HoursCommand, RefusesCheckpointsThatAreNotItsOwnOrDamaged)
{
    make(hills(40, 50));
    Arguments job = {"hours", "dem.tif", "out.tif"};
    job.insert(job.end(), kFiveDays.begin(), kFiveDays.end());
    ASSERT_EQ(run_until({".checkpoint", 1, SIGINT}, job).exit_code, 130);
    Arguments other = job;
    other.insert(other.end(), {"--limb", "lower"});
    const Finished refused = run(other);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("is of another job"));
    std::string bytes = read_file("out.tif.checkpoint");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    write_file("out.tif.checkpoint", bytes);
    const Finished damaged = run(job);
    EXPECT_EQ(damaged.exit_code, 3);
    EXPECT_THAT(damaged.err, HasSubstr("is damaged"));
    write_file("out.tif.checkpoint", "no checkpoint");
    EXPECT_EQ(run(job).exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(path("out.tif")));
}

TEST_F(HoursCommand, RefusesWhatMakesNoSense)
{
    make_flat();
    expect_refusal({}, 2, "give the days in one way");
    expect_refusal({"--date", "2026-06-21", "--from", "2026-06-01", "--to", "2026-06-02"}, 2, "in one way");
    expect_refusal({"--from", "2026-06-21"}, 2, "--from and --to need each other");
    expect_refusal({"--from", "2026-06-21", "--to", "2026-06-20"}, 2, "is before --from");
    expect_refusal({"--date", "2026-02-30"}, 2, "--date");
    expect_refusal({"--date", "2026-06-21", "--every", "2"}, 2, "--every is of the days");
    expect_refusal({"--from", "2026-06-01", "--to", "2026-06-02", "--every", "0"}, 2, "--every");
    expect_refusal({"--date", "2026-06-21", "--step", "0"}, 2, "--step must be");
    expect_refusal({"--date", "2026-06-21", "--limb", "left"}, 2, "--limb must be");
    expect_refusal({"--date", "2026-06-21", "--refine"}, 2, "--light-times");
    expect_refusal({"--dates", "2026-06-21,2026-06-22", "--light-times"}, 2, "of one day");
    expect_refusal({"--date", "1500-06-21"}, 2, "1600 to 2400");
    EXPECT_EQ(hours({"--date", "2026-06-21"}, "dem.tif").exit_code, 4);
    EXPECT_EQ(run({"hours", "nothing.tif", "out.tif", "--date", "2026-06-21"}).exit_code, 3);
}

TEST_F(HoursCommand, AsksForAPlaceWhereTheRasterHasNone)
{
    raster_test::MadeRaster flat{.rows = 4, .columns = 4};
    flat.crs = "";
    make(flat);
    expect_refusal({"--date", "2026-06-21"}, 2, "give --at LON,LAT");
    EXPECT_EQ(hours({"--date", "2026-06-21", "--at", "10,47"}).exit_code, 0);
}

} // namespace
} // namespace duskline::cli_test
