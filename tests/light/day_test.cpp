#include <duskline/geometry/invalid_input.h>
#include <duskline/light/day.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace std::chrono_literals;

Place place(double latitude, double longitude)
{
    return {Angle::from_degrees(longitude), Angle::from_degrees(latitude)};
}

double seconds_between(UtcTime time, std::string_view expected)
{
    return std::chrono::duration<double>(time - parse_date_time(expected).utc).count();
}

struct PublishedDay {
    double latitude, longitude;
    std::chrono::minutes utc_offset;
    const char* date;
    const char* sunrise;
    const char* sunset;
    double tolerance_s;
};

void PrintTo(const PublishedDay& day, std::ostream* out)
{
    *out << day.latitude << ' ' << day.longitude << ' ' << day.date;
}

class PublishedDays : public ::testing::TestWithParam<PublishedDay> {};

TEST_P(PublishedDays, HaveTheirSunriseAndSunset)
{
    const PublishedDay& published = GetParam();
    const SunDay day = sun_day(parse_date(published.date), published.utc_offset,
                               place(published.latitude, published.longitude));
    ASSERT_EQ(day.kind, SunDayKind::rises_or_sets);
    ASSERT_TRUE(day.sunrise && day.sunset);
    EXPECT_NEAR(seconds_between(*day.sunrise, published.sunrise), 0.0, published.tolerance_s);
    EXPECT_NEAR(seconds_between(*day.sunset, published.sunset), 0.0, published.tolerance_s);
    EXPECT_EQ(day.daylight, *day.sunset - *day.sunrise);
}

// From pvlib's tests, computed with the NREL SPA.
INSTANTIATE_TEST_SUITE_P(SolarPositionAlgorithm, PublishedDays,
                         ::testing::Values(PublishedDay{-35, 0, 0min, "1996-07-05", "1996-07-05T07:08:15Z",
                                                        "1996-07-05T17:01:04Z", 3},
                                           PublishedDay{-35, 0, 0min, "2004-12-04", "2004-12-04T04:38:57Z",
                                                        "2004-12-04T19:02:02Z", 3},
                                           PublishedDay{35, 0, 0min, "1994-01-02", "1994-01-02T07:08:12Z",
                                                        "1994-01-02T16:59:55Z", 3}));

TEST(SunDay, HasTheSunriseAndSunsetOfTheSolarPositionAlgorithmsExample)
{
    // The report gives 17:20:19 beside a sunrise on 17 October by Golden's clock. The algorithm looks at days of
    // UTC, in which that sunset is the one of the evening before: a day later the sun sets 88 s earlier.
    const Place golden = place(39.742476, -105.1786);
    EXPECT_NEAR(
        seconds_between(*sun_day(parse_date("2003-10-17"), -7h, golden).sunrise, "2003-10-17T06:12:43-07:00"),
        0.0, 3.0);
    EXPECT_NEAR(
        seconds_between(*sun_day(parse_date("2003-10-16"), -7h, golden).sunset, "2003-10-16T17:20:19-07:00"),
        0.0, 3.0);
}

// Rounded to the minute by the US Naval Observatory.
INSTANTIATE_TEST_SUITE_P(
    NavalObservatory, PublishedDays,
    ::testing::Values(
        PublishedDay{39, -105, -7h, "2015-01-02", "2015-01-02T07:19-07:00", "2015-01-02T16:49-07:00", 60},
        PublishedDay{39, -105, -7h, "2015-04-02", "2015-04-02T05:43-07:00", "2015-04-02T18:24-07:00", 60},
        PublishedDay{39, -105, -7h, "2015-08-02", "2015-08-02T05:01-07:00", "2015-08-02T19:10-07:00", 60},
        PublishedDay{39, -105, -7h, "2015-12-02", "2015-12-02T07:01-07:00", "2015-12-02T16:38-07:00", 60},
        PublishedDay{39.917, 116.383, 8h, "2015-01-02", "2015-01-02T07:36+08:00", "2015-01-02T17:00+08:00",
                     60},
        PublishedDay{39.917, 116.383, 8h, "2015-04-02", "2015-04-02T05:58+08:00", "2015-04-02T18:39+08:00",
                     60},
        PublishedDay{39.917, 116.383, 8h, "2015-08-02", "2015-08-02T05:13+08:00", "2015-08-02T19:28+08:00",
                     60},
        PublishedDay{39.917, 116.383, 8h, "2015-12-02", "2015-12-02T07:17+08:00", "2015-12-02T16:50+08:00",
                     60}));

TEST(SunDay, HasItsNoonOnTheMeridian)
{
    const Place golden = place(39.742476, -105.1786);
    const SunDay day = sun_day(parse_date("2003-10-17"), -7h, golden);
    const SunPosition noon = sun_position(day.noon, golden);
    EXPECT_NEAR(noon.azimuth.degrees(), 180.0, 0.001);
    EXPECT_EQ(noon.geometric_altitude, day.noon_altitude);
    // 12:00 - 14.64 min (equation of time) + 0.714 min (0.1786 degrees west of the zone's meridian)
    EXPECT_NEAR(seconds_between(day.noon, "2003-10-17T11:46:04-07:00"), 0.0, 3.0);
}

