#include "mask_assertions.h"
#include "plain_surface.h"
#include "terrains.h"

#include <duskline/casting/ray.h>
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

// The definition once more, as plainly as it can be said and in another frame: metres along the ray, rows and
// columns of the grid, no symmetry, no way out before the last crossing.
class PlainDefinition {
public:
    PlainDefinition(const HeightField& field, const DirectionalLight& light) : field_(field), surface_(field)
    {
        const long double degree = std::numbers::pi_v<long double> / 180.0L;
        const long double azimuth = std::remainder(light.azimuth.degrees(), 360.0) * degree;
        const long double columns = std::sin(azimuth) / field.cell_size_m.x;
        const long double rows = -std::cos(azimuth) / field.cell_size_m.y;
        // A light along an axis, to a millionth of a cell per line, does not move off it at all.
        columns_per_metre_ = std::abs(columns) < 1e-6L * std::abs(rows) ? 0.0L : columns;
        rows_per_metre_ = std::abs(rows) < 1e-6L * std::abs(columns) ? 0.0L : rows;
        climb_ = std::tan(light.altitude.degrees() * degree);
    }

    double shadow_height_m(double row, double column) const
    {
        long double shadow_m = -kInfinity;
        const auto cross = [&](long double metres, bool row_line) {
            if (!(metres > 1e-9L))
                return;
            const long double r = row + rows_per_metre_ * metres;
            const long double c = column + columns_per_metre_ * metres;
            shadow_m =
                std::max(shadow_m, (row_line ? surface_.height_m(r, c, false) : surface_.height_m(c, r, true))
                                       - climb_ * metres);
        };
        if (rows_per_metre_ != 0.0L)
            for (std::size_t r = 0; r < field_.rows(); ++r)
                cross((static_cast<long double>(r) - row) / rows_per_metre_, true);
        if (columns_per_metre_ != 0.0L)
            for (std::size_t c = 0; c < field_.columns(); ++c)
                cross((static_cast<long double>(c) - column) / columns_per_metre_, false);
        return static_cast<double>(shadow_m);
    }

private:
    HeightField field_;
    PlainSurface surface_;
    long double columns_per_metre_;
    long double rows_per_metre_;
    long double climb_;
};

std::string described(const DirectionalLight& light)
{
    return "azimuth " + std::to_string(light.azimuth.degrees()) + ", altitude "
           + std::to_string(light.altitude.degrees());
}

void expect_near(double actual, double expected, const DirectionalLight& light, double row, double column)
{
    // Near the zenith no two ways to the tangent agree in all digits.
    const double rounding = light.altitude.degrees() < 89.9 ? 1e-8 : 1e-5;
    const std::string where = described(light) + " at " + std::to_string(row) + ", " + std::to_string(column);
    if (std::isinf(expected)) {
        EXPECT_EQ(actual, expected) << where;
        return;
    }
    EXPECT_NEAR(actual, expected, rounding * std::abs(expected) + 2e-4) << where;
}

TEST(Ray, AWallShadesAsFarAsItsHeightOverTheTangentOfTheSun)
{
    const Terrain wall = make_wall({.grid = {.rows = 5, .columns = 65}, .offset_m = 8.0}); // on column 40
    const DirectionalLight light{.azimuth = 90_deg, .altitude = 45_deg};
    const ShadowMask mask = cast_by_ray(wall, light);
    const ShadowField shadows = shadow_heights_by_ray(wall, light);
    for (std::size_t x = 0; x < 65; ++x) {
        // Ten cells away the ray just touches the top of the wall: lit.
        EXPECT_EQ(mask(2, x), x > 30 && x < 40 ? Lit::no : Lit::yes) << "column " << x;
        if (x < 40) {
            // The level ground before it shades a metre under itself.
            EXPECT_EQ(shadows(2, x), std::max(10.0f - static_cast<float>(40 - x), -1.0f)) << "column " << x;
        }
    }
    EXPECT_EQ(shadows(2, 64), -std::numeric_limits<float>::infinity()) << "nothing lies towards the light";
}

