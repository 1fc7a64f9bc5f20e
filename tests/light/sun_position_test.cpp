#include <duskline/geometry/invalid_input.h>
#include <duskline/light/sun_position.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace duskline {
namespace {

using namespace angle_literals;

Place place(double latitude, double longitude, double height_m = 0.0)
{
    return {Angle::from_degrees(longitude), Angle::from_degrees(latitude), height_m};
}

UtcTime at(std::string_view text)
{
    return parse_date_time(text).utc;
}

Angle between(const DirectionalLight& a, const DirectionalLight& b)
{
    return Angle::from_radians(2.0 * std::asin(0.5 * length(direction_towards(a) - direction_towards(b))));
}

TEST(SunPosition, ReproducesTheExampleOfTheSolarPositionAlgorithm)
{
    // Reda and Andreas, NREL/TP-560-34302, appendix A.5; their own uncertainty is 0.0003 degrees.
    const SunOptions options{.air = Air{.pressure_mbar = 820.0, .temperature_c = 11.0}, .delta_t_s = 67.0};
    const UtcTime time = at("2003-10-17T12:30:30-07:00");
    const SunPosition sun = sun_position(time, place(39.742476, -105.1786, 1830.14), options);
    EXPECT_NEAR(sun.azimuth.degrees(), 194.340241, 0.0003);
    EXPECT_NEAR(sun.geometric_altitude.degrees(), 39.872046, 0.0003);
    EXPECT_NEAR(sun.refraction.degrees(), 0.016332, 1e-6);
    EXPECT_NEAR(sun.apparent_altitude().degrees(), 90.0 - 50.111622, 0.0003);
    EXPECT_NEAR(sun.distance_au, 0.9965422974, 5e-5); // theirs is from the earth's centre
    EXPECT_NEAR(sun.angular_diameter.degrees(), 2.0 * 959.63 / 3600.0 / 0.99654, 5e-5);
    EXPECT_NEAR(equation_of_time_min(time, options), 14.64, 0.005);
    EXPECT_NEAR(julian_date(time), 2452930.312847, 1e-6);
}

struct Sighting {
    const char* name;
    double latitude, longitude, height_m;
    const char* time;
    double azimuth, altitude;
    double azimuth_tolerance = 0.003; // degrees
};

void PrintTo(const Sighting& sighting, std::ostream* out)
{
    *out << sighting.name;
}

class SunSightings : public ::testing::TestWithParam<Sighting> {};

TEST_P(SunSightings, AgreeWithTheTable)
{
    const Sighting& seen = GetParam();
    const SunPosition sun = sun_position(at(seen.time), place(seen.latitude, seen.longitude, seen.height_m));
    EXPECT_NEAR(sun.geometric_altitude.degrees(), seen.altitude, 0.003);
    EXPECT_NEAR(sun.azimuth.degrees(), seen.azimuth, seen.azimuth_tolerance);
    const DirectionalLight expected{.azimuth = Angle::from_degrees(seen.azimuth),
                                    .altitude = Angle::from_degrees(seen.altitude)};
    const DirectionalLight found{.azimuth = sun.azimuth, .altitude = sun.geometric_altitude};
    EXPECT_LT(between(found, expected).degrees(), 0.0005);
}

// Computed with astropy 5.2.1 with UT1 = UTC and without refraction.
INSTANTIATE_TEST_SUITE_P(
    Astropy, SunSightings,
    ::testing::Values(
        Sighting{"Golden", 39.742476, -105.1786, 1830.14, "2003-10-17T19:30:30Z", 194.3402, 39.8720},
        Sighting{"Zurich", 47.3769, 8.5417, 408, "2024-06-21T11:30Z", 181.2715, 66.0548},
        Sighting{"Zermatt", 46.0207, 7.7491, 1608, "2024-12-21T08:30Z", 139.4370, 9.7680},
        Sighting{"Quito, near the zenith", -0.1807, -78.4678, 2850, "2024-03-20T17:20Z", 33.8778, 89.5002,
                 0.05},
        Sighting{"Sydney", -33.8688, 151.2093, 20, "2024-12-21T01:00Z", 51.6083, 74.3692},
        Sighting{"Longyearbyen, midnight sun", 78.2232, 15.6267, 10, "2024-06-20T23:00Z", 0.1644, 11.6591},
        Sighting{"Longyearbyen, polar night", 78.2232, 15.6267, 10, "2024-12-21T11:00Z", 180.9922, -11.6659},
        Sighting{"North Pole", 90, 0, 0, "2024-06-21T12:00Z", 179.5196, 23.4346},
        Sighting{"South Pole", -90, 0, 2835, "2023-03-22T23:53:46Z", 183.2542, -0.8336},
        Sighting{"Fiji east of 180", -17, 179.9999, 0, "2024-09-22T00:00Z", 353.8549, 72.6992},
        Sighting{"Fiji west of 180", -17, -179.9999, 0, "2024-09-22T00:00Z", 353.8542, 72.6992},
        Sighting{"Kathmandu", 27.7172, 85.3240, 1400, "2024-01-15T08:00+05:45", 121.8159, 11.7455},
        Sighting{"Greenwich, leap day", 51.4769, 0.0005, 47, "2024-02-29T12:00Z", 176.4251, 30.7881},
        Sighting{"Alps 2050", 46, 8, 500, "2050-07-01T12:00Z", 196.2491, 66.3718}));

// The low-precision formulas of the Astronomical Almanac (page C5), good to 0.01 degrees from 1950 to 2050: an
// answer that shares nothing with ERFA. The sun's parallax, 8.794", is applied to the altitude.
DirectionalLight sun_of_the_almanac(UtcTime time, const Place& place)
{
    const double n = julian_date(time) - 2451545.0;
    const auto mean_anomaly = Angle::from_degrees(357.528 + 0.9856003 * n);
    const auto longitude =
        Angle::from_degrees(280.460 + 0.9856474 * n + 1.915 * sine_cosine(mean_anomaly).sine
                            + 0.020 * std::sin(2.0 * mean_anomaly.radians()));
    const auto [sin_tilt, cos_tilt] = sine_cosine(Angle::from_degrees(23.439 - 0.0000004 * n));
    const auto [sin_longitude, cos_longitude] = sine_cosine(longitude);
    const auto right_ascension = Angle::from_radians(std::atan2(cos_tilt * sin_longitude, cos_longitude));
    const double sin_declination = sin_tilt * sin_longitude;
    const double cos_declination = std::sqrt(1.0 - sin_declination * sin_declination);

    const auto sidereal_time = Angle::from_degrees(std::fmod(280.46062 + 360.98564737 * n, 360.0));
    const auto [sin_hour, cos_hour] = sine_cosine(sidereal_time + place.longitude - right_ascension);
    const auto [sin_latitude, cos_latitude] = sine_cosine(place.latitude);
    const double east = -cos_declination * sin_hour;
    const double north = sin_declination * cos_latitude - cos_declination * cos_hour * sin_latitude;
    const double up = sin_declination * sin_latitude + cos_declination * cos_hour * cos_latitude;
    const double horizontal = std::hypot(east, north);
    return {.azimuth = Angle::from_radians(std::atan2(east, north)),
            .altitude = Angle::from_radians(std::atan2(up, horizontal))
                        - Angle::from_degrees(8.794 / 3600.0 * horizontal)};
}

TEST(SunPosition, AgreesWithTheFormulasOfTheAlmanacAtAnyTimeAndPlace)
{
    std::mt19937_64 random(20260621);
    std::uniform_int_distribution<std::int64_t> second(-631152000, 2524608000); // 1950 to 2050
    std::uniform_real_distribution<double> latitude(-90.0, 90.0);
    std::uniform_real_distribution<double> longitude(-180.0, 180.0);
    for (int i = 0; i < 1000; ++i) {
        const UtcTime time{std::chrono::seconds(second(random))};
        const Place where = place(latitude(random), longitude(random));
        const DirectionalLight found = sunlight(sun_position(time, where, {.air = std::nullopt}));
        EXPECT_LT(between(found, sun_of_the_almanac(time, where)).degrees(), 0.015)
            << to_iso8601({time}) << " at " << where.latitude.degrees() << ' ' << where.longitude.degrees();
    }
}

TEST(SunPosition, DoesNotChangeWhenThePlaceIsToldAnotherWay)
{
    const UtcTime time = at("2026-06-22T04:30Z");
    const SunPosition west = sun_position(time, place(19.82, -155.47));
    const SunPosition east = sun_position(time, place(19.82, 360.0 - 155.47));
    EXPECT_NEAR(west.azimuth.degrees(), east.azimuth.degrees(), 1e-9);
    EXPECT_NEAR(west.geometric_altitude.degrees(), east.geometric_altitude.degrees(), 1e-9);
}

TEST(SunPosition, IsNearestInJanuaryAndLargestThen)
{
    const SunPosition january = sun_position(at("2024-01-03T00:00Z"), place(0, 0));
    const SunPosition july = sun_position(at("2024-07-05T05:00Z"), place(0, 0));
    EXPECT_NEAR(january.distance_au, 0.98331, 6e-5);
    EXPECT_NEAR(july.distance_au, 1.01673, 6e-5);
    EXPECT_NEAR(january.angular_diameter.degrees(), 2.0 * 0.2711, 2e-4);
    EXPECT_NEAR(july.angular_diameter.degrees(), 2.0 * 0.2622, 2e-4);
}

TEST(SunPosition, RefusesPlacesAndTimesThatAreNone)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const UtcTime time = at("2024-06-21T12:00Z");
    for (const Place& wrong : {place(90.001, 0), place(-91, 0), place(nan, 0), place(0, nan), place(0, 361),
                               place(0, 0, nan), place(0, 0, 2.0e6)})
        EXPECT_THROW(sun_position(time, wrong), InvalidInput);
    EXPECT_THROW(sun_position(at("1599-12-31T23:59Z"), place(0, 0)), InvalidInput);
    EXPECT_THROW(sun_position(at("2401-01-01T00:00Z"), place(0, 0)), InvalidInput);
    EXPECT_THROW(sun_position(time, place(0, 0), {.delta_t_s = nan}), InvalidInput);
    EXPECT_THROW(sun_position(time, place(0, 0), {.air = Air{.pressure_mbar = nan}}), InvalidInput);
    EXPECT_THROW(sun_position(time, place(0, 0), {.air = Air{.temperature_c = -273.0}}), InvalidInput);
}

