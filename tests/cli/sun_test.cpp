#include "command_line.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace duskline::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SunCommand : public CommandLineTest {
protected:
    nlohmann::json run_for_json(Arguments arguments) const
    {
        arguments.emplace(arguments.begin(), "sun");
        arguments.emplace_back("--json");
        const Finished finished = run(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return nlohmann::json::parse(finished.out);
    }
};

TEST_F(SunCommand, PrintsWhereTheSunIsAndItsDay)
{
    const Finished finished = run({"sun", "--time", "2026-06-21T18:30-10:00", "--at", "-155.47,19.82"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.err, "");
    for (const char* part : {"2026-06-21T18:30:00-10:00 seen from 19.82 N, 155.47 W", "292.6385", "6.5425",
                             "2026-06-21T05:43:5", "2026-06-21T19:03:4", "13 h 20 min"})
        EXPECT_THAT(finished.out, HasSubstr(part));
}

TEST_F(SunCommand, GivesTheExampleOfTheSolarPositionAlgorithmInJson)
{
    const auto sun = run_for_json({"--time", "2003-10-17T12:30:30-07:00", "--at", "-105.1786,39.742476",
                                   "--pressure", "820", "--temperature", "11"});
    EXPECT_EQ(sun["command"], "sun");
    EXPECT_EQ(sun["time_utc"], "2003-10-17T19:30:30Z");
    EXPECT_NEAR(sun["azimuth_deg"].get<double>(), 194.340241, 0.0003);
    EXPECT_NEAR(sun["altitude_deg"].get<double>(), 39.888378, 0.0003);
    EXPECT_NEAR(sun["geometric_altitude_deg"].get<double>(), 39.872046, 0.0003);
    EXPECT_NEAR(sun["refraction_deg"].get<double>(), 0.016332, 1e-5);
    EXPECT_NEAR(sun["equation_of_time_min"].get<double>(), 14.64, 0.01);
    EXPECT_EQ(sun["day"]["kind"], "rises_or_sets");
    EXPECT_THAT(sun["day"]["sunrise"].get<std::string>(), HasSubstr("2003-10-17T06:12:4"));
    EXPECT_TRUE(sun["warnings"].empty());
}

TEST_F(SunCommand, GivesTheDayAloneForADate)
{
    const auto sun =
        run_for_json({"--date", "2015-04-02", "--utc-offset", "+08:00", "--at", "116.383,39.917"});
    EXPECT_FALSE(sun.contains("azimuth_deg"));
    EXPECT_THAT(sun["day"]["sunrise"].get<std::string>(), HasSubstr("2015-04-02T05:5"));
    EXPECT_THAT(sun["day"]["sunset"].get<std::string>(), HasSubstr("2015-04-02T18:3"));
}

TEST_F(SunCommand, SaysPolarDayAndPolarNight)
{
    const auto summer = run_for_json({"--date", "2024-06-20", "--at", "15.6267,78.2232"});
    EXPECT_EQ(summer["day"]["kind"], "polar_day");
    EXPECT_TRUE(summer["day"]["sunrise"].is_null());
    EXPECT_DOUBLE_EQ(summer["day"]["daylight_s"].get<double>(), 86400.0);
    const Finished winter = run({"sun", "--date", "2024-12-21", "--at", "15.6267,78.2232"});
    EXPECT_EQ(winter.exit_code, 0);
    EXPECT_THAT(winter.out, HasSubstr("polar night: the sun does not rise"));
    EXPECT_THAT(winter.out, Not(HasSubstr("sunrise")));
}

TEST_F(SunCommand, WithoutAirThereIsNoRefraction)
{
    const auto sun =
        run_for_json({"--time", "2026-06-22T04:30Z", "--at", "-155.47,19.82", "--pressure", "0"});
    EXPECT_EQ(sun["refraction_deg"].get<double>(), 0.0);
    EXPECT_EQ(sun["altitude_deg"], sun["geometric_altitude_deg"]);
}

// A flat raster of 10 x 10 cells around a point of its coordinate system, as GDAL's text format.
std::string flat_raster(const std::string& crs, double x, double y, double cell)
{
    std::ostringstream text;
    text << "<VRTDataset rasterXSize='10' rasterYSize='10'><SRS>" << crs << "</SRS><GeoTransform>"
         << x - 5 * cell << ',' << cell << ",0," << y + 5 * cell << ",0," << -cell
         << "</GeoTransform><VRTRasterBand dataType='Float32' band='1'/></VRTDataset>";
    return text.str();
}

TEST_F(SunCommand, TakesPlaceAndNorthFromARaster)
{
    write_file("hawaii.vrt", flat_raster("EPSG:32605", 245000, 2168000, 75));
    const auto sun = run_for_json({"hawaii.vrt", "--time", "2026-06-21T18:30-10:00"});
    const double radians = std::acos(-1.0) / 180.0;
    const double longitude = sun["longitude_deg"].get<double>();
    const double latitude = sun["latitude_deg"].get<double>();
    EXPECT_NEAR(longitude, -155.43, 0.01);
    EXPECT_NEAR(latitude, 19.59, 0.01);
    // The convergence of a transverse Mercator projection on a sphere; zone 5 has its meridian at 153 W.
    const double convergence =
        std::atan(std::tan((longitude + 153.0) * radians) * std::sin(latitude * radians)) / radians;
    EXPECT_NEAR(sun["grid_azimuth_deg"].get<double>(), sun["azimuth_deg"].get<double>() - convergence, 0.005);
    EXPECT_GT(sun["grid_azimuth_deg"].get<double>(), sun["azimuth_deg"].get<double>() + 0.5);
}

TEST_F(SunCommand, LetsThePlaceBeAnotherThanTheRastersCentre)
{
    write_file("hawaii.vrt", flat_raster("EPSG:32605", 245000, 2168000, 75));
    const auto sun = run_for_json({"hawaii.vrt", "--at", "-156,20", "--time", "2026-06-21T18:30-10:00"});
    EXPECT_EQ(sun["longitude_deg"], -156.0);
    EXPECT_EQ(sun["latitude_deg"], 20.0);
}

TEST_F(SunCommand, KnowsNoSunOverTheMoon)
{
    write_file("moon.vrt", flat_raster("GEOGCS[\"Moon\",DATUM[\"Moon\",SPHEROID[\"Moon\",1737400,0]],"
                                       "PRIMEM[\"Reference\",0],UNIT[\"degree\",0.0174532925199433]]",
                                       -11, -43, 0.01));
    const Finished finished = run({"sun", "moon.vrt", "--time", "2026-06-21T18:30Z"});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr("another body (Moon)"));
}