TEST(Ray, IsThePlainDefinition)
{
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 30});
        const DirectionalLight light = random_light(dice);
        const PlainDefinition definition(terrain, light);
        const ShadowField shadows = shadow_heights_by_ray(terrain, light);
        for (std::size_t row = 0; row < shadows.rows(); ++row)
            for (std::size_t column = 0; column < shadows.columns(); ++column)
                if (!std::isnan(shadows(row, column))) {
                    const double expected =
                        definition.shadow_height_m(static_cast<double>(row), static_cast<double>(column));
                    expect_near(shadows(row, column), expected, light, static_cast<double>(row),
                                static_cast<double>(column));
                }
    });
}

TEST(Ray, ACellInWhoseSightTheSurfaceIsAboveTheRayIsInShadowAndOneItTouchesIsLit)
{
    Terrain terrain{Grid<float>(1, 3, 0.0f), {1.0, 1.0}};
    terrain.heights_m(0, 2) = 2.0f;
    const DirectionalLight light{.azimuth = 90_deg, .altitude = 45_deg};
    EXPECT_EQ(cast_by_ray(terrain, light)(0, 0), Lit::yes) << "touches";
    terrain.heights_m(0, 2) = std::nextafter(2.0f, 3.0f);
    EXPECT_EQ(cast_by_ray(terrain, light)(0, 0), Lit::no);
}

TEST(Ray, TheSurfaceBetweenTwoSamplesIsStraight)
{
    // At 26.565 degrees from north a ray crosses row 1 halfway between columns 0 and 1, and column 1 on row
    // 0.
    Terrain terrain{Grid<float>(3, 3, 0.0f), {1.0, 1.0}};
    terrain.heights_m(1, 1) = 8.0f;
    const DirectionalLight light{.azimuth = Angle::from_radians(std::atan(0.5)), .altitude = 10_deg};
    const double climb = std::tan(10.0 * std::numbers::pi / 180.0);
    EXPECT_NEAR(shadow_heights_by_ray(terrain, light)(2, 0), 4.0 - climb * std::sqrt(1.25), 1e-6);
}

TEST(Ray, CrossingsWithColumnsCountAsMuchAsThoseWithRows)
{
    // The only high ground that the ray from the corner meets lies on column 1, between rows 1 and 2.
    Terrain terrain{Grid<float>(4, 4, 0.0f), {1.0, 1.0}};
    terrain.heights_m(1, 1) = -6.0f;
    terrain.heights_m(2, 1) = 12.0f;
    terrain.heights_m(2, 0) = -100.0f;
    terrain.heights_m(1, 0) = -100.0f;
    const DirectionalLight light{.azimuth = Angle::from_radians(std::atan(1.0 / 1.5)), .altitude = 10_deg};
    const double climb = std::tan(10.0 * std::numbers::pi / 180.0);
    EXPECT_NEAR(shadow_heights_by_ray(terrain, light)(3, 0), 3.0 - climb * std::hypot(1.0, 1.5), 1e-6);
}

TEST(Ray, ARayThroughCornersMeetsTheCornersAlone)
{
    // On the diagonal nothing between the samples is touched, not even sky-high ground beside it.
    Terrain terrain{Grid<float>(9, 9, 1000.0f), {1.0, 1.0}};
    for (std::size_t i = 0; i < 9; ++i)
        terrain.heights_m(i, 8 - i) = 0.0f;
    const ShadowMask mask = cast_by_ray(terrain, {.azimuth = 45_deg, .altitude = 1_deg});
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(mask(i, 8 - i), Lit::yes);
}

