#include <duskline/geometry/invalid_input.h>
#include <duskline/light/day.h>
#include <duskline/light/sun_course.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace duskline {
namespace {

using namespace std::chrono_literals;

constexpr Place kHawaii = {Angle::from_degrees(-155.47), Angle::from_degrees(19.82)};
constexpr Place kLongyearbyen = {Angle::from_degrees(15.6), Angle::from_degrees(78.2)};

TimeSpan day_of(const char* date, const Place& place)
{
    return sun_day(parse_date(date), 0min, place).midnights;
}

TEST(SpansAboveHorizon, BeginAndEndWhereTheAltitudeChangesItsSign)
{
    const UtcTime start = parse_date_time("2026-06-21T00:00Z").utc;
    // Above from 06:00 to 18:00, but for the hour around noon.
    const auto altitude = [&](UtcTime time) {
        const double hour = std::chrono::duration<double, std::ratio<3600>>(time - start).count();
        return Angle::from_degrees(std::min(6.0 - std::abs(hour - 12.0), std::abs(hour - 12.0) - 0.5));
    };
    const auto spans = spans_above_horizon({start, start + 24h}, altitude);
    ASSERT_EQ(spans.size(), 2U);
    EXPECT_LE(std::chrono::abs(spans[0].from - (start + 6h)), 1ms);
    EXPECT_LE(std::chrono::abs(spans[0].to - (start + 11h + 30min)), 1ms);
    EXPECT_LE(std::chrono::abs(spans[1].from - (start + 12h + 30min)), 1ms);
    EXPECT_LE(std::chrono::abs(spans[1].to - (start + 18h)), 1ms);
}

TEST(SpansAboveHorizon, MayBeTheWholeOrNothing)
{
    const UtcTime start = parse_date_time("2026-06-21T00:00Z").utc;
    const TimeSpan whole = {start, start + 100min};
    const auto always = spans_above_horizon(whole, [](UtcTime) { return Angle::from_degrees(1.0); });
    ASSERT_EQ(always.size(), 1U);
    EXPECT_EQ(always[0].from, whole.from);
    EXPECT_EQ(always[0].to, whole.to);
    EXPECT_TRUE(spans_above_horizon(whole, [](UtcTime) { return Angle(); }).empty());
}

TEST(SunCourse, DaylightOfTheUpperLimbIsTheAlmanacs)
{
    for (const Place& place : {kHawaii, Place{Angle::from_degrees(8.0), Angle::from_degrees(-46.0)}}) {
        const SunDay day = sun_day(parse_date("2026-03-01"), 0min, place);
        const auto spans = daylight_spans(day.midnights, {.place = place});
        ASSERT_EQ(spans.size(), 1U);
        EXPECT_LE(std::chrono::abs(spans[0].from - *day.sunrise), 1s);
        EXPECT_LE(std::chrono::abs(spans[0].to - *day.sunset), 1s);
    }
}

TEST(SunCourse, LimbsAreARadiusOfTheDiscApart)
{
    const UtcTime time = parse_date_time("2026-06-21T08:00-10:00").utc;
    const auto light = [&](Limb limb) { return sunlight_at(time, {.place = kHawaii, .limb = limb}); };
    const double radius_deg = light(Limb::centre).angular_diameter.degrees() / 2.0;
    const double centre_deg = light(Limb::centre).altitude.degrees();
    EXPECT_DOUBLE_EQ(centre_deg, sun_position(time, kHawaii).apparent_altitude().degrees());
    EXPECT_DOUBLE_EQ(light(Limb::upper).altitude.degrees(), centre_deg + radius_deg);
    EXPECT_DOUBLE_EQ(light(Limb::lower).altitude.degrees(), centre_deg - radius_deg);
}

TEST(SunCourse, SunsStandInTheMiddleOfStretchesWithoutAGap)
{
    const TimeSpan day = day_of("2026-06-21", kHawaii);
    const auto suns = sample_sun(day, {.place = kHawaii}, 10min);
    const auto daylight = daylight_spans(day, {.place = kHawaii});
    ASSERT_FALSE(suns.empty());
    EXPECT_EQ(suns.front().span.from, daylight.front().from);
    EXPECT_EQ(suns.back().span.to, daylight.front().to);
    for (std::size_t i = 0; i < suns.size(); ++i) {
        EXPECT_EQ(suns[i].time, suns[i].span.middle());
        EXPECT_GT(suns[i].light.altitude, Angle());
        EXPECT_LE(suns[i].span.length(), 10min);
        if (i > 0) {
            EXPECT_EQ(suns[i].span.from, suns[i - 1].span.to);
        }
    }
    EXPECT_EQ(suns.front().span.length(), 1min) << "a tenth where the sun is lowest";
    EXPECT_EQ(suns[suns.size() / 2].span.length(), 10min);
}

TEST(SunCourse, ThePolarNightHasNoSunsAndThePolarDayAllDay)
{
    const SunView view = {.place = kLongyearbyen};
    EXPECT_TRUE(sample_sun(day_of("2026-12-21", kLongyearbyen), view, 30min).empty());
    const TimeSpan day = day_of("2026-06-21", kLongyearbyen);
    const auto suns = sample_sun(day, view, 30min);
    EXPECT_EQ(suns.front().span.from, day.from);
    EXPECT_EQ(suns.back().span.to, day.to);
}

TEST(SunCourse, StepsThatAreNoneAreRefused)
{
    EXPECT_THROW(sample_sun(day_of("2026-06-21", kHawaii), {.place = kHawaii}, 0min), InvalidInput);
}

} // namespace
} // namespace duskline
