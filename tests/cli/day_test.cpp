#include "stopped_run.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <set>

namespace duskline::cli_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const Arguments kOneDay = {"--date", "2026-06-21", "--utc-offset", "+01:00"};

class DayCommand : public StoppedRun {
protected:
    Arguments day(const std::string& output, const Arguments& more = {}) const
    {
        Arguments arguments = {"day", "dem.tif", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    static Arguments with_date(Arguments more)
    {
        more.insert(more.end(), kOneDay.begin(), kOneDay.end());
        return more;
    }

    void make_maps(const std::string& output, const Arguments& more) const
    {
        const Finished finished = run(day(output, more));
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
    }

    void expect_refusal(const Arguments& more, int exit_code, const std::string& says,
                        const std::string& output = "refused") const
    {
        const Finished finished = run(day(output, more));
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_THAT(finished.err, HasSubstr(says));
        EXPECT_FALSE(std::filesystem::exists(path("refused")));
    }

    nlohmann::json manifest(const std::string& name) const { return nlohmann::json::parse(read_file(name)); }

    std::vector<std::string> files_in(const std::string& folder) const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
            if (!entry.path().string().ends_with(".aux.xml"))
                names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    std::filesystem::file_time_type written(const std::string& name) const
    {
        return std::filesystem::last_write_time(path(name));
    }
};

TEST_F(DayCommand, WritesNumberedMapsAndAManifestOfThem)
{
    make(hills(50, 60));
    make_maps("maps", with_date({"-n", "4"}));
    EXPECT_THAT(files_in("maps"),
                ElementsAre("manifest.json", "map_00.png", "map_01.png", "map_02.png", "map_03.png"));
    const auto json = manifest("maps/manifest.json");
    EXPECT_EQ(json["format"], "duskline day 1");
    EXPECT_EQ(json["rows"], 50);
    EXPECT_EQ(json["columns"], 60);
    EXPECT_EQ(json["dark_outside"], true);
    ASSERT_EQ(json["maps"].size(), 4U);
    const auto& second = json["maps"][1];
    EXPECT_EQ(second["file"], "map_01.png");
    EXPECT_EQ(second["blend"]["previous"], 0);
    EXPECT_EQ(second["blend"]["next"], 2);
    EXPECT_EQ(second["blend"]["fades_in_from"], json["maps"][0]["time"]);
    EXPECT_EQ(second["blend"]["faded_out_by"], json["maps"][2]["time"]);
    EXPECT_TRUE(json["maps"][0]["blend"]["previous"].is_null());
    EXPECT_EQ(json["maps"][0]["blend"]["fades_in_from"], json["from"]);
    EXPECT_EQ(json["maps"][3]["blend"]["faded_out_by"], json["to"]);
    EXPECT_THAT(second["time"].get<std::string>(), HasSubstr("+01:00"));
    const double step_s = second["seconds"].get<double>() - json["maps"][0]["seconds"].get<double>();
    EXPECT_NEAR(json["maps"][0]["seconds"].get<double>(), step_s / 2.0, 1e-3) << "in the middle of its part";
}

TEST_F(DayCommand, MapsAreTheShadowsOfTheirTimes)
{
    make(hills(50, 60));
    make_maps("maps", with_date({"-n", "3", "--shadows"}));
    for (const auto& map : manifest("maps/manifest.json")["maps"]) {
        const std::string time = map["time_utc"];
        ASSERT_EQ(run({"shadow", "dem.tif", "mask.png", "--time", time, "--overwrite"}).exit_code, 0);
        EXPECT_EQ(read("mask.png").values, read("maps/" + map["file"].get<std::string>()).values) << time;
        const Finished sun = run({"sun", "dem.tif", "--time", time, "--json"});
        EXPECT_NEAR(map["sun"]["altitude_deg"].get<double>(),
                    nlohmann::json::parse(sun.out)["altitude_deg"].get<double>(), 0.003);
    }
}

TEST_F(DayCommand, BetweenTwoTimesTheFirstAndTheLastHaveAMapEach)
{
    make(hills(30, 40));
    make_maps("maps", {"-n", "3", "--from", "2026-06-21T09:00+01:00", "--to", "2026-06-21T11:00+01:00"});
    const auto json = manifest("maps/manifest.json");
    EXPECT_EQ(json["dark_outside"], false);
    EXPECT_EQ(json["maps"][0]["time"], "2026-06-21T09:00:00+01:00");
    EXPECT_EQ(json["maps"][1]["time"], "2026-06-21T10:00:00+01:00");
    EXPECT_EQ(json["maps"][2]["time"], "2026-06-21T11:00:00+01:00");
}

TEST_F(DayCommand, OneGeoTiffHasABandForEachMap)
{
    make(hills(50, 60));
    make_maps("day.tif", with_date({"-n", "3", "--shadows"}));
    make_maps("maps", with_date({"-n", "3", "--shadows", "--of", "GTiff"}));
    EXPECT_THAT(files(), ElementsAre("day.tif", "day.tif.json", "dem.tif", "maps"));
    const auto json = manifest("day.tif.json");
    EXPECT_EQ(json["maps"][2]["file"], "day.tif");
    EXPECT_EQ(json["maps"][2]["band"], 3);
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path("day.tif").c_str(), GDAL_OF_RASTER));
    ASSERT_EQ(dataset->GetRasterCount(), 3);
    std::vector<float> values(50U * 60U);
    std::set<float> codes;
    for (int band = 1; band <= 3; ++band) {
        GDALRasterBand& map = *dataset->GetRasterBand(band);
        EXPECT_EQ(map.GetNoDataValue(), 255.0);
        EXPECT_NE(map.GetMetadataItem("LIGHT_TIME_UTC"), nullptr);
        ASSERT_EQ(map.RasterIO(GF_Read, 0, 0, 60, 50, values.data(), 60, 50, GDT_Float32, 0, 0, nullptr),
                  CE_None);
        const ReadRaster file = read("maps/map_0" + std::to_string(band - 1) + ".tif");
        EXPECT_EQ(values, file.values);
        EXPECT_EQ(file.no_data, 255.0);
        codes.insert(values.begin(), values.end());
    }
    EXPECT_EQ(codes, (std::set<float>{0.0f, 1.0f, 255.0f}));
}