TEST(Ray, ACrossingNextToAHoleIsSkippedAndOneOnASampleIsNot)
{
    Terrain terrain{Grid<float>(3, 3, 0.0f), {1.0, 1.0}};
    terrain.heights_m(1, 1) = 50.0f;
    for (const std::size_t column : {0U, 2U})
        for (const std::size_t row : {0U, 1U})
            terrain.heights_m(row, column) = kNan;
    const auto lit = [&](double azimuth) {
        return cast_by_ray(terrain, {.azimuth = Angle::from_degrees(azimuth), .altitude = 10_deg})(2, 1);
    };
    EXPECT_EQ(lit(0.0), Lit::no) << "on the sample";
    EXPECT_EQ(lit(1e-9), Lit::no) << "as good as on the sample";
    EXPECT_EQ(lit(-1e-9), Lit::no);
    EXPECT_EQ(lit(5.0), Lit::yes) << "between the sample and the hole";
    EXPECT_EQ(lit(-5.0), Lit::yes);
}

TEST(Ray, AHairBesideTheDiagonalTheSamplesOnItStillCount)
{
    // Nothing is known but the diagonal; at its end, in the corner of the grid, stands a tower.
    Terrain terrain{Grid<float>(30, 30, kNan), {1.0, 1.0}};
    for (std::size_t i = 0; i < 30; ++i)
        terrain.heights_m(i, 29 - i) = 0.0f;
    terrain.heights_m(0, 29) = 50.0f;
    for (int quarter = 0; quarter < 4; ++quarter) {
        for (const double beside : {0.0, 1e-9, -1e-9, 1e-12, -1e-12, 1.0, -1.0}) {
            DirectionalLight light{.azimuth = Angle::from_degrees(45.0 + 90.0 * quarter + beside),
                                   .altitude = 45_deg};
            const ShadowMask mask = cast_by_ray(terrain, light);
            const auto dark = std::ranges::count(mask.values(), Lit::no);
            EXPECT_EQ(dark, std::abs(beside) < 0.5 ? 29 : 0) << described(light);
        }
        terrain = turned(terrain);
    }
}

TEST(Ray, AFrameOfNoDataChangesNoBit)
{
    for_seeds(150, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 25});
        const std::size_t rows = terrain.heights_m.rows();
        const std::size_t columns = terrain.heights_m.columns();
        DirectionalLight light = random_light(dice);
        if (dice.chance(0.5)) // rays through corners
            light.azimuth = Angle::from_degrees(45.0 + 90.0 * static_cast<double>(dice.below(4))
                                                + (dice.chance(0.5) ? 1e-9 : -1e-9));
        const Terrain framed_terrain = framed_by_no_data(terrain, 1);
        const ShadowField framed = shadow_heights_by_ray(framed_terrain, light);
        ShadowField inside(rows, columns);
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t column = 0; column < columns; ++column)
                inside(row, column) = framed(row + 1, column + 1);
        EXPECT_TRUE(same_bits(inside, shadow_heights_by_ray(terrain, light))) << described(light);
    });
}

TEST(Ray, NothingIsCutOffByTheHighestGround)
{
    // Every cell in turn is the only tower, and the ray that just reaches its top from far away must see it.
    for (std::size_t at = 1; at < 40; ++at) {
        Terrain terrain{Grid<float>(1, 40, 0.0f), {1.0, 1.0}};
        terrain.heights_m(0, at) = static_cast<float>(at) + 0.001f;
        EXPECT_EQ(cast_by_ray(terrain, {.azimuth = 90_deg, .altitude = 45_deg})(0, 0), Lit::no) << at;
    }
}

TEST(Ray, AWindowThatHoldsAllTheGroundTowardsTheLightChangesNoBit)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 90, .columns = 120, .cell_size_m = {60.0, 45.0}}});
    const HeightField field = terrain;
    for (const double azimuth : {0.0, 10.0, 45.0, 60.0, 90.0}) { // all from the north-east
        const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 9.5_deg};
        const ShadowField whole = shadow_heights_by_ray(field, light);
        const ShadowField part = shadow_heights_by_ray(field.window(0, 31, 57, 89), light);
        for (std::size_t row = 0; row < 57; ++row)
            for (std::size_t column = 0; column < 89; ++column)
                ASSERT_EQ(part(row, column), whole(row, column + 31))
                    << azimuth << ' ' << row << ' ' << column;
    }
}

