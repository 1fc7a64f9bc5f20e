#include "terrains.h"

#include <duskline/casting/casters.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/products/day_cycle.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duskline {
namespace {

using namespace std::chrono_literals;
using namespace angle_literals;

const UtcTime kStart = parse_date_time("2026-06-21T06:00Z").utc;

Terrain some_terrain(std::uint64_t seed)
{
    Dice dice(seed);
    return random_terrain(dice, {.smallest = 40, .largest = 50});
}

TEST(EvenlySpread, HasItsEndsOrTheMiddlesOfItsParts)
{
    EXPECT_EQ(evenly_spread({kStart, kStart + 6h}, 4, Spread::ends),
              (std::vector<UtcTime>{kStart, kStart + 2h, kStart + 4h, kStart + 6h}));
    EXPECT_EQ(evenly_spread({kStart, kStart + 6h}, 3, Spread::middles),
              (std::vector<UtcTime>{kStart + 1h, kStart + 3h, kStart + 5h}));
    EXPECT_EQ(evenly_spread({kStart, kStart + 6h}, 1, Spread::middles), (std::vector<UtcTime>{kStart + 3h}));
}

TEST(EvenlySpread, RefusesWhatCannotBeSpread)
{
    EXPECT_THROW(evenly_spread({kStart, kStart + 6h}, 0, Spread::middles), InvalidInput);
    EXPECT_THROW(evenly_spread({kStart, kStart + 6h}, 1, Spread::ends), InvalidInput);
    EXPECT_THROW(evenly_spread({kStart, kStart}, 3, Spread::middles), InvalidInput);
}

TEST(Blend, IsBetweenTheMapsBeforeAndAfter)
{
    const std::vector<UtcTime> times = {kStart, kStart + 1h, kStart + 3h};
    const Blend between = blend_at(times, kStart + 90min);
    EXPECT_EQ(between.first, 1U);
    EXPECT_EQ(between.second, 2U);
    EXPECT_DOUBLE_EQ(between.weight, 0.25);
    const Blend exactly = blend_at(times, kStart + 1h);
    EXPECT_EQ(exactly.first, 1U);
    EXPECT_DOUBLE_EQ(exactly.weight, 0.0);
}

TEST(Blend, IsOneMapAloneOutsideOfAll)
{
    const std::vector<UtcTime> times = {kStart, kStart + 1h};
    EXPECT_EQ(blend_at(times, kStart - 1s).second, 0U);
    EXPECT_EQ(blend_at(times, kStart + 1h).first, 1U);
    EXPECT_EQ(blend_at(times, kStart + 2h).second, 1U);
    EXPECT_EQ(blend_at(times, kStart + 2h).weight, 0.0);
    EXPECT_THROW(blend_at({}, kStart), InvalidInput);
}

TEST(DayMaps, OfHardShadowsAreTheMaskOfExact)
{
    const Terrain terrain = some_terrain(1);
    DayMaps maps(terrain, {}, {.light = false});
    for (const double azimuth_deg : {10.0, 200.0}) {
        const DirectionalLight sun = {.azimuth = Angle::from_degrees(azimuth_deg), .altitude = 20_deg};
        const Grid<std::uint8_t> map = maps.map(sun);
        const ShadowMask mask = cast_by_exact(terrain, sun);
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const Lit lit = mask.values()[i];
            EXPECT_EQ(map.values()[i], lit == Lit::yes ? 255 : lit == Lit::no ? 0 : kNoDataInShadowMap);
        }
    }
}

TEST(DayMaps, OfSoftShadowsAreTheVisibleFractionInBytes)
{
    const Terrain terrain = some_terrain(2);
    const DirectionalLight sun = {.azimuth = 120_deg, .altitude = 15_deg};
    const Grid<std::uint8_t> map = DayMaps(terrain, {}, {.light = false, .soft = true}).map(sun);
    const VisibleFraction seen = visible_fraction(terrain, sun, caster_named("exact"));
    for (std::size_t i = 0; i < map.size(); ++i) {
        const float share = seen.values()[i];
        EXPECT_EQ(map.values()[i], std::isnan(share) ? 0 : std::lround(share * 255.0f));
    }
}

TEST(DayMaps, OfLightAreWhiteOnlyWhereTheSunIsSquareToTheGround)
{
    Terrain plane{Grid<float>(20, 20, 0.0f), {10.0, 10.0}};
    plane.heights_m(5, 5) = std::numeric_limits<float>::quiet_NaN();
    DayMapOptions options;
    options.model.ambient = 0.2;
    DayMaps maps(plane, upward_normals(plane), options);
    EXPECT_EQ(maps.map({.azimuth = 0_deg, .altitude = 90_deg})(10, 10), 255);
    EXPECT_EQ(maps.map({.azimuth = 0_deg, .altitude = 30_deg})(10, 10),
              std::lround(255.0 * (0.2 + 0.8 * 0.5)));
    EXPECT_EQ(maps.map({.azimuth = 0_deg, .altitude = -5_deg})(10, 10), std::lround(255.0 * 0.2));
    EXPECT_EQ(maps.map({.azimuth = 0_deg, .altitude = 30_deg})(5, 5), 0) << "no data";
}

TEST(DayMaps, OfLightAreDarkInCastShadows)
{
    Terrain terrain{Grid<float>(1, 60, 0.0f), {10.0, 10.0}};
    terrain.heights_m(0, 40) = 100.0f;
    for (const bool soft : {false, true}) {
        DayMapOptions options;
        options.soft = soft;
        options.model.ambient = 0.25;
        DayMaps maps(terrain, upward_normals(terrain), options);
        const Grid<std::uint8_t> map = maps.map({.azimuth = 90_deg, .altitude = 45_deg});
        EXPECT_EQ(map(0, 35), 64) << "50 m west of a wall of 100 m";
        EXPECT_GT(map(0, 20), 150) << "200 m west of it";
    }
}

TEST(DayMaps, DoNotDependOnThreadsNorOnTheSunsBefore)
{
    const Terrain terrain = some_terrain(3);
    DayMaps maps(terrain, upward_normals(terrain), {.soft = true});
    const DirectionalLight sun = {.azimuth = 250_deg, .altitude = 12_deg};
    const Grid<std::uint8_t> first = maps.map(sun, {.threads = 1});
    maps.map({.azimuth = 50_deg, .altitude = 60_deg});
    const Grid<std::uint8_t> again = maps.map(sun, {.threads = 3});
    EXPECT_TRUE(std::ranges::equal(first.values(), again.values()));
}

TEST(DayMaps, RefuseNormalsOfAnotherSizeAndAmbientLightBeyondOne)
{
    const Terrain terrain = some_terrain(4);
    EXPECT_THROW(DayMaps(terrain, {}, {.light = true}), InvalidInput);
    DayMapOptions options;
    options.model.ambient = 1.1;
    EXPECT_THROW(DayMaps(terrain, upward_normals(terrain), options), InvalidInput);
}

} // namespace
} // namespace duskline