TEST(SunDirection, IsWhereTheSunStandsOverhead)
{
    for (const char* time : {"2026-06-21T18:30Z", "1999-01-05T03:00Z", "2030-03-20T12:00Z"}) {
        const Vector3 sun = sun_direction(at(time));
        EXPECT_NEAR(length(sun), 1.0, 1e-15);
        for (double latitude = -80.0; latitude < 81.0; latitude += 20.0)
            for (double longitude = -180.0; longitude < 180.0; longitude += 45.0) {
                const auto [sin_lat, cos_lat] = sine_cosine(Angle::from_degrees(latitude));
                const auto [sin_lon, cos_lon] = sine_cosine(Angle::from_degrees(longitude));
                const Vector3 up = {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
                const double altitude = Angle::from_radians(std::asin(dot(sun, up))).degrees();
                EXPECT_NEAR(sun_position(at(time), place(latitude, longitude)).geometric_altitude.degrees(),
                            altitude, 0.003);
            }
    }
    EXPECT_NEAR(Angle::from_radians(std::asin(sun_direction(at("2026-06-21T08:25Z")).z)).degrees(), 23.436,
                0.003); // the obliquity, within its nutation
    EXPECT_THROW(sun_direction(at("1500-01-01T00:00Z")), InvalidInput);
}

TEST(Refraction, FollowsTheFormulaOfTheSolarPositionAlgorithm)
{
    constexpr std::pair<double, double> kTable[] = {{-0.5, 0.561463}, {0, 0.483032},  {0.5, 0.416732},
                                                    {1, 0.362398},    {2, 0.282095},  {5, 0.161235},
                                                    {10, 0.090128},   {20, 0.045687}, {45, 0.016878}};
    for (const auto& [altitude, lift] : kTable)
        EXPECT_NEAR(refraction(Angle::from_degrees(altitude), Air{}).degrees(), lift, 1e-6) << altitude;
}

TEST(Refraction, EndsWhereTheUpperLimbSets)
{
    EXPECT_GT(refraction(Angle::from_degrees(-0.8333), Air{}), 0_deg);
    EXPECT_EQ(refraction(Angle::from_degrees(-0.8334), Air{}), 0_deg);
    EXPECT_EQ(refraction(Angle::from_degrees(-90.0), Air{}), 0_deg);
    EXPECT_NEAR(refraction(90_deg, Air{}).degrees(), 0.0, 1e-4);
}

TEST(Refraction, IsNoneWithoutAir)
{
    EXPECT_EQ(refraction(1_deg, Air{.pressure_mbar = 0.0}), 0_deg);
    const SunPosition sun = sun_position(at("2024-12-21T08:30Z"), place(46, 7.7), {.air = std::nullopt});
    EXPECT_EQ(sun.refraction, 0_deg);
    EXPECT_EQ(sun.apparent_altitude(), sun.geometric_altitude);
}

TEST(Sunlight, IsTurnedToTheNorthOfTheGrid)
{
    const SunPosition sun{
        .azimuth = 1_deg, .geometric_altitude = 10_deg, .refraction = 0.1_deg, .angular_diameter = 0.54_deg};
    const DirectionalLight light = sunlight(sun, Angle::from_degrees(-3.0));
    EXPECT_DOUBLE_EQ(light.azimuth.degrees(), 358.0);
    EXPECT_DOUBLE_EQ(light.altitude.degrees(), 10.1);
    EXPECT_EQ(light.angular_diameter, 0.54_deg);
}

TEST(DeltaT, FollowsEspenakAndMeeus)
{
    EXPECT_NEAR(delta_t_of_espenak_and_meeus_s(1985.0 + 1.5 / 12.0), 54.413442486, 1e-8);
    EXPECT_NEAR(delta_t_of_espenak_and_meeus_s(1900.0 + 5.5 / 12.0), -2.117, 0.001);
    EXPECT_NEAR(delta_t_of_espenak_and_meeus_s(1990.0 + 9.5 / 12.0), 57.4267, 1e-4);
}

TEST(DeltaT, HasNoStepsOfMoreThanASecondBeforeOurTime)
{
    for (const double year :
         {1700.0, 1800.0, 1860.0, 1900.0, 1920.0, 1941.0, 1961.0, 1986.0, 2005.0, 2050.0, 2150.0})
        EXPECT_NEAR(delta_t_of_espenak_and_meeus_s(year - 1e-6), delta_t_of_espenak_and_meeus_s(year), 1.0)
            << year;
}

TEST(DeltaT, CountsLeapSecondsOnceThereAreAny)
{
    EXPECT_DOUBLE_EQ(delta_t_s(at("1972-01-01T00:00Z")), 32.184 + 10.0);
    EXPECT_DOUBLE_EQ(delta_t_s(at("2003-10-17T19:30Z")), 32.184 + 32.0);
    EXPECT_DOUBLE_EQ(delta_t_s(at("2017-01-01T00:00Z")), 32.184 + 37.0);
}

} // namespace
} // namespace duskline
