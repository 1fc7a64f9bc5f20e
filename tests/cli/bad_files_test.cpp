// Files that cannot be read or written, through the real program: each with its exit code, one line on stderr,
// and nothing half-written left behind.

#include "raster_run.h"

#include <gmock/gmock.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

namespace duskline::cli_test {
namespace {

namespace fs = std::filesystem;
using raster_test::MadeRaster;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Arguments kLight = {"--azimuth", "200", "--altitude", "12"};

Arguments shadow_of(const std::string& input, const std::string& output, const Arguments& more = {})
{
    Arguments arguments = {"shadow", input, output};
    arguments.insert(arguments.end(), kLight.begin(), kLight.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

class BadFiles : public RasterRun {
protected:
    /// The run fails with that code, one line that says `says`, and leaves the folder as it was.
    void expect_failure(const Arguments& arguments, int exit_code, const std::string& says) const
    {
        const std::vector<std::string> before = files();
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_THAT(finished.err, HasSubstr(says));
        EXPECT_EQ(finished.out, "");
        EXPECT_EQ(files(), before) << "something was left behind";
    }
};

TEST_F(BadFiles, InputThatIsNoRaster)
{
    write_file("empty.tif", "");
    write_file("text.tif", "no heights here\nnor there\n");
    fs::create_directory(path("folder"));
    for (const char* command : {"shadow", "info"}) {
        const auto arguments = [&](const std::string& input) {
            return std::string(command) == "info" ? Arguments{"info", input} : shadow_of(input, "mask.tif");
        };
        expect_failure(arguments("missing.tif"), 3, "'missing.tif': no such file");
        expect_failure(arguments("empty.tif"), 3, "is empty");
        expect_failure(arguments("text.tif"), 3, "not recognized");
        expect_failure(arguments("folder"), 3, "is a folder");
    }
}

TEST_F(BadFiles, InputThatBreaksOff)
{
    for (const char* compression : {"NONE", "DEFLATE"}) {
        MadeRaster dem = hills(700, 800);
        dem.creation_options = {"TILED=YES", std::string("COMPRESS=") + compression};
        make(dem);
        fs::resize_file(path("dem.tif"), fs::file_size(path("dem.tif")) / 2);
        for (const char* caster : {"sweep", "fast-ray"}) {
            expect_failure(shadow_of("dem.tif", "mask.tif", {"--caster", caster}), 3, "cannot be read: ");
            expect_failure(
                shadow_of("dem.tif", "mask.png", {"--caster", caster, "--heights", "--of", "GTiff"}), 3,
                "cannot be read: ");
        }
        expect_failure({"info", "dem.tif"}, 3, "cannot be read: ");
        fs::remove(path("dem.tif"));
    }
}

TEST_F(BadFiles, InputWithoutPermission)
{
    make(hills(10, 10));
    fs::permissions(path("dem.tif"), fs::perms::none);
    if (geteuid() != 0)
        return expect_failure(shadow_of("dem.tif", "mask.tif"), 3, "permission denied");
    // Root may read everything: become nobody.
    if (run_program({"setpriv", "--reuid=65534", "--clear-groups", "test", "-x", DUSKLINE_COMMAND}).exit_code
        != 0)
        GTEST_SKIP() << "this user cannot give up its rights";
    fs::permissions(folder(), fs::perms::all);
    Arguments command = {"setpriv", "--reuid=65534", "--clear-groups", DUSKLINE_COMMAND};
    const Arguments arguments = shadow_of("dem.tif", "mask.tif");
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Finished finished = run_program(command);
    EXPECT_EQ(finished.exit_code, 3) << finished.err;
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr("'dem.tif': permission denied"));
    EXPECT_THAT(files(), ElementsAre("dem.tif"));
}

TEST_F(BadFiles, InputThatHoldsNoHeights)
{
    make({.type = "Byte", .colours = {"red", "green", "blue"}}, "rgb.tif");
    make({.type = "CFloat32"}, "complex.tif");
    expect_failure(shadow_of("rgb.tif", "mask.tif"), 3, "colour picture");
    expect_failure(shadow_of("complex.tif", "mask.tif"), 3, "complex");
    make({.geotransform = std::array{0.0, 10.0, 5.0, 0.0, 0.0, -10.0}}, "sheared.tif");
    expect_failure(shadow_of("sheared.tif", "mask.tif"), 3, "gdalwarp");
    make({.geotransform = std::array{0.0, 1.0, 0.0, 90.0, 0.0, -1.0}, .crs = "EPSG:4326"}, "pole.tif");
    expect_failure(shadow_of("pole.tif", "mask.tif"), 3, "pole");
}

TEST_F(BadFiles, InputLargerThanMemory)
{
    write_file("huge.vrt",
               "<VRTDataset rasterXSize=\"2000000000\" rasterYSize=\"2000000000\"><SRS>EPSG:32633</SRS>"
               "<GeoTransform>0, 1e-5, 0, 4e6, 0, -1e-5</GeoTransform>"
               "<VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>");
    const auto start = std::chrono::steady_clock::now();
    for (const Arguments& how : {Arguments{}, Arguments{"--caster", "ray"}, Arguments{"--heights"}})
        expect_failure(shadow_of("huge.vrt", "mask.tif", how), 5, "2000000000 rows x 2000000000 columns");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30))
        << "memory is checked first";
}

TEST_F(BadFiles, OutputThatIsTheInput)
{
    make(hills(20, 30));
    const std::string before = read_file("dem.tif");
    fs::create_hard_link(path("dem.tif"), path("hard.tif"));
    fs::create_symlink("dem.tif", path("soft.tif"));
    fs::create_directory(path("sub"));
    for (const char* output : {"dem.tif", "./dem.tif", "sub/../dem.tif", "hard.tif", "soft.tif"})
        expect_failure(shadow_of("dem.tif", output, {"--overwrite"}), 4, "is the input");
    expect_failure(shadow_of("soft.tif", "dem.tif", {"--overwrite"}), 4, "is the input");
    expect_failure(shadow_of("dem.tif", fs::absolute(path("dem.tif")), {"--overwrite"}), 4, "is the input");
    EXPECT_EQ(read_file("dem.tif"), before);
}

TEST_F(BadFiles, OutputThatExists)
{
    make(hills(20, 30));
    write_file("mask.tif", "precious");
    expect_failure(shadow_of("dem.tif", "mask.tif"), 4, "--overwrite");
    EXPECT_EQ(read_file("mask.tif"), "precious");
    EXPECT_EQ(run(shadow_of("dem.tif", "mask.tif", {"--overwrite"})).exit_code, 0);
    EXPECT_EQ(read("mask.tif").rows, 20U);
}

TEST_F(BadFiles, OutputWithoutAPlace)
{
    make(hills(20, 30));
    fs::create_directory(path("folder"));
    expect_failure(shadow_of("dem.tif", "nowhere/mask.tif"), 4, "there is no folder");
    expect_failure(shadow_of("dem.tif", "dem.tif/mask.tif"), 4, "is no folder");
    expect_failure(shadow_of("dem.tif", "folder", {"--of", "GTiff", "--overwrite"}), 4, "it is a folder");
    expect_failure(shadow_of("dem.tif", "/dev/full", {"--of", "GTiff", "--overwrite"}), 4,
                   "no ordinary file");
    expect_failure(shadow_of("dem.tif", "/proc/mask.tif"), 4, "/proc");
}

TEST_F(BadFiles, OutputWithoutPermission)
{
    make(hills(10, 10));
    fs::create_directory(path("closed"));
    fs::permissions(path("closed"), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read
                                        | fs::perms::others_exec);
    if (geteuid() != 0)
        return expect_failure(shadow_of("dem.tif", "closed/mask.tif"), 4, "Permission denied");
    if (run_program({"setpriv", "--reuid=65534", "--clear-groups", "test", "-x", DUSKLINE_COMMAND}).exit_code
        != 0)
        GTEST_SKIP() << "this user cannot give up its rights";
    fs::permissions(folder(), fs::perms::all);
    fs::permissions(path("dem.tif"), fs::perms::all);
    Arguments command = {"setpriv", "--reuid=65534", "--clear-groups", DUSKLINE_COMMAND};
    const Arguments arguments = shadow_of("dem.tif", "closed/mask.tif");
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Finished finished = run_program(command);
    EXPECT_EQ(finished.exit_code, 4) << finished.err;
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr("Permission denied"));
}