TEST(SunDay, SunriseAndSunsetAreAtTheHorizonOfTheConvention)
{
    const Place zermatt = place(46.0207, 7.7491);
    const SunDay day = sun_day(parse_date("2024-12-21"), 1h, zermatt);
    for (const UtcTime time : {*day.sunrise, *day.sunset})
        EXPECT_NEAR(sun_position(time, zermatt).geometric_altitude.degrees(), kSunriseAltitude.degrees(),
                    1e-4);
}

TEST(SunDay, BelongsToTheLocalDateWhateverUtcSays)
{
    // Noon in Hawaii is at 22:22 UTC and the sun sets on the next day of UTC.
    const Place mauna_kea = place(19.82, -155.47);
    const SunDay day = sun_day(parse_date("2026-06-21"), -10h, mauna_kea);
    EXPECT_EQ(local_date({day.noon, -10h}), parse_date("2026-06-21"));
    EXPECT_EQ(local_date({*day.sunset, -10h}), parse_date("2026-06-21"));
    EXPECT_EQ(local_date({*day.sunset}), parse_date("2026-06-22"));
    // A clock at another offset names the same day.
    const SunDay by_utc = sun_day(parse_date("2026-06-21"), 0h, mauna_kea);
    EXPECT_LT(std::chrono::abs(by_utc.noon - day.noon), 1ms);
}

TEST(SunDay, FollowsItsDateAllOverTheWorld)
{
    for (int longitude = -180; longitude <= 180; longitude += 15) {
        const std::chrono::minutes offset = std::chrono::hours(std::clamp(longitude / 15, -12, 12));
        const SunDay day = sun_day(parse_date("2024-09-22"), offset, place(-17, longitude));
        const double from_noon_s = seconds_between(day.noon + offset, "2024-09-22T12:00Z");
        EXPECT_LT(std::abs(from_noon_s), 10.0 * 60.0) << longitude;
        EXPECT_LT(*day.sunrise, day.noon);
        EXPECT_GT(*day.sunset, day.noon);
    }
}

TEST(SunDay, IsTwelveHoursAndSevenMinutesAtTheEquator)
{
    for (const char* date : {"2024-01-15", "2024-03-20", "2024-06-21", "2024-10-01"})
        EXPECT_NEAR(
            std::chrono::duration<double>(sun_day(parse_date(date), 0h, place(0, 0)).daylight).count(),
            (12.0 * 60.0 + 7.0) * 60.0, 60.0)
            << date;
}

TEST(SunDay, KnowsPolarDayAndPolarNight)
{
    const Place longyearbyen = place(78.2232, 15.6267);
    const SunDay summer = sun_day(parse_date("2024-06-20"), 2h, longyearbyen);
    EXPECT_EQ(summer.kind, SunDayKind::polar_day);
    EXPECT_FALSE(summer.sunrise || summer.sunset);
    EXPECT_EQ(summer.daylight, 24h);
    EXPECT_GT(summer.noon_altitude.degrees(), 35.0);

    const SunDay winter = sun_day(parse_date("2024-12-21"), 1h, longyearbyen);
    EXPECT_EQ(winter.kind, SunDayKind::polar_night);
    EXPECT_FALSE(winter.sunrise || winter.sunset);
    EXPECT_EQ(winter.daylight, 0h);
    EXPECT_LT(winter.noon_altitude.degrees(), -11.0);
}

TEST(SunDay, ChangesKindOnlyAsTheSeasonsDo)
{
    // A year at Longyearbyen: night, days, polar day, days, night; each day's light follows from the last.
    const Place longyearbyen = place(78.2232, 15.6267);
    int changes = 0;
    SunDayKind kind = SunDayKind::polar_night;
    int days[3] = {};
    for (auto date = std::chrono::sys_days(parse_date("2024-01-01"));
         date < std::chrono::sys_days(parse_date("2025-01-01")); date += std::chrono::days(1)) {
        const SunDay day = sun_day(CalendarDate(date), 1h, longyearbyen);
        changes += day.kind != kind;
        kind = day.kind;
        ++days[static_cast<int>(kind)];
        EXPECT_EQ(day.kind == SunDayKind::rises_or_sets, day.sunrise || day.sunset);
        EXPECT_EQ(day.kind == SunDayKind::polar_day, day.daylight == 24h);
        EXPECT_EQ(day.kind == SunDayKind::polar_night, day.daylight == 0h);
    }
    EXPECT_EQ(changes, 4);
    EXPECT_EQ(kind, SunDayKind::polar_night);
    // Midnight sun from about 18 April to 24 August, polar night from about 26 October to 16 February.
    EXPECT_NEAR(days[static_cast<int>(SunDayKind::polar_day)], 128, 3);
    EXPECT_NEAR(days[static_cast<int>(SunDayKind::polar_night)], 113, 3);
}

TEST(SunDay, AtThePoleTheSunRisesOnceAYear)
{
    int sunrises = 0;
    int sunsets = 0;
    for (auto date = std::chrono::sys_days(parse_date("2024-01-01"));
         date < std::chrono::sys_days(parse_date("2025-01-01")); date += std::chrono::days(1)) {
        const SunDay day = sun_day(CalendarDate(date), 0h, place(90, 0));
        sunrises += day.sunrise.has_value();
        sunsets += day.sunset.has_value();
    }
    EXPECT_EQ(sunrises, 1);
    EXPECT_EQ(sunsets, 1);
}

TEST(SunDay, RefusesAPlaceThatIsNone)
{
    EXPECT_THROW(sun_day(parse_date("2024-06-21"), 0h, place(91, 0)), InvalidInput);
}

} // namespace
} // namespace duskline
