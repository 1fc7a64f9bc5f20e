#include "terrains.h"

#include <duskline/casting/ray.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/products/sun_hours.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace std::chrono_literals;
using namespace angle_literals;

const UtcTime kSunrise = parse_date_time("2026-03-20T06:00Z").utc;

// The sun of the equator on the equinox: up in the east, straight overhead after six hours, down in the west.
std::vector<SunSample> equinox_suns(std::chrono::seconds step)
{
    std::vector<SunSample> suns;
    for (UtcTime from = kSunrise; from < kSunrise + 12h; from += step) {
        const TimeSpan span = {from, from + step};
        const double turned_deg =
            15.0 * std::chrono::duration<double, std::ratio<3600>>(span.middle() - kSunrise).count();
        suns.push_back({span,
                        span.middle(),
                        {.azimuth = turned_deg < 90.0 ? 90_deg : 270_deg,
                         .altitude = Angle::from_degrees(std::min(turned_deg, 180.0 - turned_deg))}});
    }
    return suns;
}

SunSeconds sunlight_on(const Terrain& terrain, const std::vector<SunSample>& suns,
                       const Execution& execution = {})
{
    TerrainShadows shadows(terrain, execution);
    SunSeconds seconds(terrain.heights_m.rows(), terrain.heights_m.columns(), 0U);
    add_sunlight(shadows, suns, seconds, execution);
    return seconds;
}

struct WholeCourse {
    explicit WholeCourse(const Terrain& terrain, std::vector<SunSample> suns)
        : course(terrain, std::move(suns)), rays(terrain), rows(terrain.heights_m.rows())
    {
        course.cast();
    }
    SunTimes coarse() const { return course.times(0, rows, kSunrise); }
    SunTimes refined() const { return course.times(0, rows, kSunrise, &rays); }

    SunCourse course;
    TerrainRays rays;
    std::size_t rows;
};

TEST(SunHours, OnFlatGroundAreAllOfTheDay)
{
    const Terrain plane = make_plane({.grid = {.rows = 5, .columns = 7}});
    const SunSeconds seconds = sunlight_on(plane, equinox_suns(10min));
    for (const std::uint32_t sum : seconds.values())
        EXPECT_EQ(sum, 12U * 3600U);
}

TEST(SunHours, AddUpOverDays)
{
    const Terrain plane = make_plane({.grid = {.rows = 3, .columns = 4}});
    TerrainShadows shadows(plane);
    SunSeconds seconds(3, 4, 100U);
    add_sunlight(shadows, equinox_suns(30min), seconds);
    add_sunlight(shadows, equinox_suns(20min), seconds);
    add_sunlight(shadows, {}, seconds);
    EXPECT_EQ(seconds(1, 2), 100U + 2U * 12U * 3600U);
}

TEST(SunHours, AreSixInAValleyOf45DegreesOnTheEquinoxAtTheEquator)
{
    const Terrain valley = make_valley({.grid = {.rows = 3, .columns = 401}, .slope = 45_deg});
    const SunSeconds seconds = sunlight_on(valley, equinox_suns(1min));
    EXPECT_NEAR(seconds(1, 200), 6.0 * 3600.0, 61.0);
    const WholeCourse whole(valley, equinox_suns(5min));
    const SunTimes times = whole.refined();
    EXPECT_NEAR(times.hours(1, 200), 6.0, 10.0 / 3600.0);
    EXPECT_NEAR(times.first(1, 200), 3.0, 5.0 / 3600.0);
    EXPECT_NEAR(times.last(1, 200), 9.0, 5.0 / 3600.0);
}

TEST(SunHours, OfOtherValleysFollowTheirSlopes)
{
    for (const double slope_deg : {15.0, 30.0, 60.0}) {
        const Terrain valley =
            make_valley({.grid = {.rows = 1, .columns = 801}, .slope = Angle::from_degrees(slope_deg)});
        const WholeCourse whole(valley, equinox_suns(5min));
        EXPECT_NEAR(whole.refined().hours(0, 400), 12.0 * (180.0 - 2.0 * slope_deg) / 180.0, 10.0 / 3600.0)
            << slope_deg;
        EXPECT_NEAR(whole.coarse().hours(0, 400), 12.0 * (180.0 - 2.0 * slope_deg) / 180.0, 5.0 / 60.0);
    }
}

TEST(SunTimes, FirstAndLastLightAreWhenTheSunClearsAWall)
{
    // Thin, and 10 m high: 30 m west of it the sun appears at atan(10 / 30).
    const Terrain wall = make_wall(
        {.grid = {.rows = 1, .columns = 101}, .height_m = 10.0, .thickness_m = 1.0, .length_m = 1.0});
    const WholeCourse whole(wall, equinox_suns(5min));
    const SunTimes times = whole.refined();
    const double behind_h = std::atan(10.0 / 30.0) * 180.0 / std::numbers::pi / 15.0;
    EXPECT_NEAR(times.first(0, 20), behind_h, 5.0 / 3600.0);
    EXPECT_FLOAT_EQ(times.last(0, 20), 12.0f) << "nothing in the west";
    EXPECT_FLOAT_EQ(times.first(0, 80), 0.0f);
    EXPECT_NEAR(times.last(0, 80), 12.0 - behind_h, 5.0 / 3600.0);
    EXPECT_NEAR(times.hours(0, 20), 12.0 - behind_h, 5.0 / 3600.0);
    EXPECT_NEAR(whole.coarse().first(0, 20), behind_h, 2.5 / 60.0 + 1e-6);
}