struct WrongValue {
    Arguments arguments;
    const char* says;
};

TEST_F(BadFiles, ValuesThatAreWrong)
{
    make(hills(20, 30));
    make({.crs = ""}, "nowhere.tif");
    const auto with = [](const Arguments& more) {
        Arguments arguments = {"shadow", "dem.tif", "mask.tif"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    for (const WrongValue& wrong : {
             WrongValue{with({}), "give the light"},
             WrongValue{with({"--azimuth", "nan", "--altitude", "9"}), "--azimuth"},
             WrongValue{with({"--azimuth", "1e400", "--altitude", "9"}), "--azimuth"},
             WrongValue{with({"--azimuth", "9", "--altitude", "90.5"}), "--altitude"},
             WrongValue{with({"--azimuth", "9", "--altitude", "nan"}), "--altitude"},
             WrongValue{with({"--time", "2026-06-21T18:30"}), "offset"},
             WrongValue{{"shadow", "nowhere.tif", "mask.tif", "--time", "2026-06-21T18:30Z"}, "--at"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--caster", "swep"}), "'swep'; there are: ray"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"-b", "2"}), "no band 2"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"-b", "0"}), "--band"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--heights", "--classes"}), "classes"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--lit-value", "0"}), "three different"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--lit-value", "256"}), "0 to 255"},
             WrongValue{shadow_of("dem.tif", "mask.xyz123"), "--of"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--of", "GTif"}), "'GTif'"},
             WrongValue{shadow_of("dem.tif", "mask.png", {"--heights"}), "PNG cannot hold heights"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--co", "COMPRES=LZW"}), "COMPRES"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"--co", "LZW"}), "KEY=VALUE"},
             WrongValue{shadow_of("dem.tif", "mask.tif", {"-j", "0"}), "--threads"},
         })
        expect_failure(wrong.arguments, 2, wrong.says);
}