TEST_F(SunCommand, NeedsAPlaceWhereTheRasterHasNone)
{
    write_file("nowhere.vrt", flat_raster("", 0, 0, 10));
    const Finished finished = run({"sun", "nowhere.vrt", "--time", "2026-06-21T18:30Z"});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr("give --at LON,LAT"));
    EXPECT_EQ(run({"sun", "nowhere.vrt", "--time", "2026-06-21T18:30Z", "--at", "0,0"}).exit_code, 0);
}

TEST_F(SunCommand, FailsWithCode3OnAnInputThatIsNone)
{
    write_file("text.tif", "not a raster");
    for (const char* input : {"missing.tif", "text.tif", "."}) {
        const Finished finished = run({"sun", input, "--time", "2026-06-21T18:30Z"});
        EXPECT_EQ(finished.exit_code, 3) << input;
        EXPECT_TRUE(is_one_error_line(finished.err)) << input;
        EXPECT_EQ(finished.out, "") << input;
    }
}

struct WrongSun {
    Arguments arguments;
    const char* says;
};

void PrintTo(const WrongSun& wrong, std::ostream* out)
{
    *out << wrong.says;
}

class SunUsage : public CommandLineTest, public ::testing::WithParamInterface<WrongSun> {};

TEST_P(SunUsage, IsRefusedOnOneLineWithCode2)
{
    Arguments arguments = GetParam().arguments;
    arguments.emplace(arguments.begin(), "sun");
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr(GetParam().says));
    EXPECT_EQ(finished.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, SunUsage,
    ::testing::Values(WrongSun{{"--time", "2026-06-21T18:30", "--at", "0,0"}, "no offset from UTC; add Z"},
                      WrongSun{{"--time", "2026-02-30T12:00Z", "--at", "0,0"}, "February 2026 has 28 days"},
                      WrongSun{{"--time", "1066-10-14T12:00Z", "--at", "0,0"}, "years 1600 to 2400"},
                      WrongSun{{"--time", "2026-06-21T18:30Z"}, "--at LON,LAT"},
                      WrongSun{{"--time", "2026-06-21T18:30Z", "--at", "19.82"},
                               "--at must be longitude,latitude"},
                      WrongSun{{"--time", "2026-06-21T18:30Z", "--at", "19.82,-155.47"},
                               "latitude of --at must be from -90 to 90"},
                      WrongSun{{"--time", "2026-06-21T18:30Z", "--at", "nan,0"}, "must be a finite number"},
                      WrongSun{{"--time", "2026-06-21T18:30Z", "--at", "0,0", "--pressure", "-1"},
                               "--pressure must be from 0"},
                      WrongSun{{"--time", "2026-06-21T18:30Z", "--date", "2026-06-21", "--at", "0,0"},
                               "--time or --date, not both"},
                      WrongSun{{"--date", "2026-06-31", "--at", "0,0"}, "June 2026 has 30 days"},
                      WrongSun{{"--date", "2026-06-21", "--utc-offset", "2", "--at", "0,0"},
                               "--utc-offset '2' is no offset"},
                      WrongSun{{"--at", "0,0"}, "give --time such as"}));

} // namespace
} // namespace duskline::cli_test