TEST_F(DayCommand, PicturesOfAllMapsLieBesideThem)
{
    make(hills(50, 60));
    make_maps("maps", with_date({"-n", "6", "--atlas", "30", "--sheet", "60", "--animation", "20"}));
    EXPECT_THAT(files_in("maps"), Contains("atlas.png"));
    EXPECT_THAT(files_in("maps"), Contains("contact_sheet.png"));
    EXPECT_EQ(read_file("maps/animation.webp").substr(8, 4), "WEBP");
    const auto json = manifest("maps/manifest.json");
    EXPECT_THAT(json["files"].dump(), HasSubstr("contact_sheet.png"));
    const ReadRaster atlas = read("maps/atlas.png");
    EXPECT_EQ(atlas.columns, 90U);
    EXPECT_EQ(atlas.rows, 50U);
    const auto& tile = json["maps"][4]["atlas"];
    EXPECT_EQ(tile["x"], 30);
    EXPECT_EQ(tile["y"], 25);
    // A pixel of the atlas is the mean of the four cells under it.
    const ReadRaster map = read("maps/map_04.png");
    const float mean = (map(20, 30) + map(20, 31) + map(21, 30) + map(21, 31)) / 4.0f;
    EXPECT_NEAR(atlas(25 + 10, 30 + 15), mean, 0.51f);
}

TEST_F(DayCommand, TheThreadsChangeNothing)
{
    make(hills(50, 60));
    make_maps("one", with_date({"-n", "5", "--soft", "-j", "1"}));
    make_maps("three", with_date({"-n", "5", "--soft", "-j", "3"}));
    for (const std::string& name : files_in("one"))
        EXPECT_EQ(read_file("one/" + name), read_file("three/" + name)) << name;
}

TEST_F(DayCommand, AKilledJobLeavesNoMapsInTheFolderAndGoesOn)
{
    make(hills(50, 60));
    make_maps("whole", with_date({"-n", "5", "--sheet", "30"}));
    const Arguments job =
        day("maps", with_date({"-n", "5", "--sheet", "30", "--resume", "--json", "-j", "1"}));
    EXPECT_EQ(run_until({"map_02.png", 1, SIGKILL}, job).exit_code, 137);
    EXPECT_THAT(files_in("maps"), ElementsAre(".duskline-day")) << "nothing that looks like a result";
    const auto first_written = written("maps/.duskline-day/map_00.png");
    const Finished resumed = run(job);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(nlohmann::json::parse(resumed.out)["kept"], 3);
    EXPECT_EQ(nlohmann::json::parse(resumed.out)["made"], 2);
    EXPECT_EQ(written("maps/map_00.png"), first_written) << "what was whole is not written again";
    EXPECT_EQ(files_in("maps"), files_in("whole"));
    for (const std::string& name : files_in("whole"))
        EXPECT_EQ(read_file("maps/" + name), read_file("whole/" + name)) << name;
}

TEST_F(DayCommand, CtrlCKeepsWhatIsDoneOnlyForAJobThatResumes)
{
    make(hills(50, 60));
    const Arguments job = day("maps", with_date({"-n", "5", "-j", "1"}));
    const Finished stopped = run_until({"map_01.png", 1, SIGINT}, job);
    EXPECT_EQ(stopped.exit_code, 130);
    EXPECT_TRUE(is_one_error_line(stopped.err));
    EXPECT_THAT(files(), ElementsAre("dem.tif"));
    Arguments resuming = job;
    resuming.insert(resuming.end(), {"--resume", "--json"});
    const Finished kept = run_until({"map_01.png", 1, SIGINT}, resuming);
    EXPECT_EQ(kept.exit_code, 130);
    EXPECT_THAT(kept.err, HasSubstr("goes on from there"));
    const Finished resumed = run(resuming);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(nlohmann::json::parse(resumed.out)["kept"], 2);
    EXPECT_THAT(files_in("maps"), Not(Contains(".duskline-day")));
}