TEST_F(BadFiles, ATimeOnTheMoonIsNoTime)
{
    make({.geotransform = std::array{10.0, 0.01, 0.0, 20.0, 0.0, -0.01},
          .crs = "GEOGCS[\"Moon\",DATUM[\"Moon\",SPHEROID[\"Moon\",1737400,0]],PRIMEM[\"Reference\",0],"
                 "UNIT[\"degree\",0.0174532925199433]]"},
         "moon.tif");
    expect_failure({"shadow", "moon.tif", "mask.tif", "--time", "2026-06-21T18:30Z"}, 2, "Moon");
    EXPECT_EQ(run(shadow_of("moon.tif", "mask.tif")).exit_code, 0);
    ReadRaster mask = read("mask.tif");
    EXPECT_EQ(mask.tags["CURVATURE"], "1") << "no air bends the light";
    EXPECT_EQ(mask.tags["RADIUS_M"], "1737400");
}

// A disk that is full, in two ways.

class FullDisk : public BadFiles, public ::testing::WithParamInterface<const char*> {};

TEST_P(FullDisk, FileSizeLimitsLeaveTheOldFile)
{
    make(hills(900, 900));
    for (const char* output : {"mask.tif", "mask.png", "cog.tif"}) {
        write_file(output, "precious");
        const std::vector<std::string> before = files();
        const std::string format = std::string(output) == "cog.tif" ? " --of COG" : "";
        const Finished finished =
            run_program({"sh", "-c",
                         std::string("ulimit -f ") + GetParam() + "; exec \"$DUSKLINE\" shadow dem.tif "
                             + output + " --azimuth 200 --altitude 12 --overwrite" + format
                             + (std::string(output) == "mask.tif" ? " --co COMPRESS=NONE" : "")});
        EXPECT_EQ(finished.exit_code, 4) << output << ": " << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_EQ(read_file(output), "precious");
        EXPECT_EQ(files(), before);
    }
}

