#include "command_line.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <sstream>

namespace duskline::cli_test {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kRows = 24;
constexpr std::size_t kColumns = 40;

using Pixel = std::array<int, 3>;

// A picture as PPM files hold it.
struct Ppm {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::string bytes;

    Pixel at(std::size_t row, std::size_t column) const
    {
        const auto byte = [&](std::size_t band) {
            return static_cast<int>(
                static_cast<unsigned char>(bytes.at((row * columns + column) * 3 + band)));
        };
        return {byte(0), byte(1), byte(2)};
    }
};

Ppm parsed(const std::string& content)
{
    std::istringstream in(content);
    std::string magic;
    int most = 0;
    Ppm ppm;
    in >> magic >> ppm.columns >> ppm.rows >> most;
    EXPECT_EQ(magic, "P6");
    EXPECT_EQ(most, 255);
    ppm.bytes = content.substr(static_cast<std::size_t>(in.tellg()) + 1);
    EXPECT_EQ(ppm.bytes.size(), 3 * ppm.rows * ppm.columns);
    return ppm;
}

void expect_pixel(const Pixel& found, const Pixel& expected)
{
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(found.at(i), expected.at(i), 1) << "channel " << i;
}

class ReliefCommand : public CommandLineTest {
protected:
    // Level ground 100 m high in cells of 10 m, with a wall 20 m high along column 30 and a hole at (2, 3).
    ReliefCommand()
    {
        write_heights("wall.asc", [](std::size_t, std::size_t x) { return x == 30 ? 120.0 : 100.0; });
        write_heights("hole.asc",
                      [](std::size_t y, std::size_t x) { return y == 2 && x == 3 ? -9999.0 : 100.0; });
        write_file("brown.txt", "0 120 90 60\n");
    }

    template <typename Height>
    void write_heights(const std::string& name, const Height& height) const
    {
        std::ostringstream text;
        text << "ncols " << kColumns << "\nnrows " << kRows
             << "\nxllcorner 500000\nyllcorner 4000000\ncellsize 10\nNODATA_value -9999\n";
        for (std::size_t y = 0; y < kRows; ++y)
            for (std::size_t x = 0; x < kColumns; ++x)
                text << height(y, x) << (x + 1 < kColumns ? ' ' : '\n');
        write_file(name, text.str());
    }

    // A picture of one colour in a format that knows no place.
    void write_colours(const std::string& name, std::size_t columns, std::size_t rows, char colour) const
    {
        write_file(name, "P6\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n255\n"
                             + std::string(3 * columns * rows, colour));
    }

    Ppm draw(Arguments options) const
    {
        options.insert(options.begin(), "relief");
        options.insert(options.end(), {"out.ppm", "--overwrite"});
        const Finished finished = run(options);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return parsed(read_file("out.ppm"));
    }

