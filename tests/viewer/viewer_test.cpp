// Runs the real duskline-viewer without a window.

#include "cli/raster_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace duskline::viewer_test {
namespace {

using cli_test::Arguments;
using cli_test::Finished;
using testing::HasSubstr;
using testing::StartsWith;

class Viewer : public cli_test::RasterRun {
protected:
    void SetUp() override
    {
        make(hills(120, 150));
        const Finished trial = run({"dem.tif", "--render", "trial.png", "--size", "32x32"});
        if (trial.exit_code == 5)
            GTEST_SKIP() << trial.err;
        ASSERT_EQ(trial.exit_code, 0) << trial.err;
    }

    std::vector<float> rendered(const std::string& name, const Arguments& options = {})
    {
        Arguments arguments = {"dem.tif", "--render", name, "--size", "160x120"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return read(name).values;
    }

    void expect_error(const Arguments& arguments, int exit_code, const std::string& says)
    {
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_THAT(finished.err, StartsWith("duskline-viewer: "));
        EXPECT_THAT(finished.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
    }
};

TEST_F(Viewer, RendersWithoutAWindowTheSamePictureTwice)
{
    const auto picture = rendered("a.png");
    EXPECT_EQ(picture.size(), 160U * 120U);
    EXPECT_GT(std::set<float>(picture.begin(), picture.end()).size(), 30U);
    EXPECT_EQ(picture, rendered("b.png"));
}

TEST_F(Viewer, ShowsShadowsOfTheTechniqueAsked)
{
    const Arguments low = {"--altitude", "4", "--azimuth", "200"};
    const auto with = [&](const std::string& technique) {
        Arguments options = low;
        options.insert(options.end(), {"--technique", technique});
        return rendered(technique + ".png", options);
    };
    const auto brightness = [](const std::vector<float>& picture) {
        double sum = 0.0;
        for (const float value : picture)
            sum += static_cast<double>(value);
        return sum / static_cast<double>(picture.size());
    };
    const double lit = brightness(with("none"));
    const double exact = brightness(with("exact"));
    EXPECT_GT(lit, exact + 5.0);
    EXPECT_NEAR(brightness(with("sweep")), exact, 3.0);
}

TEST_F(Viewer, BakesMapsOfTheCompassAndOfADay)
{
    const auto with = [&](const std::string& technique, Arguments light) {
        light.insert(light.end(), {"--technique", technique});
        return rendered(technique + light[1] + ".png", light);
    };
    const Arguments on_a_map = {"--azimuth", "210", "--altitude", "6"};
    EXPECT_EQ(with("baked", on_a_map), with("exact", on_a_map));
    Arguments between = {"--azimuth", "202", "--altitude", "6"};
    const auto exact = with("exact", between);
    between.insert(between.end(), {"--light-maps", "12"});
    EXPECT_NE(with("baked", between), exact);
    const Arguments evening = {"--time", "2026-06-21T18:00-10:00", "--at", "-155.5,19.8"};
    const auto baked_evening = with("baked", evening);
    const auto exact_evening = with("exact", evening);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < exact_evening.size(); ++i)
        differing += std::abs(baked_evening[i] - exact_evening[i]) > 20.0f ? 1U : 0U;
    EXPECT_LT(differing, exact_evening.size() / 20);
    expect_error({"dem.tif", "--light-maps", "1", "--render", "p.png"}, 2, "--light-maps");
    expect_error({"dem.tif", "--light-maps", "97", "--render", "p.png"}, 2, "at most 96");
}

double mean(const std::vector<float>& picture)
{
    double sum = 0.0;
    for (const float value : picture)
        sum += static_cast<double>(value);
    return sum / static_cast<double>(picture.size());
}

TEST_F(Viewer, LampsAndSearchlightsShineByNight)
{
    const auto night = [&](const std::string& name, Arguments options) {
        options.insert(options.end(), {"--altitude", "-20", "--ambient", "0"});
        return rendered(name, options);
    };
    const double dark = mean(night("dark.png", {}));
    const double lamp = mean(night("lamp.png", {"--lamp", "500750,3999400,+60,reach=600"}));
    EXPECT_GT(lamp, dark + 5.0);
    EXPECT_LT(mean(night("short.png", {"--lamp", "500750,3999400,+60,reach=600,range=80"})), lamp - 3.0);
    const double beam =
        mean(night("beam.png", {"--searchlight", "500750,3999400,+200,45,-70,35,reach=600,colour=#ffffff"}));
    EXPECT_GT(beam, dark + 0.5);
    EXPECT_LT(beam, lamp);
    write_file("lamps.json",
               R"({"lamps": [{"on": false, "east_m": 700, "north_m": -600, "height_m": 400}]})");
    EXPECT_NEAR(mean(night("off.png", {"--state", "lamps.json"})), dark, 1e-9);
    write_file("lamps.json", R"({"lamps": [{"east_m": 700, "north_m": -600, "height_m": 400}]})");
    EXPECT_GT(mean(night("on.png", {"--state", "lamps.json"})), dark + 3.0);
}

TEST_F(Viewer, RefusesLampsThatCannotBe)
{
    const auto refused = [&](const std::string& option, const std::string& typed, const std::string& says) {
        expect_error({"dem.tif", "--render", "p.png", option, typed}, 2, says);
    };
    refused("--lamp", "500750,3999400", "must be X,Y,Z");
    refused("--lamp", "500750,3999400,+30,glow=3", "there are: strength, reach");
    refused("--lamp", "500750,3999400,+30,reach=0", "got 0");
    refused("--lamp", "400000,3999400,+30", "no ground");
    refused("--searchlight", "500750,3999400,+30,120", "AZIMUTH,ALTITUDE,HALF_ANGLE");
    refused("--searchlight", "500750,3999400,+30,120,-100,8", "-100");
    refused("--searchlight", "500750,3999400,+30,120,-10,200", "200");
    Arguments nine = {"dem.tif", "--render", "p.png"};
    for (int i = 0; i < 9; ++i)
        nine.insert(nine.end(), {"--lamp", "500750,3999400,+30"});
    expect_error(nine, 2, "at most 8");
    write_file("lamps.json", R"({"lamps": [{"beam": {"half_angle_deg": 300}}]})");
    expect_error({"dem.tif", "--render", "p.png", "--state", "lamps.json"}, 3, "half_angle_deg");
}

TEST_F(Viewer, BeginsWithASavedStateAndOptionsGoBefore)
{
    write_file("state.json",
               R"({"camera": {"east_m": 700, "north_m": -1500, "height_m": 900, "pitch_deg": -30},
                                 "light": {"azimuth_deg": 90, "altitude_deg": 10}, "technique": "none"})");
    const auto from_state = rendered("state.png", {"--state", "state.json"});
    EXPECT_NE(from_state,
              rendered("overview.png", {"--azimuth", "90", "--altitude", "10", "--technique", "none"}));
    EXPECT_NE(from_state, rendered("other.png", {"--state", "state.json", "--azimuth", "270"}));
    EXPECT_EQ(from_state, rendered("same.png", {"--state", "state.json", "--azimuth", "90"}));
}

TEST_F(Viewer, RefusesStatesThatAreWrongAndSaysWhere)
{
    write_file("broken.json", "{\"camera\": ");
    expect_error({"dem.tif", "--render", "p.png", "--state", "broken.json"}, 3, "'broken.json' is no JSON");
    write_file("pitch.json", R"({"camera": {"pitch_deg": 120}})");
    expect_error({"dem.tif", "--render", "p.png", "--state", "pitch.json"}, 3,
                 "camera: 'pitch_deg' must be a number from -90 to 90, got 120");
    write_file("technique.json", R"({"technique": "magic"})");
    expect_error({"dem.tif", "--render", "p.png", "--state", "technique.json"}, 3, "there are: none, exact");
    write_file("animation.json", R"({"animation": "jelly"})");
    expect_error({"dem.tif", "--render", "p.png", "--state", "animation.json"}, 3, "there are: crater");
    write_file("time.json", R"({"light": {"time": "noon"}})");
    expect_error({"dem.tif", "--render", "p.png", "--state", "time.json"}, 3, "'time'");
    expect_error({"dem.tif", "--render", "p.png", "--state", "missing.json"}, 3, "cannot be read");
}

TEST_F(Viewer, RefusesOptionsThatDoNotGoTogether)
{
    expect_error({"dem.tif", "--technique", "magic"}, 2, "there are: none, exact");
    expect_error({"dem.tif", "--technique", "all"}, 2, "--flyby");
    expect_error({"dem.tif", "--render", "p.png", "--flyby", "5"}, 2, "not both");
    expect_error({"dem.tif", "--report", "r.json"}, 2, "--flyby");
    expect_error({"dem.tif", "--shadow-map", "filter=blur"}, 2,
                 "--shadow-map: the shadow map's filter must be");
    expect_error({"dem.tif", "--animate", "jelly"}, 2, "there are: crater, waves, landscape");
    expect_error({"dem.tif", "--render", "p.png", "--size", "100"}, 2, "--size must be");
    expect_error({"dem.tif", "--render", "p.png", "--size", "100x99999"}, 2, "at most");
    expect_error({"dem.tif", "--nonsense"}, 2, "no option is called '--nonsense'");
    expect_error({"missing.tif", "--render", "p.png"}, 3, "missing.tif");
    expect_error({"dem.tif", "--render", "trial.png"}, 4, "--overwrite");
    expect_error({"dem.tif", "--render", "p.nothing"}, 2, "p.nothing");
}

TEST_F(Viewer, SaysWhatToDoWithoutADisplay)
{
    const Finished finished =
        run_program({"sh", "-c", "unset DISPLAY WAYLAND_DISPLAY; exec \"$DUSKLINE\" dem.tif"});
    EXPECT_EQ(finished.exit_code, 5);
    EXPECT_THAT(finished.err, HasSubstr("--render and --flyby need no display"));
}

// What the driver is told here comes from the environment, which drivers other than Mesa's do not read.
TEST_F(Viewer, SaysWhatToDoWithTooOldAnOpenGlOrNone)
{
    const auto in = [&](const std::string& environment) {
        return run_program(
            {"sh", "-c", environment + " exec \"$DUSKLINE\" dem.tif --render p.png --size 16x16"});
    };
    for (const std::string environment :
         {"MESA_GL_VERSION_OVERRIDE=4.2", "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere.json"}) {
        const Finished finished = in(environment);
        if (finished.exit_code == 0)
            GTEST_SKIP() << "this driver takes no orders";
        EXPECT_EQ(finished.exit_code, 5) << environment;
        EXPECT_THAT(finished.err, StartsWith("duskline-viewer: no device for OpenGL 4.3 without a window"));
        EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder() / "p.png"));
}

