// Shadows of lamps: the truth against a second definition and against closed forms, and the fast ray against the
// truth.

#include "mask_assertions.h"
#include "plain_surface.h"
#include "terrains.h"

#include <duskline/casting/ray.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The definition once more, as plainly as it can be said: every row and every column of the grid between a point
// and the lamp, by the share of the way, in long double.
class PlainLampDefinition {
public:
    PlainLampDefinition(const HeightField& field, const PointLight& lamp)
        : field_(field), surface_(field), lamp_(lamp.position)
    {}

    double shadow_height_m(double row, double column) const
    {
        const long double rows = lamp_.row - static_cast<long double>(row);
        const long double columns = lamp_.column - static_cast<long double>(column);
        long double shadow_m = -kInfinity;
        const auto cross = [&](long double share, long double line, long double at, bool is_column) {
            if (!(share > 0.0L && share < 1.0L))
                return;
            const long double surface = surface_.height_m(line, at, is_column);
            if (!std::isinf(surface))
                shadow_m = std::max(shadow_m, (surface - lamp_.height_m * share) / (1.0L - share));
        };
        if (rows != 0.0L)
            for (std::size_t r = 0; r < field_.rows(); ++r) {
                const long double share = (static_cast<long double>(r) - row) / rows;
                cross(share, static_cast<long double>(r), column + columns * share, false);
            }
        if (columns != 0.0L)
            for (std::size_t c = 0; c < field_.columns(); ++c) {
                const long double share = (static_cast<long double>(c) - column) / columns;
                cross(share, static_cast<long double>(c), row + rows * share, true);
            }
        return static_cast<double>(shadow_m);
    }

private:
    HeightField field_;
    PlainSurface surface_;
    GridPoint lamp_;
};

std::string described(const PointLight& lamp)
{
    return "lamp at row " + std::to_string(lamp.position.row) + ", column "
           + std::to_string(lamp.position.column) + ", " + std::to_string(lamp.position.height_m) + " m";
}

bool is_sunk(const HeightField& field, const PointLight& lamp)
{
    const auto ground_m = ground_height_m(field, lamp.position.row, lamp.position.column);
    return ground_m && lamp.position.height_m < *ground_m - 1e-6;
}

void expect_near(double actual, double expected, const PointLight& lamp, double row, double column)
{
    const std::string where =
        described(lamp) + " seen from " + std::to_string(row) + ", " + std::to_string(column);
    if (std::isinf(expected)) {
        EXPECT_EQ(actual, expected) << where;
        return;
    }
    // Floats; and the height of a far lamp is only known to so many digits.
    const double rounding = 1.3e-7 * (std::abs(expected) + 1e-5 * std::abs(lamp.position.height_m));
    EXPECT_NEAR(actual, expected, rounding + 2e-4) << where;
}

TEST(RayToLamp, IsThePlainDefinition)
{
    std::size_t sunk = 0;
    for_seeds(300, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 30});
        const PointLight lamp = random_lamp(dice, terrain);
        const PlainLampDefinition definition(terrain, lamp);
        const bool is_dark = is_sunk(terrain, lamp);
        sunk += is_dark;
        const ShadowField shadows = shadow_heights_by_ray(terrain, lamp);
        const ShadowMask mask = cast_by_ray(terrain, lamp);
        EXPECT_TRUE(same_mask(mask_of(terrain, shadows), mask)) << described(lamp);
        for (std::size_t row = 0; row < shadows.rows(); ++row)
            for (std::size_t column = 0; column < shadows.columns(); ++column) {
                if (std::isnan(terrain.heights_m(row, column))) {
                    EXPECT_EQ(mask(row, column), Lit::unknown);
                    continue;
                }
                const auto y = static_cast<double>(row);
                const auto x = static_cast<double>(column);
                expect_near(shadows(row, column), is_dark ? kInfinity : definition.shadow_height_m(y, x),
                            lamp, y, x);
            }
    });
    EXPECT_GT(sunk, 10U);
    EXPECT_LT(sunk, 150U);
}

