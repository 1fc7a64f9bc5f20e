#include "raster_run.h"

#include <duskline/casting/casters.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

namespace duskline::cli_test {
namespace {

using ::testing::HasSubstr;

const Arguments kLowSun = {"--azimuth", "203", "--altitude", "12"};

// Until the program has something to do about Ctrl-C, as the system says it.
void wait_until_it_listens(pid_t process)
{
    const std::string path = "/proc/" + std::to_string(process) + "/status";
    for (int i = 0; i < 10'000; ++i) {
        std::ifstream status(path);
        for (std::string word; status >> word;) {
            std::uint64_t caught = 0;
            if (word == "SigCgt:" && status >> std::hex >> caught && (caught >> (SIGINT - 1) & 1U) != 0)
                return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    FAIL() << "the program does not listen to Ctrl-C";
}

class BenchCommand : public RasterRun {
protected:
    Finished bench(Arguments arguments) const
    {
        arguments.insert(arguments.begin(), "bench");
        return run(arguments);
    }

    nlohmann::json bench_for_json(Arguments arguments) const
    {
        arguments.emplace_back("--json");
        const Finished finished = bench(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return nlohmann::json::parse(finished.out);
    }

    // The summary of `duskline shadow` for the same light.
    nlohmann::json shadow(const std::string& caster) const
    {
        const Finished finished = run({"shadow", "dem.tif", caster + ".tif", "--azimuth", "203", "--altitude",
                                       "12", "--caster", caster, "--overwrite", "--json"});
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return nlohmann::json::parse(finished.out);
    }

    std::size_t differing_cells(const std::string& a, const std::string& b) const
    {
        const auto first = read(a + ".tif").values;
        const auto second = read(b + ".tif").values;
        std::size_t count = 0;
        for (std::size_t i = 0; i < first.size(); ++i)
            count += first[i] != second[i] ? 1U : 0U;
        return count;
    }
};

TEST_F(BenchCommand, MeasuresTheCastersThatTakeLamps)
{
    make(hills(90, 120));
    const auto bench = bench_for_json({"dem.tif", "--point", "500600,3999300,+40", "--runs", "1"});
    EXPECT_EQ(bench["lamp"]["x"], 500600.0);
    EXPECT_GT(bench["lamp"]["height_m"], 40.0);
    EXPECT_FALSE(bench.contains("azimuth_deg"));
    std::size_t casters = 0;
    for (const Caster& caster : kCasters)
        casters += caster.cast_lamp != nullptr ? 1 : 0;
    EXPECT_EQ(bench["casters"].size(), casters);
    for (const auto& caster : bench["casters"])
        if (caster_named(caster["name"].get<std::string>()).exact) {
            EXPECT_EQ(caster["differing"], 0) << caster["name"];
        }
    const Finished shadow =
        run({"shadow", "dem.tif", "lamp.tif", "--point", "500600,3999300,+40", "--caster", "ray", "--json"});
    EXPECT_EQ(bench["shadow"], nlohmann::json::parse(shadow.out)["shadow"]);
}

TEST_F(BenchCommand, TakesOneLampAndNoSunBesides)
{
    make(hills(20, 20));
    const Arguments lamp = {"dem.tif", "--point", "500600,3999300,+40"};
    const auto refused = [&](Arguments more, const char* why) {
        more.insert(more.begin(), lamp.begin(), lamp.end());
        const Finished finished = bench(more);
        EXPECT_EQ(finished.exit_code, 2);
        EXPECT_THAT(finished.err, HasSubstr(why));
    };
    refused({"--azimuth", "10", "--altitude", "5"}, "not both");
    refused({"--point", "1,2,3"}, "bench takes one --point, got 2");
    refused({"--casters", "exact,sweep"}, "'sweep' takes no point lights");
}

TEST_F(BenchCommand, SaysEverythingInJson)
{
    make(hills(90, 120));
    const auto bench = bench_for_json({"dem.tif", "--azimuth", "563", "--altitude", "12", "-j", "2"});
    EXPECT_EQ(bench["command"], "bench");
    EXPECT_EQ(bench["cells"], 90 * 120);
    EXPECT_EQ(bench["threads"], 2);
    EXPECT_EQ(bench["azimuth_deg"], 203.0);
    EXPECT_EQ(bench["truth"], "ray");
    EXPECT_GT(bench["no_data"], 0);
    EXPECT_EQ(bench["shadow"], shadow("ray")["shadow"]);
    EXPECT_FALSE(bench["kernel"].get<std::string>().empty());
    const double memcpy_ms = bench["memcpy_ms"].get<double>();
    EXPECT_GT(memcpy_ms, 0.0);

    std::vector<std::string> names;
    for (const auto& caster : bench["casters"]) {
        names.push_back(caster["name"]);
        const double median_ms = caster["median_ms"].get<double>();
        EXPECT_GT(caster["best_ms"], 0.0);
        EXPECT_LE(caster["best_ms"], median_ms);
        EXPECT_NEAR(caster["cells_per_s"].get<double>() * median_ms / 1e3, 90 * 120, 1e-3);
        EXPECT_NEAR(caster["times_memcpy"].get<double>() * memcpy_ms, median_ms, 1e-9 * median_ms);
        EXPECT_NEAR(caster["differing_share"].get<double>() * 90 * 120, caster["differing"], 1e-6);
        EXPECT_TRUE(caster.contains("peak_bytes"));
        if (caster["name"] == "fast-ray") {
            EXPECT_EQ(caster["differing"], 0);
        }
    }
    EXPECT_THAT(names, ::testing::IsSupersetOf({"ray", "fast-ray", "exact", "sweep"}));
}

TEST_F(BenchCommand, CountsTheCellsInWhichMasksDiffer)
{
    make(hills(200, 250));
    const auto bench = bench_for_json(
        {"dem.tif", "--azimuth", "203", "--altitude", "12", "--casters", "sweep,exact", "--runs", "2"});
    EXPECT_EQ(bench["truth"], "fast-ray");
    ASSERT_EQ(bench["casters"].size(), 2U);
    for (const char* caster : {"fast-ray", "sweep", "exact"})
        shadow(caster);
    const auto& sweep = bench["casters"][0];
    EXPECT_EQ(sweep["name"], "sweep");
    EXPECT_EQ(sweep["runs"], 2);
    EXPECT_GT(sweep["differing"], 0) << "nothing to count";
    EXPECT_EQ(sweep["differing"], differing_cells("sweep", "fast-ray"));
    EXPECT_EQ(sweep["false_light"].get<std::size_t>() + sweep["false_shadow"].get<std::size_t>(),
              sweep["differing"].get<std::size_t>());
    EXPECT_GE(sweep["farthest_from_edge_cells"], 1);
    EXPECT_EQ(bench["casters"][1]["differing"], differing_cells("exact", "fast-ray"));
}

TEST_F(BenchCommand, TakesTheLightAndTheRoundEarthAsShadowDoes)
{
    make(hills(90, 120));
    const Arguments sun = {"dem.tif",   "--time",      "2026-06-21T05:00+02:00",
                           "--casters", "exact",       "--runs",
                           "1",         "--curvature", "1"};
    const auto bench = bench_for_json(sun);
    const auto shadow = nlohmann::json::parse(run({"shadow", "dem.tif", "mask.tif", "--time",
                                                   "2026-06-21T05:00+02:00", "--curvature", "1", "--json"})
                                                  .out);
    for (const char* field : {"azimuth_deg", "altitude_deg", "time_utc", "shadow", "no_data", "curvature"})
        EXPECT_EQ(bench[field], shadow[field]) << field;
}

TEST_F(BenchCommand, MemoryCountsTheAnswerAtLeast)
{
    make(hills(1500, 1500));
    const auto bench = bench_for_json(
        {"dem.tif", "--azimuth", "203", "--altitude", "40", "--casters", "sweep,fast-ray", "--runs", "1"});
    const auto& sweep = bench["casters"][0]["peak_bytes"];
    const auto& fast_ray = bench["casters"][1]["peak_bytes"];
    if (sweep.is_null())
        GTEST_SKIP() << "this system does not say how much memory was in use";
    EXPECT_GT(sweep, 1500 * 1500 * 0.95);
    EXPECT_GT(fast_ray,
              1500 * 1500 * (1.0 + 4.0 / 3.0)); // its pyramid: two floats for every four cells, and more
}

TEST_F(BenchCommand, LeavesOutTheRayWhereItTakesLongAndSaysSo)
{
    make(hills(1001, 1000));
    Arguments arguments = {"dem.tif", "--runs", "1"};
    arguments.insert(arguments.end(), kLowSun.begin(), kLowSun.end());
    const auto summary = bench_for_json(arguments);
    EXPECT_EQ(summary["truth"], "fast-ray");
    for (const auto& caster : summary["casters"])
        EXPECT_NE(caster["name"], "ray");
    EXPECT_THAT(summary["notes"].dump(), HasSubstr("--casters ray"));
    EXPECT_THAT(bench(arguments).out, testing::ContainsRegex("\nray +left out on more than"));
}

TEST_F(BenchCommand, PrintsATable)
{
    make(hills(60, 70));
    const Finished finished = bench({"dem.tif", "--azimuth", "203", "--altitude", "12", "--runs", "3"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.err, "");
    EXPECT_THAT(finished.out,
                HasSubstr("dem.tif: 60 rows x 70 columns, light from azimuth 203, altitude 12"));
    EXPECT_THAT(finished.out, HasSubstr("memcpy of the heights"));
    EXPECT_THAT(finished.out, ::testing::ContainsRegex("caster +median ms +best ms +Mcells/s +x memcpy"));
    EXPECT_THAT(finished.out, ::testing::ContainsRegex("\nfast-ray .* 0 +0.0000 % +0 .* 3\n"));
    EXPECT_EQ(bench({"dem.tif", "--azimuth", "203", "--altitude", "12", "-q"}).out, "");
}

TEST_F(BenchCommand, EvenLightsThatGiveOneAnswerAreMeasured)
{
    make(hills(30, 40));
    const auto noon = bench_for_json({"dem.tif", "--azimuth", "203", "--altitude", "90", "--runs", "1"});
    EXPECT_EQ(noon["shadow"], 0);
    const auto night = bench_for_json({"dem.tif", "--azimuth", "203", "--altitude", "-3", "--runs", "1"});
    EXPECT_THAT(night["warnings"].dump(), HasSubstr("everything is dark"));
    for (const auto& caster : night["casters"])
        EXPECT_EQ(caster["differing"], 0);
}

TEST_F(BenchCommand, ProgressShowsOnATerminal)
{
    if (!has_terminals())
        GTEST_SKIP() << "no terminal can be opened on this machine";
    make(hills(60, 70));
    const Finished finished =
        run_on_terminal({"bench", "dem.tif", "--azimuth", "9", "--altitude", "9", "--runs", "1"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("0...10...20"));
    EXPECT_THAT(finished.err, ::testing::EndsWith("100 - done.\n"));
}

TEST_F(BenchCommand, StopsWhenInterrupted)
{
    make(hills(1500, 1500));
    const pid_t process = start({"bench", "dem.tif", "--azimuth", "203", "--altitude", "1", "--casters",
                                 "ray,fast-ray", "--runs", "1000"});
    wait_until_it_listens(process);
    kill(process, SIGINT);
    const Finished finished = wait_for(process);
    EXPECT_EQ(finished.exit_code, 130);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_EQ(finished.out, "");
}

struct WrongBench {
    Arguments arguments;
    const char* says;
};

void PrintTo(const WrongBench& wrong, std::ostream* out)
{
    *out << wrong.says;
}

class BenchUsage : public RasterRun, public ::testing::WithParamInterface<WrongBench> {};

TEST_P(BenchUsage, IsRefusedOnOneLineWithCode2)
{
    make(hills(10, 10));
    Arguments arguments = {"bench", "dem.tif"};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr(GetParam().says));
    EXPECT_EQ(finished.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, BenchUsage,
    ::testing::Values(
        WrongBench{{"--azimuth", "9", "--altitude", "9", "--casters", "exact,embree"},
                   "no caster is called 'embree'; there are: ray, fast-ray, exact"},
        WrongBench{{"--azimuth", "9", "--altitude", "9", "--casters", "exact,"}, "no caster is called ''"},
        WrongBench{{"--azimuth", "9", "--altitude", "9", "--runs", "0"},
                   "--runs must be a whole number from 1 up, got '0'"},
        WrongBench{{"--azimuth", "9", "--altitude", "9", "-j", "0"}, "--threads must be a whole number"},
        WrongBench{{}, "give the light"}, WrongBench{{"--azimuth", "9"}, "--azimuth needs --altitude"},
        WrongBench{{"out.tif", "--azimuth", "9", "--altitude", "9"}, "'out.tif' is one argument too many"}));

TEST_F(BenchCommand, FailsWithCode3OnAnInputThatIsNone)
{
    const Finished finished = bench({"missing.tif", "--azimuth", "9", "--altitude", "9"});
    EXPECT_EQ(finished.exit_code, 3);
    EXPECT_TRUE(is_one_error_line(finished.err));
}

} // namespace
} // namespace duskline::cli_test