TEST(Ray, ItsMaskOfTheseMountainsNeverChanges)
{
    // Red means that the truth has changed, and with it every figure that is measured against it.
    const Terrain terrain =
        make_mountains({.grid = {.rows = 200, .columns = 200, .cell_size_m = {60.0, 75.0}}, .seed = 11});
    std::size_t dark = 0;
    std::size_t places = 0;
    for (const double azimuth : {0.0, 45.0, 100.3, 203.0}) {
        const ShadowMask mask =
            cast_by_ray(terrain, {.azimuth = Angle::from_degrees(azimuth), .altitude = 15_deg});
        for (std::size_t i = 0; i < mask.size(); ++i)
            if (mask.values()[i] == Lit::no) {
                ++dark;
                places = (places + i) % 1000003;
            }
    }
    EXPECT_EQ(dark, 73186U);
    EXPECT_EQ(places, 264793U);
}

TEST(FastRay, HasTheBitsOfTheRay)
{
    for_seeds(150, [&](Dice& dice) {
        RandomTerrainOptions options{.largest = dice.chance(0.2) ? 150U : 50U};
        const Terrain terrain = random_terrain(dice, options);
        const DirectionalLight light = random_light(dice);
        const TerrainRays rays(terrain, {.threads = 1});
        EXPECT_TRUE(same_bits(rays.shadow_heights(light), shadow_heights_by_ray(terrain, light)))
            << described(light);
        EXPECT_TRUE(same_mask(rays.cast(light), cast_by_ray(terrain, light))) << described(light);
    });
}

TEST(FastRay, HasTheBitsOfTheRayOnLongAndNarrowTerrains)
{
    for_seeds(60, [&](Dice& dice) {
        const std::size_t length = 1 + dice.below(300);
        const std::size_t width = 1 + dice.below(4);
        const bool tall = dice.chance(0.5);
        Terrain terrain = make_mountains({.grid = {.rows = tall ? length : width,
                                                   .columns = tall ? width : length,
                                                   .cell_size_m = {60.0, 60.0}},
                                          .seed = dice.below(1000)});
        for (float& height_m : terrain.heights_m.values())
            if (dice.chance(0.03))
                height_m = dice.chance(0.5) ? kNan : 3000.0f;
        DirectionalLight light = random_light(dice);
        EXPECT_TRUE(
            same_bits(shadow_heights_by_fast_ray(terrain, light), shadow_heights_by_ray(terrain, light)))
            << described(light);
    });
}

TEST(TerrainRays, GiveTheShadowHeightsOfCellsAtTheirCentres)
{
    for_seeds(30, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        const TerrainRays rays(terrain);
        const ShadowField shadows = shadow_heights_by_ray(terrain, light);
        for (std::size_t row = 0; row < shadows.rows(); ++row)
            for (std::size_t column = 0; column < shadows.columns(); ++column)
                if (!std::isnan(shadows(row, column))) {
                    const double shadow_m =
                        rays.shadow_height_m(static_cast<double>(row), static_cast<double>(column), light);
                    EXPECT_EQ(shadow_height_as_float(shadow_m), shadows(row, column));
                }
    });
}

TEST(TerrainRays, AnswerForPlacesBetweenCellsAndBeyondTheGrid)
{
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 30});
        const DirectionalLight light = random_light(dice);
        const TerrainRays rays(terrain);
        const PlainDefinition definition(terrain, light);
        for (int i = 0; i < 100; ++i) {
            double row = dice.between(-30.0, 60.0);
            double column = dice.between(-30.0, 60.0);
            if (dice.chance(0.2))
                row = std::round(row);
            if (dice.chance(0.2))
                column = std::round(column);
            const double expected = definition.shadow_height_m(row, column);
            expect_near(rays.shadow_height_m(row, column, light), expected, light, row, column);
        }
    });
}