TEST(RayToLamp, AWallShadesBySimilarTriangles)
{
    // A lamp 50 m up, 100 m before a wall 20 m high: 100 * 20 / 30 = 66.667 m of shadow behind it. From all four
    // sides, and along a slant, where the wall and its shadow are cut at the same ratio.
    for (int quarter = 0; quarter < 4; ++quarter) {
        for (const double along : {0.0, 37.0, -55.25}) {
            Terrain wall = make_wall({.grid = {.rows = 301, .columns = 401}, .height_m = 20.0}); // column 200
            PointLight lamp{{150.0 + along, 100.0, 50.0}};
            ShadowMask expected(301, 401, Lit::yes);
            for (std::size_t x = 201; x <= 266; ++x) // the wall itself faces the lamp
                for (std::size_t y = 0; y < 301; ++y) {
                    const double at_wall = lamp.position.row
                                           + (static_cast<double>(y) - lamp.position.row) * 100.0
                                                 / (static_cast<double>(x) - 100.0);
                    if (at_wall >= 0.0 && at_wall <= 300.0) // it ends at the border
                        expected(y, x) = Lit::no;
                }
            for (int i = 0; i < quarter; ++i) {
                lamp = turned(lamp, wall);
                wall = turned(wall);
                expected = turned(expected);
            }
            EXPECT_TRUE(same_mask(cast_by_ray(wall, lamp), expected)) << described(lamp);
        }
    }
}

TEST(RayToLamp, AWallAsHighAsTheLampShadesForEver)
{
    const Terrain wall = make_wall({.grid = {.rows = 5, .columns = 401}, .height_m = 20.0}); // on column 200
    const ShadowMask mask = cast_by_ray(wall, PointLight{{2.0, 190.0, 20.0}});
    for (std::size_t x = 0; x < 401; ++x)
        EXPECT_EQ(mask(2, x), x > 200 ? Lit::no : Lit::yes) << x;
}

TEST(RayToLamp, AConeOnLevelGroundShadesBetweenTwoTangents)
{
    // Seen from a lamp higher than the tip, the shadow is the triangle between the tangents from the tip's image.
    const Terrain cone = make_cone(
        {.grid = {.rows = 401, .columns = 401}, .height_m = 40.0, .slope = 45_deg}); // base radius 40
    const PointLight lamp{{200.0, 60.0, 100.0}};                                     // 140 m from the axis
    const ShadowMask mask = cast_by_ray(cone, lamp);
    const double tip = 140.0 * 100.0 / 60.0 - 140.0; // of the shadow, from the axis
    const double half_angle = std::asin(40.0 / tip);
    std::size_t wrong = 0;
    for (std::size_t y = 0; y < 401; ++y)
        for (std::size_t x = 0; x < 401; ++x) {
            const double north = 200.0 - static_cast<double>(y);
            const double east = static_cast<double>(x) - 200.0;
            if (std::hypot(north, east) < 42.0)
                continue; // the cone itself
            const double inside =
                std::sin(half_angle) * (tip - east) - std::cos(half_angle) * std::abs(north);
            if (std::abs(inside) < 1.5)
                continue; // the edge: samples make a pyramid of the cone
            const bool dark = inside > 0.0 && east > 40.0 * std::sin(half_angle); // where they touch the base
            wrong += (mask(y, x) == Lit::no) != dark;
        }
    EXPECT_EQ(wrong, 0U);
    EXPECT_NEAR(tip, 93.333, 0.001);
}