    void expect_refusal(const Arguments& options, int exit_code, const std::string& why) const
    {
        Arguments arguments = {"relief", "wall.asc"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto before = files();
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_THAT(finished.err, HasSubstr(why));
        EXPECT_EQ(files(), before);
    }
};

TEST_F(ReliefCommand, ShowsLevelGroundInTheColourOfAPaletteFile)
{
    const Ppm picture = draw({"wall.asc", "--palette", "brown.txt", "--azimuth", "90", "--altitude", "45"});
    EXPECT_EQ(picture.columns, kColumns);
    EXPECT_EQ(picture.rows, kRows);
    expect_pixel(picture.at(12, 5), {120, 90, 60});
}

TEST_F(ReliefCommand, DarkensWhatLiesInTheShadowOfAWall)
{
    // 20 m at 45 degrees: two cells west of the wall.
    const Ppm picture = draw({"wall.asc", "--palette", "brown.txt", "--azimuth", "90", "--altitude", "45",
                              "--flat", "--exaggeration", "1"});
    EXPECT_LT(picture.at(12, 29).at(0), 90);
    EXPECT_GT(picture.at(12, 26).at(0), 115);
    const Ppm from_the_west = draw({"wall.asc", "--palette", "brown.txt", "--azimuth", "270", "--altitude",
                                    "45", "--flat", "--exaggeration", "1"});
    EXPECT_LT(from_the_west.at(12, 31).at(0), 90);
    EXPECT_GT(from_the_west.at(12, 34).at(0), 115);
}

TEST_F(ReliefCommand, SoftensTheEdgeOfAShadow)
{
    // A light 20 degrees wide: the half-shadow of the wall reaches from 14 m to 29 m.
    const Arguments arguments = {"wall.asc",   "--palette", "brown.txt", "--azimuth",      "90",
                                 "--altitude", "45",        "--flat",    "--exaggeration", "1",
                                 "--sun-size", "20"};
    const Ppm hard = draw(arguments);
    Arguments with_soft = arguments;
    with_soft.emplace_back("--soft");
    const Ppm soft = draw(with_soft);
    EXPECT_EQ(soft.at(12, 29), hard.at(12, 29)); // full shadow
    EXPECT_EQ(soft.at(12, 26), hard.at(12, 26)); // full light
    EXPECT_LT(soft.at(12, 28).at(0), hard.at(12, 26).at(0));
    EXPECT_GT(soft.at(12, 28).at(0), hard.at(12, 29).at(0));
}

TEST_F(ReliefCommand, MakesTheWholePictureSmaller)
{
    const Ppm picture = draw({"wall.asc", "--size", "20"});
    EXPECT_EQ(picture.columns, 20U);
    EXPECT_EQ(picture.rows, 12U);
}

TEST_F(ReliefCommand, IsTransparentWhereThereIsNoData)
{
    // ENVI keeps bytes as they are, here pixel by pixel.
    const Finished finished = run({"relief", "hole.asc", "out.img", "--of", "ENVI", "--co", "INTERLEAVE=BIP",
                                   "--palette", "brown.txt"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const std::string bytes = read_file("out.img");
    ASSERT_EQ(bytes.size(), 4 * kRows * kColumns);
    for (std::size_t i = 0; i < kRows * kColumns; ++i)
        ASSERT_EQ(bytes.at(4 * i + 3), i == 2 * kColumns + 3 ? '\0' : '\xFF') << i;
}

TEST_F(ReliefCommand, WarnsThatAFormatCannotBeTransparent)
{
    const Finished finished = run({"relief", "hole.asc", "out.jpg"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("the format has no transparency: what is without data is white"));
}

TEST_F(ReliefCommand, LaysATextureOverTheTerrain)
{
    write_colours("green.ppm", kColumns, kRows, 'd'); // 100 of 255
    const Ppm picture = draw({"wall.asc", "--texture", "green.ppm", "--azimuth", "90", "--altitude", "45"});
    expect_pixel(picture.at(12, 5), {100, 100, 100});
}

TEST_F(ReliefCommand, SumsUpWhatItDid)
{
    const Finished finished = run({"relief", "wall.asc", "out.ppm", "--palette", "atlas", "--json"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto summary = nlohmann::json::parse(finished.out);
    EXPECT_EQ(summary["command"], "relief");
    EXPECT_EQ(summary["output"], "out.ppm");
    EXPECT_EQ(summary["palette"], "atlas");
    EXPECT_EQ(summary["azimuth_deg"], 315.0);
    EXPECT_EQ(summary["altitude_deg"], 45.0);
    EXPECT_EQ(summary["columns"], kColumns);
    EXPECT_EQ(summary["rows"], kRows);
    EXPECT_GE(summary["exaggeration"].get<double>(), 1.0);
    EXPECT_THAT(summary["notes"].dump(), HasSubstr("no light was given"));
}

TEST_F(ReliefCommand, KnowsEveryPaletteOfItsHelp)
{
    const Finished help = run({"relief", "--help"});
    for (const char* name : {"natural", "atlas", "alpine", "desert", "moon", "mars", "plaster"}) {
        EXPECT_THAT(help.out, HasSubstr(std::string(name) + " ("));
        draw({"wall.asc", "--palette", name});
    }
}

TEST_F(ReliefCommand, DrawsANightByTheLightOfTheSky)
{
    const Ppm picture = draw({"wall.asc", "--palette", "brown.txt", "--azimuth", "90", "--altitude", "-5"});
    EXPECT_LT(picture.at(12, 5).at(0), 80);
    EXPECT_GT(picture.at(12, 5).at(0), 30);
}

TEST_F(ReliefCommand, RefusesOptionsThatMakeNoSense)
{
    expect_refusal({"out.png", "--palette", "purple"}, 2, "'purple' is the name of no palette");
    expect_refusal({"out.png", "--palette", "wall.asc"}, 2, "line 1 of the palette");
    expect_refusal({"out.png", "--size", "41"}, 2, "--size must be at most 40");
    expect_refusal({"out.png", "--size", "0"}, 2, "--size must be a whole number from 1 up");
    expect_refusal({"out.png", "--ambient", "1.5"}, 2, "--ambient must be from 0 to 0.99");
    expect_refusal({"out.png", "--exaggeration", "0"}, 2, "--exaggeration must be above 0");
    expect_refusal({"out.png", "--sea", "high"}, 2, "--sea must be a finite number");
    expect_refusal({"out.png", "--azimuth", "90"}, 2, "--azimuth needs --altitude");
    expect_refusal({"out.png", "--caster", "magic"}, 2, "magic");
}

TEST_F(ReliefCommand, RefusesFilesItCannotUse)
{
    expect_refusal({"out.png", "--texture", "nothing.tif"}, 3, "'nothing.tif': no such file");
    write_colours("small.ppm", 5, 5, 'd');
    expect_refusal({"out.png", "--texture", "small.ppm"}, 3, "has no georeference, and 5 rows x 5 columns");
    expect_refusal({"wall.asc"}, 4, "it is the input");
    expect_refusal({"brown.txt", "--of", "PNG"}, 4, "--overwrite");
    expect_refusal({"nowhere/out.png"}, 4, "nowhere");
}

} // namespace
} // namespace duskline::cli_test
