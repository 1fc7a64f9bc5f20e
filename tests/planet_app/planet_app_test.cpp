// Runs the real duskline-planet without a window.

#include "cli/raster_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>

namespace duskline::planet_app_test {
namespace {

using cli_test::Arguments;
using cli_test::Finished;
using testing::HasSubstr;
using testing::StartsWith;

class PlanetApp : public cli_test::RasterRun {
protected:
    void SetUp() override
    {
        setenv("DUSKLINE_DATA_DIR", DUSKLINE_DATA, 1); // NOLINT(concurrency-mt-unsafe): before anything runs
        const Finished trial =
            run({"--radius", "100", "--at", "0,0,50000", "--render", "trial.png", "--size", "32x32"});
        if (trial.exit_code == 5)
            GTEST_SKIP() << trial.err;
        ASSERT_EQ(trial.exit_code, 0) << trial.err;
    }

    std::vector<float> rendered(const std::string& name, const Arguments& options) const
    {
        Arguments arguments = {"--render", name, "--size", "96x72", "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_EQ(finished.out, "");
        return read(name).values;
    }

    void expect_error(const Arguments& arguments, int exit_code, const std::string& says) const
    {
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_THAT(finished.err, StartsWith("duskline-planet: "));
        EXPECT_THAT(finished.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
    }
};

double brightness(const std::vector<float>& picture)
{
    return std::accumulate(picture.begin(), picture.end(), 0.0) / static_cast<double>(picture.size());
}

TEST_F(PlanetApp, RendersWithoutAWindowTheSamePictureTwice)
{
    const Arguments view = {"--radius", "300", "--at", "10,20,4000", "--pitch", "-20"};
    const auto picture = rendered("a.png", view);
    EXPECT_EQ(picture.size(), 96U * 72U);
    EXPECT_GT(std::set<float>(picture.begin(), picture.end()).size(), 30U);
    EXPECT_EQ(picture, rendered("b.png", view));
}

TEST_F(PlanetApp, HasNightAndDay)
{
    const Arguments noon = {"--radius", "300", "--at", "0,0,50000", "--pitch", "-90", "--altitude", "80"};
    Arguments night = noon;
    night.back() = "-60";
    EXPECT_GT(brightness(rendered("noon.png", noon)), 4.0 * brightness(rendered("night.png", night)));
}

TEST_F(PlanetApp, LightsTheGroundByLampsAndSearchlightsAtNight)
{
    int pictures = 0;
    // By the red light in it.
    const auto with = [&](const Arguments& lamps) {
        Arguments view = {"--radius", "300",        "--at", "10,20,800", "--pitch",
                          "-90",      "--altitude", "-60",  "--square",  "24"};
        view.insert(view.end(), lamps.begin(), lamps.end());
        return brightness(rendered(std::to_string(++pictures) + ".png", view));
    };
    const double night = with({});
    const double lamp = with({"--lamp", "10,20,200,reach=300"});
    EXPECT_GT(lamp, night + 20.0);
    EXPECT_NEAR(with({"--lamp", "10,20,200,reach=300,range=150"}), night, 0.5) << "too far away";
    EXPECT_LT(with({"--lamp", "10,20,200,reach=300,colour=#0000ff"}), night + 0.1 * (lamp - night)) << "blue";
    const double beam = with({"--searchlight", "10,20,200,0,-90,30,reach=300"});
    EXPECT_GT(beam, night + 3.0);
    EXPECT_LT(beam, lamp - 3.0);
    EXPECT_NEAR(with({"--searchlight", "10,20,200,0,90,30,reach=300"}), night, 0.5) << "upwards";
    EXPECT_GT(with({"--searchlight", "10,20,200,0,-90,30,reach=300", "--searchlight",
                    "10.05,20,200,0,-90,30,reach=300"}),
              beam + 2.0)
        << "two";
}

TEST_F(PlanetApp, SetsTheShadowMapAsItIsTold)
{
    const Arguments usual = {"--radius", "300", "--at", "10,20,100", "--technique", "shadow-map"};
    Arguments overlay = usual;
    overlay.insert(overlay.end(), {"--shadow-map", "size=512,overlay=kernels"});
    EXPECT_NE(rendered("usual.png", usual), rendered("overlay.png", overlay));
}

TEST_F(PlanetApp, ReportsADescentWithEveryTechnique)
{
    const Finished finished =
        run({"--radius",      "300", "--at",        "10,20,100",   "--flydown", "4",     "--from",   "900",
             "--to",          "20",  "--technique", "all",         "--size",    "64x48", "--errors", "2",
             "--errors-step", "4",   "--report",    "report.json", "--frames",  "."});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(read_file("report.json"));
    EXPECT_EQ(report["frames"], 4);
    ASSERT_EQ(report["descents"].size(), 3U);
    for (const auto& descent : report["descents"]) {
        const std::string technique = descent["technique"];
        EXPECT_THAT(finished.out, HasSubstr(technique));
        EXPECT_LE(descent["fps"]["least"], descent["fps"]["mean"]);
        EXPECT_LE(descent["fps"]["mean"], descent["fps"]["most"]);
        EXPECT_GT(descent["mean_triangles"].get<double>(), 0.0);
        EXPECT_GT(descent["errors"]["pixels"], 100);
        EXPECT_LE(descent["errors"]["wrong_apart_share"], descent["errors"]["wrong_share"]);
        std::size_t frames = 0;
        for (const auto& band : descent["bands"])
            frames += band["frames"].get<std::size_t>();
        EXPECT_EQ(frames, 4U);
        for (const char* times : {"frame_ms", "cast_ms", "draw_ms", "shadow_ms"})
            EXPECT_LE(descent[times]["median"], descent[times]["p99"]) << technique << ' ' << times;
        // A frame is loading, which is the same for all, finding shadows and drawing.
        EXPECT_GE(descent["frame_ms"]["mean"].get<double>() + 1e-6,
                  report["load_ms"]["mean"].get<double>() + descent["cast_ms"]["mean"].get<double>()
                      + descent["draw_ms"]["mean"].get<double>());
        EXPECT_NE(read(technique + "_0000.png").values, read(technique + "_0003.png").values);
    }
}

// Variants share ground and frames: none may leave anything to the next, in whatever order they come.
TEST_F(PlanetApp, DrawsTheSameFramesTogetherAsAlone)
{
    const auto fly = [&](const std::string& technique, const std::string& folder) {
        ASSERT_EQ(run_program({"mkdir", folder}).exit_code, 0);
        const Finished finished = run({"--at",         "-155.62,20.10,100",
                                       "--heading",    "220",
                                       "--altitude",   "10",
                                       "--detail",     "0",
                                       "--square",     "30",
                                       "--flydown",    "3",
                                       "--from",       "2",
                                       "--to",         "500",
                                       "--technique",  technique,
                                       "--size",       "64x48",
                                       "--frames",     folder,
                                       "--shadow-map", "size=512",
                                       "--threads",    "1"});
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
    };
    fly("all", "together");
    for (const std::string technique : {"shadow-map", "fronts"}) {
        fly(technique, technique);
        for (const char* frame : {"0000", "0001", "0002"}) {
            const std::string name = technique + "_" + frame + ".png";
            EXPECT_EQ(read("together/" + name).values, read(technique + "/" + name).values) << name;
        }
    }
}

TEST_F(PlanetApp, FindsFrontsRightAndNoShadowsWrongInLowSun)
{
    const Finished finished = run({"--at",        "-155.6,20.08,3000",
                                   "--heading",   "250",
                                   "--pitch",     "-20",
                                   "--azimuth",   "275",
                                   "--altitude",  "8",
                                   "--detail",    "0",
                                   "--square",    "16",
                                   "--flydown",   "2",
                                   "--from",      "6",
                                   "--to",        "3000",
                                   "--technique", "all",
                                   "--size",      "96x72",
                                   "--errors",    "2",
                                   "--report",    "report.json",
                                   "--frames",    "."});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(read_file("report.json"));
    const auto wrong = [&](std::size_t i) {
        return report["descents"][i]["errors"]["wrong_share"].get<double>();
    };
    EXPECT_GT(wrong(0), 0.05);
    EXPECT_LT(wrong(1), 0.5 * wrong(0));
    EXPECT_LT(wrong(2), 0.03);
    EXPECT_LT(wrong(2), wrong(1));
    // The pictures show it.
    const auto fronts = read("fronts_0001.png").values;
    const auto map = read("shadow-map_0001.png").values;
    const double none = brightness(read("none_0001.png").values);
    EXPECT_GT(none, brightness(fronts) + 1.0);
    EXPECT_GT(none, brightness(map) + 1.0);
    double apart = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i)
        apart += static_cast<double>(std::abs(map[i] - fronts[i]));
    EXPECT_LT(apart / static_cast<double>(map.size()), 4.0);
}

TEST_F(PlanetApp, FindsTheShadowsOfLampsAsRaysDo)
{
    const Finished finished = run({"--at",          "-155.643,20.135,500",
                                   "--heading",     "180",
                                   "--pitch",       "-14",
                                   "--altitude",    "-30",
                                   "--detail",      "0",
                                   "--square",      "24",
                                   "--flydown",     "2",
                                   "--from",        "0.8",
                                   "--to",          "400",
                                   "--technique",   "none",
                                   "--size",        "96x72",
                                   "--errors",      "2",
                                   "--errors-step", "4",
                                   "--lamp",        "-155.6445,20.113,90,reach=700,range=4000",
                                   "--searchlight", "-155.643,20.135,400,180,-20,20",
                                   "--report",      "report.json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(read_file("report.json"));
    EXPECT_GT(report["lamps_ms"]["p99"], 0.0);
    ASSERT_EQ(report["lamps"].size(), 2U);
    for (const auto& lamp : report["lamps"]) {
        EXPECT_THAT(finished.out, HasSubstr(lamp["lamp"].get<std::string>()));
        EXPECT_GT(lamp["pixels"], 100);
        EXPECT_LT(lamp["wrong_share"], 0.05) << lamp["lamp"];
        EXPECT_LT(lamp["wrong_apart_share"], 0.01) << lamp["lamp"];
    }
    EXPECT_GT(report["lamps"][0]["dark_share"], 0.03);
}

TEST_F(PlanetApp, FliesAboutAtRandomWithinItsBounds)
{
    const Finished finished = run({"--radius", "300", "--soak", "2", "--seed", "3", "--json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto report = nlohmann::json::parse(finished.out);
    EXPECT_GE(report["frames"], 12);
    EXPECT_GT(report["most_tiles"], 6);
    EXPECT_GE(report["most_front_tiles"], 6);
}

TEST_F(PlanetApp, RefusesWhatIsWrongInOneLine)
{
    expect_error({"--errors", "3"}, 2, "--flydown");
    expect_error({"--soak", "1", "--flydown", "3"}, 2, "--soak");
    expect_error({"--flydown", "3", "--technique", "map-disc"}, 2, "there are: none, shadow-map, fronts");
    expect_error({"--technique", "magic"}, 2, "there are: none, shadow-map, fronts");
    expect_error({"--technique", "all"}, 2, "--flydown");
    expect_error({"--shadow-map", "filter=blur"}, 2, "--shadow-map: the shadow map's filter must be");
    expect_error({"--lamp", "10,20"}, 2, "--lamp must be LON,LAT,HEIGHT[,NAME=VALUE...]");
    expect_error({"--searchlight", "10,20,30,0,0,0"}, 2,
                 "half angle of --searchlight must be from 0.5 to 179");
    Arguments many;
    for (int i = 0; i < 9; ++i)
        many.insert(many.end(), {"--lamp", "10,20,30"});
    expect_error(many, 2, "at most 8 lamps and searchlights may shine, got 9");
    expect_error({"--render", "p.png", "--flydown", "5"}, 2, "not both");
    expect_error({"--report", "r.json"}, 2, "--flydown");
    expect_error({"--flydown", "5", "--from", "0.01", "--to", "20"}, 2, "--from must be above --to");
    expect_error({"--render", "p.png", "--at", "10,20"}, 2, "LON,LAT,HEIGHT");
    expect_error({"--render", "p.png", "--at", "10,20,0"}, 2, "from 0.5");
    expect_error({"--render", "p.png", "--pitch", "91"}, 2, "--pitch must be from -90 to 90");
    expect_error({"--moon", "--radius", "5"}, 2, "--moon");
    expect_error({"--moon", "--time", "2026-06-21T12:00Z"}, 2, "--azimuth");
    expect_error({"--time", "2026-06-21T12:00Z", "--altitude", "3"}, 2, "not both");
    expect_error({"--nonsense"}, 2, "no option is called '--nonsense'");
    expect_error({"missing.tif", "--render", "p.png"}, 3, "missing.tif");
    expect_error({"--radius", "100", "--render", "trial.png"}, 4, "--overwrite");
    expect_error({"--radius", "100", "--flydown", "3", "--frames", "nowhere"}, 4, "no folder 'nowhere'");
}

TEST_F(PlanetApp, SaysWhatToDoWithoutADisplay)
{
    const Finished finished =
        run_program({"sh", "-c", "unset DISPLAY WAYLAND_DISPLAY; exec \"$DUSKLINE\" --radius 100"});
    EXPECT_EQ(finished.exit_code, 5);
    EXPECT_THAT(finished.err, HasSubstr("--render and --flydown need no display"));
}

} // namespace
} // namespace duskline::planet_app_test