TEST(RayToLamp, APlaneIsLitFromAboveAndDarkFromBelow)
{
    for (const double aspect : {0.0, 33.0, 135.0, 270.0}) {
        const Terrain plane = make_plane({.grid = {.rows = 61, .columns = 47},
                                          .height_m = 200.0,
                                          .slope = 30_deg,
                                          .aspect = Angle::from_degrees(aspect)});
        for (const double place : {-500.0, -3.5, 0.0, 12.0, 30.25, 59.0, 1e5}) {
            const double ground_m = 200.0
                                    + std::tan(std::numbers::pi / 6.0)
                                          * ((place - 30.0) * std::cos(aspect * std::numbers::pi / 180.0)
                                             - (20.0 - 23.0) * std::sin(aspect * std::numbers::pi / 180.0));
            const double over_m = 0.5 + 0.01 * std::abs(place); // more than the heights' rounding from afar
            const ShadowMask lit = cast_by_ray(plane, PointLight{{place, 20.0, ground_m + over_m}});
            EXPECT_EQ(std::ranges::count(lit.values(), Lit::no), 0) << aspect << ' ' << place;
            const ShadowMask dark = cast_by_ray(plane, PointLight{{place, 20.0, ground_m - over_m}});
            // Beside the grid nothing hides a lamp from the outermost cells.
            const bool inside = place >= 0.0 && place <= 60.0;
            EXPECT_EQ(std::ranges::count(dark.values(), Lit::no) == 61 * 47, inside)
                << aspect << ' ' << place;
        }
    }
}

TEST(RayToLamp, OutsideTheGridItShinesAsOverLevelGround)
{
    // What lies outside casts nothing: cutting the terrain between lamp and wall changes nothing behind the wall.
    const Terrain wall =
        make_wall({.grid = {.rows = 101, .columns = 201}, .height_m = 12.0}); // on column 100
    const HeightField field = wall;
    const ShadowMask whole = cast_by_ray(field, PointLight{{50.0, 20.0, 30.0}});
    const ShadowMask part = cast_by_ray(field.window(0, 60, 101, 141), PointLight{{50.0, -40.0, 30.0}});
    for (std::size_t y = 0; y < 101; ++y)
        for (std::size_t x = 0; x < 141; ++x)
            ASSERT_EQ(part(y, x), whole(y, x + 60)) << y << ' ' << x;
    EXPECT_GT(std::ranges::count(part.values(), Lit::no), 1000);
}

TEST(RayToLamp, InAPitItLightsThePitAndWhatRisesOverItsRim)
{
    Terrain pit{Grid<float>(41, 41, 0.0f), {1.0, 1.0}};
    for (std::size_t y = 15; y <= 25; ++y)
        for (std::size_t x = 15; x <= 25; ++x)
            pit.heights_m(y, x) = -10.0f;
    pit.heights_m(20, 40) = 100.0f; // a tower that sees into it
    const ShadowMask mask = cast_by_ray(pit, PointLight{{20.0, 20.0, -5.0}});
    for (std::size_t y = 0; y < 41; ++y)
        for (std::size_t x = 0; x < 41; ++x) {
            const bool in_pit = y >= 15 && y <= 25 && x >= 15 && x <= 25;
            const bool rim = !in_pit && y >= 14 && y <= 26 && x >= 14 && x <= 26;
            const Lit expected = in_pit || (y == 20 && x == 40) ? Lit::yes : Lit::no;
            if (!rim) {
                EXPECT_EQ(mask(y, x), expected) << y << ' ' << x;
            }
        }
}

TEST(RayToLamp, OverASampleItLightsTheCellBelowAndSeesAlongTheLines)
{
    Terrain terrain{Grid<float>(9, 9, 0.0f), {1.0, 1.0}};
    terrain.heights_m(4, 6) = 3.0f;
    const ShadowMask mask = cast_by_ray(terrain, PointLight{{4.0, 4.0, 2.0}});
    for (std::size_t x = 0; x < 9; ++x)
        EXPECT_EQ(mask(4, x), x > 6 ? Lit::no : Lit::yes) << x;
    for (std::size_t y = 0; y < 9; ++y)
        EXPECT_EQ(mask(y, 4), Lit::yes) << y;
    // On the ground itself: level ground is just touched, and lit.
    terrain.heights_m(4, 6) = 0.0f;
    const ShadowMask level = cast_by_ray(terrain, PointLight{{4.0, 4.0, 0.0}});
    EXPECT_EQ(std::ranges::count(level.values(), Lit::yes), 81);
}

