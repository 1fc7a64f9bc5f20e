#include <duskline/products/tint.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace duskline {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

double lightness_at(const Tint& tint, double height_m)
{
    return oklab_from(tint.ground.at(static_cast<float>(height_m)).colour).lightness;
}

double distance(Colour a, Colour b)
{
    const Oklab p = oklab_from(a);
    const Oklab q = oklab_from(b);
    return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b);
}

TEST(HeightSpan, LeavesOutNoDataAndTheFewHighestAndLowest)
{
    Grid<float> heights(100, 100);
    for (std::size_t i = 0; i < 10000; ++i)
        heights.values()[i] = static_cast<float>(i);
    heights(0, 0) = kNaN;
    const HeightSpan span = height_span({heights.view(), {}});
    EXPECT_EQ(span.lowest_m, 1.0f);
    EXPECT_EQ(span.highest_m, 9999.0f);
    EXPECT_NEAR(span.low_m, 50.0f, 2.0f);
    EXPECT_NEAR(span.high_m, 9989.0f, 2.0f);
    EXPECT_EQ(span.level_zero_share, 0.0f);
}

TEST(HeightSpan, OfNothingIsZero)
{
    const Grid<float> none(8, 8, kNaN);
    const HeightSpan span = height_span({none.view(), {}});
    EXPECT_EQ(span.lowest_m, 0.0f);
    EXPECT_EQ(span.highest_m, 0.0f);
    EXPECT_EQ(height_span(HeightField{}).high_m, 0.0f);
}

TEST(LikelySea, IsLevelGroundAtZeroOrGroundFarBelow)
{
    Grid<float> heights(100, 100, 300.0f);
    EXPECT_EQ(likely_sea(height_span({heights.view(), {}})).kind, SeaKind::none);
    heights(50, 50) = -400.0f; // the Dead Sea is no ocean
    EXPECT_EQ(likely_sea(height_span({heights.view(), {}})).kind, SeaKind::none);
    for (float& height : heights.row(7))
        height = 0.0f;
    EXPECT_EQ(likely_sea(height_span({heights.view(), {}})).kind, SeaKind::surface);
    heights(50, 50) = -4000.0f;
    EXPECT_EQ(likely_sea(height_span({heights.view(), {}})).kind, SeaKind::floor);
}

TEST(Tint, EveryNameIsFoundAndOthersAreRefusedWithTheList)
{
    for (const NamedTint& tint : named_tints())
        EXPECT_EQ(&tint_named(tint.name), &tint);
    try {
        tint_named("purple-haze");
        FAIL() << "found a tint that is not there";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("'purple-haze'"));
        for (const NamedTint& tint : named_tints())
            EXPECT_THAT(error.what(), testing::HasSubstr(std::string(tint.name)));
    }
}

TEST(Tint, SpreadsFromTheLowestLandToTheHighest)
{
    const HeightSpan span = {950.0f, 1000.0f, 4000.0f, 4100.0f, 0.0f};
    for (const NamedTint& named : named_tints()) {
        const Tint tint = fitted(named, span, {});
        EXPECT_LT(distance(tint.ground.at(1000.0f).colour, colour_from_hex(named.stops.front().rgb)), 1e-4)
            << named.name;
        EXPECT_LT(distance(tint.ground.at(4000.0f).colour, colour_from_hex(named.stops.back().rgb)), 1e-4)
            << named.name;
    }
}

TEST(Tint, PassesThroughTheColoursOfItsStops)
{
    const NamedTint& named = tint_named("atlas");
    const Tint tint = fitted(named, {0.0f, 0.0f, 10000.0f, 10000.0f, 0.0f}, {});
    for (const TintStop& stop : named.stops)
        EXPECT_LT(distance(tint.ground.at(static_cast<float>(stop.share * 10000.0)).colour,
                           colour_from_hex(stop.rgb)),
                  0.005)
            << stop.share;
}

TEST(Tint, HasNoStepsAnywhere)
{
    for (const NamedTint& named : named_tints()) {
        const Tint tint = fitted(named, {0.0f, 0.0f, 3000.0f, 3000.0f, 0.0f}, {});
        for (float height_m = 0.0f; height_m < 3000.0f; height_m += 10.0f)
            EXPECT_LT(distance(tint.ground.at(height_m).colour, tint.ground.at(height_m + 10.0f).colour),
                      0.02)
                << named.name << " at " << height_m;
    }
}

TEST(Tint, ALowCountryHasNoSnow)
{
    const NamedTint& named = tint_named("natural");
    const Tint alps = fitted(named, {0.0f, 0.0f, 4000.0f, 4000.0f, 0.0f}, {});
    const Tint holland = fitted(named, {0.0f, 0.0f, 100.0f, 100.0f, 0.0f}, {});
    EXPECT_GT(lightness_at(alps, 4000.0), 0.9);
    EXPECT_LT(lightness_at(holland, 100.0), 0.75);
}

TEST(Tint, LandBeginsAtTheSea)
{
    const NamedTint& named = tint_named("natural");
    const HeightSpan span = {-20.0f, -5.0f, 3000.0f, 3100.0f, 0.1f};
    const Tint tint = fitted(named, span, {SeaKind::surface, 0.0f});
    EXPECT_LT(distance(tint.ground.at(0.0f).colour, colour_from_hex(named.stops.front().rgb)), 1e-4);
}

TEST(Tint, TheFloorOfTheSeaDarkensWithDepthAndMeetsLandInAHardEdge)
{
    const NamedTint& named = tint_named("natural");
    const Tint tint = fitted(named, {-6000.0f, -5000.0f, 3000.0f, 3100.0f, 0.0f}, {SeaKind::floor, 0.0f});
    EXPECT_LT(distance(tint.ground.at(-0.01f).colour, colour_from_hex(named.shallow)), 0.01);
    EXPECT_LT(distance(tint.ground.at(-6000.0f).colour, colour_from_hex(named.deep)), 1e-4);
    EXPECT_LT(distance(tint.ground.at(0.0f).colour, colour_from_hex(named.stops.front().rgb)), 1e-4);
    for (double depth_m = 0.0; depth_m < 5900.0; depth_m += 100.0)
        EXPECT_GT(lightness_at(tint, -depth_m - 1.0), lightness_at(tint, -depth_m - 100.0)) << depth_m;
}

} // namespace
} // namespace duskline
