#include <duskline/casting/ray.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

// A wall that runs from north to south along column 40 of level ground.
Terrain wall(float height_m, CellSize cell_size_m)
{
    Terrain terrain{Grid<float>(101, 64, 0.0f), cell_size_m};
    for (std::size_t y = 0; y < 101; ++y)
        terrain.heights_m(y, 40) = height_m;
    return terrain;
}

LitFraction cast(const HeightField& field, const DirectionalLight& light)
{
    return lit_fraction(field, shadow_heights_by_ray(field, light), light);
}

TEST(LitFraction, PlacesTheEdgeOfAShadowWithinACell)
{
    // The shadow ends 9.75 cells west of the wall: a quarter of cell 30 lies in it.
    const Terrain terrain = wall(9.75f, {1.0, 1.0});
    const LitFraction lit = cast(terrain, {.azimuth = 90_deg, .altitude = 45_deg});
    EXPECT_EQ(lit(50, 29), 1.0f);
    EXPECT_EQ(lit(50, 30), 0.75f);
    EXPECT_EQ(lit(50, 31), 0.0f);
    EXPECT_EQ(lit(50, 39), 0.0f);
    EXPECT_EQ(lit(50, 40), 1.0f);
}

TEST(LitFraction, MeasuresTheShadowOfAWallUnderObliqueLightAndOblongCells)
{
    for (const double azimuth : {90.0, 70.0, 115.0})
        for (const double altitude : {30.0, 33.0, 41.0}) {
            const Terrain terrain = wall(20.0f, {2.0, 1.5});
            const DirectionalLight light = {.azimuth = Angle::from_degrees(azimuth),
                                            .altitude = Angle::from_degrees(altitude)};
            const LitFraction lit = cast(terrain, light);
            double shaded_m = 0.0;
            for (std::size_t x = 0; x < 40; ++x)
                shaded_m += 2.0 * (1.0 - lit(50, x));
            // From the tip of the shadow to half-way between the wall and the last cell of the ground.
            const double length_m = 20.0 / tangent(light.altitude) * sine_cosine(light.azimuth).sine;
            EXPECT_NEAR(shaded_m, length_m - 1.0, 0.26) << azimuth << ", " << altitude;
        }
}

TEST(LitFraction, IsTheMaskWhereverTheNeighboursAgree)
{
    const Terrain terrain = make_mountains({.grid = {96, 80, {30.0, 30.0}}, .seed = 7});
    const DirectionalLight light = {.azimuth = 203_deg, .altitude = 15_deg};
    const ShadowMask mask = mask_of(terrain, shadow_heights_by_ray(terrain, light));
    const LitFraction lit = cast(terrain, light);
    int edges = 0;
    for (std::size_t y = 1; y + 1 < 96; ++y)
        for (std::size_t x = 1; x + 1 < 80; ++x) {
            bool agree = true;
            for (std::size_t j = y - 1; j <= y + 1; ++j)
                for (std::size_t i = x - 1; i <= x + 1; ++i)
                    agree = agree && mask(j, i) == mask(y, x);
            edges += agree ? 0 : 1;
            const float whole = mask(y, x) == Lit::yes ? 1.0f : 0.0f;
            ASSERT_TRUE(!agree || lit(y, x) == whole) << y << ", " << x;
        }
    EXPECT_GT(edges, 100); // else the terrain says nothing
}

TEST(LitFraction, NoDataIsNotANumberAndAgreesWithItsNeighbours)
{
    Terrain terrain{Grid<float>(8, 8, 0.0f), {1.0, 1.0}};
    terrain.heights_m(4, 4) = std::numeric_limits<float>::quiet_NaN();
    const LitFraction lit = cast(terrain, {.azimuth = 90_deg, .altitude = 45_deg});
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x)
            EXPECT_TRUE(y == 4 && x == 4 ? std::isnan(lit(y, x)) : lit(y, x) == 1.0f) << y << ", " << x;
}

TEST(LitFraction, IsWholeUnderLightsThatGiveOneAnswer)
{
    const Terrain terrain = wall(10.0f, {1.0, 1.0});
    for (const double altitude : {-5.0, 0.0, 90.0}) {
        const LitFraction lit = cast(terrain, {.azimuth = 90_deg, .altitude = Angle::from_degrees(altitude)});
        for (const float value : lit.values())
            ASSERT_EQ(value, altitude > 0.0 ? 1.0f : 0.0f) << altitude;
    }
}

TEST(LitFraction, OfAMaskIsZeroOneOrNotANumber)
{
    ShadowMask mask(1, 3, Lit::yes);
    mask(0, 1) = Lit::no;
    mask(0, 2) = Lit::unknown;
    const LitFraction lit = lit_fraction(mask);
    EXPECT_EQ(lit(0, 0), 1.0f);
    EXPECT_EQ(lit(0, 1), 0.0f);
    EXPECT_TRUE(std::isnan(lit(0, 2)));
}

TEST(LitFraction, IsTheSameForAnyNumberOfThreads)
{
    const Terrain terrain = make_mountains({.grid = {150, 90, {30.0, 30.0}}, .seed = 3});
    const DirectionalLight light = {.azimuth = 100.3_deg, .altitude = 12_deg};
    const ShadowField shadows = shadow_heights_by_ray(terrain, light);
    const LitFraction one = lit_fraction(terrain, shadows, light, {.threads = 1});
    const LitFraction many = lit_fraction(terrain, shadows, light, {.threads = 5});
    EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
}

TEST(LitFraction, RefusesShadowHeightsOfAnotherSize)
{
    const Terrain terrain = wall(10.0f, {1.0, 1.0});
    EXPECT_THROW(lit_fraction(terrain, ShadowField(101, 63, 0.0f), {}), InvalidInput);
}

} // namespace
} // namespace duskline