TEST(RayToLamp, UnderTheGroundItLightsNothing)
{
    const Terrain flat = make_plane({.grid = {.rows = 7, .columns = 9}, .height_m = 5.0});
    for (const GridPoint place :
         {GridPoint{3.0, 4.0, 4.9}, GridPoint{3.3, 4.0, 4.9}, GridPoint{3.3, 4.4, 4.9},
          GridPoint{0.0, 0.0, 4.9}, GridPoint{6.0, 8.0, -1e6}}) {
        const ShadowMask mask = cast_by_ray(flat, PointLight{place});
        EXPECT_EQ(std::ranges::count(mask.values(), Lit::no), 63);
        const ShadowField shadows = shadow_heights_by_ray(flat, PointLight{place});
        EXPECT_EQ(std::ranges::count(shadows.values(), static_cast<float>(kInfinity)), 63);
    }
}

TEST(RayToLamp, FarAwayItIsTheSun)
{
    for_seeds(40, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 40, .holes = false, .square_cells = true});
        const HeightField field = terrain;
        const DirectionalLight sun{.azimuth = Angle::from_degrees(dice.between(0.0, 360.0)),
                                   .altitude = Angle::from_degrees(dice.between(2.0, 70.0))};
        constexpr double distance_cells = 1e9;
        const auto [sine, cosine] = sine_cosine(sun.azimuth);
        const PointLight lamp{{-cosine * distance_cells, sine * distance_cells,
                               tangent(sun.altitude) * distance_cells * field.cell_size_m.x}};
        const ShadowField near = shadow_heights_by_ray(terrain, sun);
        const ShadowField far = shadow_heights_by_ray(terrain, lamp);
        for (std::size_t i = 0; i < near.size(); ++i)
            if (std::isinf(near.values()[i])) {
                EXPECT_EQ(far.values()[i], near.values()[i]);
            } else {
                EXPECT_NEAR(far.values()[i], near.values()[i], 0.01 + 1e-5 * std::abs(near.values()[i]));
            }
    });
}

TEST(RayToLamp, TurnedAndMirroredTerrainsAndLampsHaveTurnedAndMirroredShadows)
{
    for_seeds(60, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 30});
        const PointLight lamp = random_lamp(dice, terrain);
        const ShadowField shadows = shadow_heights_by_ray(terrain, lamp);
        const Terrain quarter = turned(terrain);
        EXPECT_TRUE(same_bits(shadow_heights_by_ray(quarter, turned(lamp, terrain)), turned(shadows)))
            << described(lamp);
        const Terrain mirror = mirrored(terrain);
        EXPECT_TRUE(same_bits(shadow_heights_by_ray(mirror, mirrored(lamp, terrain)), mirrored(shadows)))
            << described(lamp);
    });
}

TEST(FastRayToLamp, HasTheBitsOfTheRay)
{
    for_seeds(250, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = dice.chance(0.1) ? 120U : 45U});
        const PointLight lamp = random_lamp(dice, terrain);
        const TerrainRays rays(terrain, {.threads = 1});
        EXPECT_TRUE(same_bits(rays.shadow_heights(lamp), shadow_heights_by_ray(terrain, lamp)))
            << described(lamp);
        EXPECT_TRUE(same_mask(rays.cast(lamp), cast_by_ray(terrain, lamp))) << described(lamp);
    });
}

TEST(TerrainRaysToLamp, AnswerForPlacesBetweenCellsAndBeyondTheGrid)
{
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 30});
        const PointLight lamp = random_lamp(dice, terrain);
        const TerrainRays rays(terrain);
        const PlainLampDefinition definition(terrain, lamp);
        const bool is_dark = is_sunk(terrain, lamp);
        for (int i = 0; i < 100; ++i) {
            double row = dice.between(-30.0, 60.0);
            double column = dice.between(-30.0, 60.0);
            if (dice.chance(0.2))
                row = std::round(row);
            if (dice.chance(0.2))
                column = std::round(column);
            const double expected = is_dark ? kInfinity : definition.shadow_height_m(row, column);
            expect_near(rays.shadow_height_m(row, column, lamp), expected, lamp, row, column);
        }
    });
}