// Blocks of 512 bytes: before, and while, cells are written.
INSTANTIATE_TEST_SUITE_P(Blocks, FullDisk, ::testing::Values("1", "8", "64"));

TEST_F(BadFiles, AFullDiskLeavesTheOldFile)
{
    make(hills(900, 900));
    fs::create_directory(path("disk"));
    if (mount("none", path("disk").c_str(), "tmpfs", 0, "size=256k") != 0)
        GTEST_SKIP() << "this user cannot mount a small disk";
    const std::shared_ptr<void> unmount(nullptr,
                                        [this](void*) { umount2(path("disk").c_str(), MNT_DETACH); });
    write_file("disk/mask.tif", "precious");
    for (const Arguments& how :
         {Arguments{"--co", "COMPRESS=NONE"}, Arguments{"--heights"},
          Arguments{"--co", "COMPRESS=NONE", "-j", "1"}, Arguments{"--of", "COG", "--co", "COMPRESS=NONE"}}) {
        Arguments more = how;
        more.emplace_back("--overwrite");
        const Finished finished = run(shadow_of("dem.tif", "disk/mask.tif", more));
        EXPECT_EQ(finished.exit_code, 4) << finished.err;
        EXPECT_TRUE(is_one_error_line(finished.err));
        EXPECT_EQ(read_file("disk/mask.tif"), "precious");
        std::vector<std::string> left;
        for (const auto& entry : fs::directory_iterator(path("disk")))
            left.push_back(entry.path().filename().string());
        EXPECT_THAT(left, ElementsAre("mask.tif"));
    }
}

// Stopped half-way

class Stopped : public BadFiles {
protected:
    /// Starts a long run over an old mask.tif and sends it `signal` once it writes.
    Finished stopped_by(int signal) const
    {
        make(hills(1200, 1200));
        write_file("mask.tif", "precious");
        const pid_t process = start(shadow_of("dem.tif", "mask.tif", {"--caster", "ray", "--overwrite"}));
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (staging_folders() == 0 && std::chrono::steady_clock::now() < give_up)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill(process, signal);
        return wait_for(process);
    }

    std::size_t staging_folders() const
    {
        std::size_t count = 0;
        for (const std::string& name : files())
            count += name.starts_with(".duskline-") ? 1U : 0U;
        return count;
    }
};

TEST_F(Stopped, ByCtrlCItCleansUpAndSaysSo)
{
    const Finished finished = stopped_by(SIGINT);
    EXPECT_EQ(finished.exit_code, 130);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_EQ(read_file("mask.tif"), "precious");
    EXPECT_THAT(files(), ElementsAre("dem.tif", "mask.tif"));
}

TEST_F(Stopped, BySigtermLikewise)
{
    const Finished finished = stopped_by(SIGTERM);
    EXPECT_EQ(finished.exit_code, 143);
    EXPECT_EQ(read_file("mask.tif"), "precious");
    EXPECT_THAT(files(), ElementsAre("dem.tif", "mask.tif"));
}

TEST_F(Stopped, KilledItLeavesTheOldFileWhole)
{
    const Finished finished = stopped_by(SIGKILL);
    EXPECT_EQ(finished.exit_code, 137);
    EXPECT_EQ(read_file("mask.tif"), "precious");
    EXPECT_EQ(staging_folders(), 1U) << "what a kill leaves can be recognised";
    EXPECT_EQ(files().size(), 3U);
}

} // namespace
} // namespace duskline::cli_test