TEST(TerrainRays, TellWhetherAPointInTheAirIsInShadow)
{
    const Terrain wall =
        make_wall({.grid = {.rows = 21, .columns = 65}, .offset_m = 8.0}); // 10 m, on column 40
    const TerrainRays rays(wall);
    const DirectionalLight light{.azimuth = 90_deg, .altitude = 45_deg};
    EXPECT_TRUE(rays.is_shadowed({.row = 10.0, .column = 35.5, .height_m = 5.4}, light));
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 35.5, .height_m = 5.5}, light)) << "on the edge";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 35.5, .height_m = 5.6}, light));
    EXPECT_TRUE(rays.is_shadowed({.row = 3.7, .column = 39.9, .height_m = 9.8}, light));
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 40.0, .height_m = 10.0}, light)) << "on the wall";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 50.0, .height_m = 0.0}, light))
        << "before the wall";
    EXPECT_TRUE(rays.is_shadowed({.row = 10.0, .column = 50.0, .height_m = 1e9}, {.altitude = 0_deg}))
        << "night";
    EXPECT_FALSE(rays.is_shadowed({.row = 10.0, .column = 39.9, .height_m = 0.0}, {.altitude = 90_deg}));
}

TEST(TerrainRays, SeeTheGridFromFarAway)
{
    Terrain wall = make_wall({.grid = {.rows = 65, .columns = 65}, .height_m = 1000.0}); // on column 32
    const TerrainRays rays(wall);
    // A billion cells west the ray of a sun that climbs a metre in a hundred million has come ten metres up.
    const DirectionalLight low{.azimuth = 90_deg, .altitude = Angle::from_radians(std::atan(1e-8))};
    EXPECT_NEAR(rays.shadow_height_m(20.0, 32.0 - 1e9, low), 990.0, 1e-5);
    EXPECT_EQ(rays.shadow_height_m(-1.0, 32.0 - 1e9, low), -kInfinity) << "passes north of the grid";
    EXPECT_EQ(rays.shadow_height_m(20.0, 1e9, low), -kInfinity) << "looks away from the grid";
    for (const double far : {1e15, -1e15, 4503599627370496.0})
        for (const double azimuth : {0.0, 33.0, 45.0, 90.0, 200.0}) {
            const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 1_deg};
            EXPECT_LE(rays.shadow_height_m(far, far, light), 1000.0);
            EXPECT_LE(rays.shadow_height_m(3.0, far, light), 1000.0);
            EXPECT_LE(rays.shadow_height_m(far, 3.0, light), 1000.0);
        }
}

TEST(TerrainRays, AnEmptyTerrainShadesNothing)
{
    const TerrainRays rays(HeightField{});
    EXPECT_EQ(rays.shadow_height_m(0.0, 0.0, {.altitude = 30_deg}), -kInfinity);
    EXPECT_EQ(rays.shadow_height_m(0.0, 0.0, {.altitude = 0_deg}), kInfinity);
    EXPECT_TRUE(rays.cast({.altitude = 30_deg}).empty());
}

TEST(TerrainRays, RefusePlacesAndLightsThatAreNone)
{
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    const TerrainRays rays(flat);
    for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e16}) {
        EXPECT_THROW(rays.shadow_height_m(bad, 0.0, DirectionalLight{}), InvalidInput);
        EXPECT_THROW(rays.shadow_height_m(0.0, bad, DirectionalLight{}), InvalidInput);
    }
    EXPECT_THROW(rays.is_shadowed({.height_m = std::nan("")}, DirectionalLight{}), InvalidInput);
    EXPECT_THROW(rays.is_shadowed({}, {.altitude = 91_deg}), InvalidInput);
    EXPECT_THROW(TerrainRays({flat.heights_m.view(), {0.0, 1.0}}), InvalidInput);
}

} // namespace
} // namespace duskline