TEST(TerrainRaysToLamp, TellWhetherAPointInTheAirIsInShadow)
{
    const Terrain wall = make_wall({.grid = {.rows = 21, .columns = 65}}); // 10 m, on column 32
    const TerrainRays rays(wall);
    const PointLight lamp{{10.0, 42.0, 20.0}};
    EXPECT_TRUE(rays.is_shadowed({.row = 10.0, .column = 27.0, .height_m = 4.9}, lamp));
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 27.0, .height_m = 5.0}, lamp)) << "on the edge";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 22.0, .height_m = 0.0}, lamp)) << "on the edge";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 40.0, .height_m = 0.0}, lamp)) << "before the wall";
    EXPECT_TRUE(
        rays.is_shadowed({.row = 10.0, .column = 40.0, .height_m = 500.0}, PointLight{{10.0, 32.0, 9.0}}))
        << "a lamp in the wall";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 42.0, .height_m = 0.0}, lamp)) << "below the lamp";
    EXPECT_THROW(rays.is_shadowed({.height_m = std::nan("")}, lamp), InvalidInput);
    EXPECT_THROW(rays.shadow_height_m(kInfinity, 0.0, lamp), InvalidInput);
}

TEST(PointLight, RefusesPlacesThatAreNone)
{
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e16}) {
        EXPECT_THROW(cast_by_ray(flat, PointLight{{bad, 0.0, 1.0}}), InvalidInput);
        EXPECT_THROW(cast_by_fast_ray(flat, PointLight{{0.0, bad, 1.0}}), InvalidInput);
        EXPECT_THROW(shadow_heights_by_ray(flat, PointLight{{0.0, 0.0, bad}}), InvalidInput);
    }
    for (const double far : {4503599627370496.0, -4503599627370496.0}) {
        const ShadowMask mask = cast_by_fast_ray(flat, PointLight{{far, far, 1.0}});
        EXPECT_EQ(std::ranges::count(mask.values(), Lit::yes), 16);
    }
    EXPECT_TRUE(cast_by_ray(HeightField{}, PointLight{}).empty());
    EXPECT_TRUE(TerrainRays(HeightField{}).cast(PointLight{}).empty());
}

TEST(GroundHeight, IsBilinearAndTheSurfaceItselfOnTheLines)
{
    Terrain terrain{Grid<float>(2, 3, 0.0f), {1.0, 1.0}};
    for (std::size_t i = 0; i < 6; ++i)
        terrain.heights_m.values()[i] = static_cast<float>(i * i);
    EXPECT_EQ(ground_height_m(terrain, 0.0, 0.0), 0.0);
    EXPECT_EQ(ground_height_m(terrain, 1.0, 2.0), 25.0);
    EXPECT_EQ(ground_height_m(terrain, 0.0, 1.25), 1.75);
    EXPECT_EQ(ground_height_m(terrain, 0.5, 0.0), 4.5);
    EXPECT_EQ(ground_height_m(terrain, 0.5, 0.5), 6.5);
    EXPECT_EQ(ground_height_m(terrain, -0.1, 0.0), std::nullopt);
    EXPECT_EQ(ground_height_m(terrain, 0.0, 2.1), std::nullopt);
    EXPECT_EQ(ground_height_m(terrain, std::nan(""), 1.0), std::nullopt);
    terrain.heights_m(1, 1) = kNan;
    EXPECT_EQ(ground_height_m(terrain, 0.0, 1.25), 1.75) << "along the row above the hole";
    EXPECT_EQ(ground_height_m(terrain, 0.1, 1.25), std::nullopt);
}

} // namespace
} // namespace duskline