TEST_F(DayCommand, MapsOfAnotherJobAreNotTakenForItsOwn)
{
    make(hills(50, 60));
    EXPECT_EQ(
        run_until({"map_02.png", 1, SIGKILL}, day("maps", with_date({"-n", "5", "--resume", "-j", "1"})))
            .exit_code,
        137);
    const Finished other = run(day("maps", with_date({"-n", "5", "--resume", "--soft", "--json"})));
    ASSERT_EQ(other.exit_code, 0) << other.err;
    EXPECT_EQ(nlohmann::json::parse(other.out)["kept"], 0);
}

TEST_F(DayCommand, ACompleteJobIsNotDoneAgain)
{
    make(hills(50, 60));
    const Arguments job = day("maps", with_date({"-n", "3", "--resume", "--json"}));
    ASSERT_EQ(run(job).exit_code, 0);
    const auto first_written = written("maps/manifest.json");
    const Finished again = run(job);
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(nlohmann::json::parse(again.out)["kept"], 3);
    EXPECT_EQ(written("maps/manifest.json"), first_written);
    std::filesystem::remove(path("maps/map_01.png"));
    EXPECT_EQ(run(job).exit_code, 4) << "what is left may not be replaced unasked";
}

TEST_F(DayCommand, OverwritingLeavesNoMapsOfTheOldDay)
{
    make(hills(50, 60));
    make_maps("maps", with_date({"-n", "5"}));
    write_file("maps/mine.txt", "precious");
    expect_refusal(with_date({"-n", "2"}), 4, "--overwrite", "maps");
    make_maps("maps", with_date({"-n", "2", "--overwrite"}));
    EXPECT_THAT(files_in("maps"), ElementsAre("manifest.json", "map_00.png", "map_01.png", "mine.txt"));
}

TEST_F(DayCommand, StrangeFilesOfItsNamesAreNotReplaced)
{
    make(hills(50, 60));
    std::filesystem::create_directory(path("maps"));
    write_file("maps/map_01.png", "precious");
    expect_refusal(with_date({"-n", "2"}), 4, "map_01.png", "maps");
    EXPECT_EQ(read_file("maps/map_01.png"), "precious");
    EXPECT_THAT(files_in("maps"), ElementsAre("map_01.png"));
}

TEST_F(DayCommand, RefusesWhatMakesNoSense)
{
    make(hills(20, 30));
    expect_refusal({}, 2, "give the day");
    expect_refusal(with_date({"-n", "0"}), 2, "--maps must be a whole number from 1 up");
    expect_refusal(with_date({"-n", "10000"}), 2, "--maps must be at most 9999");
    expect_refusal(with_date({"--from", "2026-06-21T09:00Z"}), 2, "--date, or --from and --to");
    expect_refusal({"--from", "2026-06-21T09:00Z"}, 2, "--from and --to need each other");
    expect_refusal({"--from", "2026-06-21T09:00Z", "--to", "2026-06-21T08:00Z"}, 2, "is not after --from");
    expect_refusal({"--from", "2026-06-21T09:00Z", "--to", "2026-06-21T10:00Z", "-n", "1"}, 2, "at least 2");
    expect_refusal({"--from", "2026-06-21T09:00", "--to", "2026-06-21T10:00Z"}, 2, "--from");
    expect_refusal({"--from", "2026-06-21T23:00Z", "--to", "2026-06-22T01:00Z"}, 2, "the sun is down at all");
    expect_refusal({"--date", "2026-12-21", "--at", "15.6,78.2"}, 2, "the sun does not rise");
    expect_refusal(with_date({"--of", "JPEG"}), 2, "PNG or GTiff");
    expect_refusal(with_date({"--model", "phong"}), 2, "phong");
    expect_refusal(with_date({"--shadows", "--ambient", "0.1"}), 2, "--ambient");
    expect_refusal(with_date({"--sheet", "31"}), 2, "--sheet must be at most 30");
    expect_refusal(with_date({"--frame", "0"}), 2, "--frame must be");
    expect_refusal(with_date({"--resume"}), 2, "--resume is for maps in a folder", "refused.tif");
    expect_refusal(with_date({"--atlas", "20"}), 2, "in a folder", "refused.tif");
    expect_refusal(with_date({}), 4, "there is no folder", "nowhere/maps");
    expect_refusal(with_date({}), 4, "it is a file", "dem.tif/");
    write_file("file", "precious");
    expect_refusal(with_date({}), 4, "it is a file", "file");
    EXPECT_EQ(run({"day", "nothing.tif", "maps", "--date", "2026-06-21"}).exit_code, 3);
    EXPECT_THAT(files(), ElementsAre("dem.tif", "file"));
}

TEST_F(DayCommand, WarnsOfMapsWithoutSun)
{
    make(hills(20, 30));
    const Finished finished =
        run(day("maps", {"--from", "2026-06-21T00:00Z", "--to", "2026-06-22T00:00Z", "-n", "5"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("the sun is down at 2 of 5 times"));
}

} // namespace
} // namespace duskline::cli_test