TEST_F(Viewer, HoldsOutRandomUse)
{
    const Finished finished = run({"dem.tif", "--soak", "5", "--seed", "3", "--json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(finished.out);
    EXPECT_GT(report["frames"], 5);
    EXPECT_GE(report["resident_mib"].size(), 1U);
    expect_error({"dem.tif", "--soak", "5", "--flyby", "5"}, 2, "--soak goes alone");
    expect_error({"dem.tif", "--soak", "0"}, 2, "--soak");
}

TEST_F(Viewer, ShowsThingsInTheShadowOfTheTerrain)
{
    const Arguments low = {"--azimuth", "200", "--altitude", "6"};
    const auto with = [&](const std::string& name, Arguments options) {
        options.insert(options.end(), low.begin(), low.end());
        return rendered(name, options);
    };
    const auto none = with("none.png", {});
    const auto exact = with("exact.png", {"--objects"});
    EXPECT_NE(exact, none);
    EXPECT_NE(exact, with("lit.png", {"--objects", "--technique", "none"}));
    // Beside masks the things have the sweep's shadow heights.
    EXPECT_NE(with("later.png", {"--objects", "--animate-from", "7"}), exact);
}

TEST_F(Viewer, ReportsAFlightWithEveryTechnique)
{
    const Finished finished = run({"dem.tif", "--flyby", "4", "--technique", "all", "--size", "64x48",
                                   "--altitude", "8", "--report", "report.json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(read_file("report.json"));
    EXPECT_EQ(report["frames"], 4);
    EXPECT_EQ(report["rows"], 120);
    ASSERT_GE(report["flights"].size(), 5U);
    for (const auto& flight : report["flights"]) {
        const std::string technique = flight["technique"];
        EXPECT_GT(flight["fps"]["least"].get<double>(), 0.0);
        EXPECT_LE(flight["fps"]["least"], flight["fps"]["mean"]);
        EXPECT_LE(flight["fps"]["mean"], flight["fps"]["most"]);
        EXPECT_THAT(finished.out, HasSubstr(technique));
        const double wrong = flight["wrong_share"];
        EXPECT_GE(wrong, technique == "none" ? 0.01 : 0.0);
        // A map that goes with the eye has no shadows far away, and is cast when the eye has moved.
        const bool goes_with_the_eye = technique == "shadow-map";
        const double most_wrong = goes_with_the_eye ? 0.25 : technique == "exact" ? 0.0 : 0.05;
        EXPECT_LE(wrong, technique == "none" ? 1.0 : most_wrong) << technique;
        EXPECT_EQ(flight["mean_cast_ms"] == 0.0, flight["light_at_rest"].get<bool>() && !goes_with_the_eye)
            << technique;
        EXPECT_EQ(flight["frames"], 4);
        EXPECT_EQ(flight.contains("mean_look_up_ms"), technique != "none");
        EXPECT_EQ(flight.contains("black_share"), technique.starts_with("smap"));
    }
}

TEST_F(Viewer, FliesFewerFramesWhenTimeIsShort)
{
    const Finished finished = run({"dem.tif", "--flyby", "1000", "--at-most", "1e-6", "--technique",
                                   "smap-parallel", "--size", "64x48", "--report", "report.json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(read_file("report.json"));
    EXPECT_EQ(report["frames"], 1000);
    ASSERT_EQ(report["flights"].size(), 2U);
    for (const auto& flight : report["flights"])
        EXPECT_EQ(flight["frames"], 2); // the first and the last
    expect_error({"dem.tif", "--at-most", "5"}, 2, "--flyby");
    expect_error({"dem.tif", "--flyby", "5", "--at-most", "0"}, 2, "more than 0");
}

TEST_F(Viewer, FliesAlongARecordedPathAndWritesItsPictures)
{
    write_file("flight.json",
               R"({"poses": [{"east_m": 100, "north_m": -1000, "height_m": 900, "pitch_deg": -40},
                                            {"east_m": 900, "north_m": -1000, "height_m": 900, "pitch_deg": -40}]})");
    const Finished finished = run({"dem.tif", "--flyby", "3", "--flight", "flight.json", "--size", "64x48",
                                   "--frames", ".", "--technique", "exact", "--quiet"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, "");
    const auto first = read("exact_still_0000.png").values;
    EXPECT_NE(first, read("exact_still_0002.png").values);
    EXPECT_EQ(first, read("exact_0000.png").values);
    expect_error({"dem.tif", "--flyby", "3", "--frames", "nowhere"}, 4, "no folder 'nowhere'");
    write_file("empty.json", R"({"poses": []})");
    expect_error({"dem.tif", "--flyby", "3", "--flight", "empty.json"}, 3, "at least one camera");
}

TEST_F(Viewer, ShowsGroundInMotionAtTheSecondAsked)
{
    const auto at = [&](const std::string& motion, const std::string& second) {
        return rendered(motion + second + ".png", {"--animate", motion, "--animate-from", second});
    };
    const auto at_rest = rendered("rest.png");
    EXPECT_EQ(at("waves", "0"), at_rest);
    EXPECT_NE(at("waves", "5"), at_rest);
    EXPECT_NE(at("landscape", "5"), at_rest);
    const auto crater = at("crater", "5");
    EXPECT_NE(crater, at_rest);
    EXPECT_NE(crater, at("crater", "9"));
    EXPECT_EQ(crater, at("crater", "21")); // a period later
}

// 25 frames a second: frame 2 of the flight is the second that --render shows, whatever came before it.
TEST_F(Viewer, FliesOverGroundInMotion)
{
    write_file("flight.json",
               R"({"poses": [{"east_m": 700, "north_m": -1500, "height_m": 900, "pitch_deg": -30}]})");
    write_file("state.json",
               R"({"camera": {"east_m": 700, "north_m": -1500, "height_m": 900, "pitch_deg": -30},
                                 "animation": "crater", "animation_speed": 100, "animation_s": 1})");
    const Finished finished =
        run({"dem.tif", "--flyby", "3", "--flight", "flight.json", "--state", "state.json", "--size", "64x48",
             "--frames", ".", "--technique", "all", "--report", "report.json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(read("exact_still_0000.png").values, read("exact_still_0002.png").values);
    for (const auto& flight : nlohmann::json::parse(read_file("report.json"))["flights"]) {
        EXPECT_GT(flight["mean_ground_ms"], 0.0);
        if (flight["technique"] == "exact") {
            EXPECT_EQ(flight["wrong_share"], 0.0);
        }
    }
    write_file("later.json",
               R"({"camera": {"east_m": 700, "north_m": -1500, "height_m": 900, "pitch_deg": -30},
                                 "animation": "crater", "animation_s": 9})");
    ASSERT_EQ(run({"dem.tif", "--flyby", "2", "--flight", "flight.json", "--state", "later.json", "--size",
                   "64x48", "--frames", ".", "--technique", "exact", "--overwrite"})
                  .exit_code,
              0);
    const auto later = read("exact_still_0000.png").values;
    ASSERT_EQ(run({"dem.tif", "--flyby", "3", "--flight", "flight.json", "--state", "state.json", "--size",
                   "64x48", "--frames", ".", "--technique", "exact", "--overwrite"})
                  .exit_code,
              0);
    EXPECT_EQ(read("exact_still_0002.png").values, later);
}

TEST_F(Viewer, ExplainsItself)
{
    const Finished help = run({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, StartsWith("duskline-viewer: "));
    EXPECT_THAT(help.out, HasSubstr("--flyby FRAMES"));
    EXPECT_THAT(run({"--version"}).out, StartsWith("duskline-viewer "));
}

} // namespace
} // namespace duskline::viewer_test