TEST(SunTimes, WithoutDataAreNoneAndWithoutSunNeither)
{
    Terrain terrain = make_plane({.grid = {.rows = 3, .columns = 41}});
    terrain.heights_m(1, 20) = -1000.0f; // a well that only the noon sun reaches, which is not among these
    terrain.heights_m(0, 3) = std::numeric_limits<float>::quiet_NaN();
    std::vector<SunSample> morning = equinox_suns(10min);
    morning.resize(20);
    const WholeCourse whole(terrain, morning);
    const SunTimes times = whole.refined();
    EXPECT_TRUE(std::isnan(times.hours(0, 3)) && std::isnan(times.first(0, 3))
                && std::isnan(times.last(0, 3)));
    EXPECT_EQ(times.hours(1, 20), 0.0f);
    EXPECT_TRUE(std::isnan(times.first(1, 20)) && std::isnan(times.last(1, 20)));
    EXPECT_FLOAT_EQ(times.last(2, 40), 200.0f / 60.0f);
}

// The slow way: a mask of the ray march for each sun.
SunSeconds marched(const Terrain& terrain, const std::vector<SunSample>& suns)
{
    SunSeconds seconds(terrain.heights_m.rows(), terrain.heights_m.columns(), 0U);
    for (const SunSample& sun : suns) {
        const ShadowMask mask = cast_by_ray(terrain, sun.light);
        for (std::size_t i = 0; i < mask.size(); ++i)
            seconds.values()[i] +=
                mask.values()[i] == Lit::yes ? static_cast<std::uint32_t>(
                    std::chrono::duration_cast<std::chrono::seconds>(sun.span.length()).count())
                                             : 0U;
    }
    return seconds;
}

TEST(SunHours, AreThoseOfTheRayMarchOnAnyTerrain)
{
    for_seeds(8, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 5, .largest = 30});
        std::vector<SunSample> suns = equinox_suns(30min);
        for (SunSample& sun : suns)
            sun.light.azimuth = Angle::from_degrees(dice.between(0.0, 360.0));
        const SunSeconds seconds = sunlight_on(terrain, suns);
        const SunSeconds expected = marched(terrain, suns);
        EXPECT_TRUE(std::ranges::equal(seconds.values(), expected.values()));
    });
}

TEST(SunTimes, RefinedChangesLieBetweenADarkSunAndALitOne)
{
    for_seeds(6, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 10, .largest = 25});
        const WholeCourse whole(terrain, equinox_suns(20min));
        const SunTimes coarse = whole.coarse();
        const SunTimes refined = whole.refined();
        for (std::size_t i = 0; i < coarse.hours.size(); ++i) {
            const float first = coarse.first.values()[i];
            if (std::isnan(first))
                continue;
            EXPECT_NEAR(refined.first.values()[i], first, 1.0 / 6.0) << i;
            EXPECT_NEAR(refined.last.values()[i], coarse.last.values()[i], 1.0 / 6.0) << i;
            EXPECT_NEAR(refined.hours.values()[i],
                        coarse.hours.values()[i] + first - refined.first.values()[i]
                            + refined.last.values()[i] - coarse.last.values()[i],
                        1e-4);
        }
    });
}

TEST(SunHours, DoNotDependOnTheNumberOfThreads)
{
    Dice dice(7);
    const Terrain terrain = random_terrain(dice, {.smallest = 50, .largest = 60});
    const SunSeconds one = sunlight_on(terrain, equinox_suns(20min), {.threads = 1});
    const SunSeconds three = sunlight_on(terrain, equinox_suns(20min), {.threads = 3});
    EXPECT_TRUE(std::ranges::equal(one.values(), three.values()));
}

TEST(SunHours, StopWhenAskedToAndReportEverySun)
{
    const Terrain plane = make_plane({.grid = {.rows = 4, .columns = 4}});
    TerrainShadows shadows(plane);
    SunSeconds seconds(4, 4, 0U);
    std::vector<double> reports;
    add_sunlight(shadows, equinox_suns(3h), seconds, {.progress = [&](double done) {
                     reports.push_back(done);
                     return true;
                 }});
    EXPECT_EQ(reports, (std::vector{0.25, 0.5, 0.75, 1.0}));
    EXPECT_THROW(add_sunlight(shadows, equinox_suns(3h), seconds, {.progress = [](double) { return false; }}),
                 Cancelled);
}

TEST(SunHours, RefuseSizesOrdersAndRowsThatDoNotFit)
{
    const Terrain plane = make_plane({.grid = {.rows = 4, .columns = 4}});
    TerrainShadows shadows(plane);
    SunSeconds small(3, 4, 0U);
    EXPECT_THROW(add_sunlight(shadows, equinox_suns(3h), small), InvalidInput);
    auto suns = equinox_suns(3h);
    std::swap(suns[0], suns[1]);
    EXPECT_THROW(SunCourse(plane, suns), InvalidInput);
    EXPECT_THROW(SunCourse(plane, equinox_suns(3h)).times(2, 3, kSunrise), InvalidInput);
}

} // namespace
} // namespace duskline
