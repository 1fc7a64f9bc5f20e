#include "disc_average.h"
#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/visible_fraction.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

VisibleFraction soft(const HeightField& field, const DirectionalLight& light, const char* caster = "exact",
                     std::size_t threads = 1)
{
    return visible_fraction(field, light, caster_named(caster), {.threads = threads});
}

double tangent_of_degrees(double degrees)
{
    return std::tan(degrees * std::numbers::pi / 180.0);
}

// Of a disc whose centre is t radii over a straight level horizon.
double seen_over(double t)
{
    return t >= 1.0    ? 1.0
           : t <= -1.0 ? 0.0
                       : 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
}

// A wall 100 m high from north to south through column 0, seen from the west side of a light in the west.
Terrain wall(std::size_t columns, double cell_m)
{
    Terrain terrain{Grid<float>(41, columns, 0.0f), {cell_m, cell_m}};
    for (std::size_t y = 0; y < 41; ++y)
        terrain.heights_m(y, 0) = 100.0f;
    return terrain;
}

class SoftByEveryCaster : public testing::TestWithParam<Caster> {};
INSTANTIATE_TEST_SUITE_P(All, SoftByEveryCaster, testing::ValuesIn(kCasters), test_name);

// As wide as h cot(a - r) - h cot(a + r), and through it a disc that sets behind a straight edge.
TEST_P(SoftByEveryCaster, AWallsHalfShadowIsAsWideAsTheDiscIsHigh)
{
    struct Known {
        double altitude;
        double width_m;
    };
    for (const Known& known : {Known{60.0, 1.2407}, Known{45.0, 1.8610}, Known{30.0, 3.7222},
                               Known{20.0, 7.9557}, Known{10.0, 30.8798}, Known{5.0, 122.8428}}) {
        const double cell_m = known.width_m / 20.0;
        const double radius = 0.533 / 2.0; // mean sun: 959.63 seconds of arc
        const double near_m = 100.0 / tangent_of_degrees(known.altitude + radius);
        const double far_m = 100.0 / tangent_of_degrees(known.altitude - radius);
        EXPECT_NEAR(far_m - near_m, known.width_m, 1e-3 * known.width_m);
        // Cells from the end of the full shadow on: the ground in between is skipped.
        const auto skipped = static_cast<std::size_t>(near_m / cell_m) - 4;
        const std::size_t columns = 30 + skipped;
        const Terrain terrain = wall(columns, cell_m);
        const VisibleFraction seen = visible_fraction(
            terrain, {.azimuth = 270_deg, .altitude = Angle::from_degrees(known.altitude)}, GetParam());
        for (std::size_t x = skipped; x < columns; ++x) {
            const double horizon =
                std::atan(100.0 / (static_cast<double>(x) * cell_m)) * 180.0 / std::numbers::pi;
            // Half-way down the wall's length, whose ends are far beyond the disc's sides.
            EXPECT_NEAR(seen(20, x), seen_over((known.altitude - horizon) / radius), 4e-3)
                << known.altitude << " degrees, column " << x;
        }
    }
}

// The shadow of a tower 10 cells wide and without end in height: its sides are as soft as the disc is wide.
TEST_P(SoftByEveryCaster, ATowersSideShadowIsAsWideAsTheDisc)
{
    constexpr std::size_t kAway = 2000;
    Terrain terrain{Grid<float>(61, kAway + 1, 0.0f), {1.0, 1.0}};
    for (std::size_t y = 0; y <= 30; ++y) // its edge is half-way to row 31, or so the surface has it
        terrain.heights_m(y, 0) = 1e6f;
    const DirectionalLight light = {.azimuth = 270_deg, .altitude = 20_deg};
    const VisibleFraction seen = visible_fraction(terrain, light, GetParam());
    const double radius = std::asin(std::sin(0.533 / 2.0 * std::numbers::pi / 180.0)
                                    / std::cos(20.0 * std::numbers::pi / 180.0)); // of azimuth
    double sum = 0.0;
    // Farther north the sun is seen past the tower's other end, the border of the grid.
    for (std::size_t y = 12; y < 61; ++y) {
        // A ridge that falls from 1000 km to nothing within a cell ends where it is below the sun.
        const double edge = 31.0 - kAway * tangent_of_degrees(20.0) / 1e6;
        const double offset = std::atan((static_cast<double>(y) - edge) / kAway);
        EXPECT_NEAR(seen(y, kAway), seen_over(offset / radius), 0.06) << y;
        sum += seen(y, kAway) - seen_over(offset / radius);
    }
    EXPECT_NEAR(sum, 0.0, 0.25);
}

TEST_P(SoftByEveryCaster, AveragesHundredsOfSuns)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    for (const double altitude : {0.1, 4.0, 12.0, 35.0}) {
        const Terrain terrain =
            make_mountains({.grid = {80, 100, {30.0, 25.0}}, .seed = 5, .roughness = 0.5});
        const DirectionalLight light = {.azimuth = 203_deg, .altitude = Angle::from_degrees(altitude)};
        const FractionError error =
            fraction_error(visible_fraction(terrain, light, GetParam()), disc_average(terrain, light, 250));
        EXPECT_GT(error.cells, 30U) << altitude;
        if (GetParam().exact) {
            EXPECT_LT(error.mean, 0.012) << altitude;
            // Where no mask at the disc's edges shows that a side of it is hidden.
            EXPECT_LT(static_cast<double>(error.far_off), 0.06 * static_cast<double>(error.cells))
                << altitude;
        }
        // Of all cells: who is wrong about a hard edge is wrong about the soft one.
        const double most = answers_beside_centres(GetParam()) ? 0.025 : 0.01;
        EXPECT_LT(error.mean * static_cast<double>(error.cells), most * 80 * 100) << altitude;
    }
}

// Lamps and the glow of the sky: every cell gets its horizons, whichever caster is asked.
TEST(SoftShadows, AverageWideDiscs)
{
    const Terrain terrain = make_mountains({.grid = {40, 50, {30.0, 25.0}}, .seed = 9, .roughness = 0.5});
    for (const double diameter : {3.0, 10.0, 60.0, 180.0})
        for (const double altitude : {2.0, 30.0, 88.0}) {
            const DirectionalLight light = {.azimuth = 100.3_deg,
                                            .altitude = Angle::from_degrees(altitude),
                                            .angular_diameter = Angle::from_degrees(diameter)};
            const FractionError error =
                fraction_error(soft(terrain, light), disc_average(terrain, light, 400));
            EXPECT_LT(error.mean, 0.012) << diameter << ", " << altitude;
            EXPECT_LT(error.worst, 0.1) << diameter << ", " << altitude;
        }
}

// The whole sky over a valley: what is left of it between two even sides, 1 - 2 slope / pi.
TEST(SoftShadows, OfTheWholeSkyAreTheOpenPartOfIt)
{
    for (const double slope : {15.0, 30.0, 45.0}) {
        const Terrain valley = make_valley(
            {.grid = {2001, 21, {1.0, 1.0}}, .course = 90_deg, .slope = Angle::from_degrees(slope)});
        // One column of cells would do; rays along the valley are the border's.
        const HeightField middle = HeightField(valley).window(900, 0, 201, 21);
        const VisibleFraction seen = soft(middle, {.altitude = 90_deg, .angular_diameter = 180_deg});
        EXPECT_NEAR(seen(100, 10), 1.0 - 2.0 * slope / 180.0, 0.06) << slope;
    }
}

// Spikes, cliffs and holes, by a disc just wide enough for every cell to get its horizons.
TEST(SoftShadows, OnRandomTerrainAreWhatTheRaysSay)
{
    std::size_t cells = 0;
    double sum = 0.0;
    for_seeds(25, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 35});
        DirectionalLight light = random_light(dice);
        light.angular_diameter = 1.01_deg;
        const FractionError error = fraction_error(soft(terrain, light), disc_average(terrain, light, 200));
        EXPECT_LT(error.worst, 0.15);
        cells += error.cells;
        sum += error.mean * static_cast<double>(error.cells);
    });
    EXPECT_GT(cells, 100U);
    EXPECT_LT(sum / static_cast<double>(cells), 0.02);
}

TEST_P(SoftByEveryCaster, ADiscOfNoSizeGivesTheMask)
{
    for_seeds(10, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        DirectionalLight light = random_light(dice);
        light.angular_diameter = {};
        const ShadowMask mask = GetParam().cast(terrain, light, {});
        const VisibleFraction seen = visible_fraction(terrain, light, GetParam());
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const float expected = mask.values()[i] == Lit::yes ? 1.0f : 0.0f;
            ASSERT_TRUE(mask.values()[i] == Lit::unknown ? std::isnan(seen.values()[i])
                                                         : seen.values()[i] == expected);
        }
    });
}

TEST_P(SoftByEveryCaster, LevelGroundSeesAllThatIsAboveTheHorizontal)
{
    const Terrain plain{Grid<float>(9, 12, 250.0f), {30.0, 30.0}};
    struct Known {
        double altitude;
        double seen;
    };
    for (const Known& known :
         {Known{90.0, 1.0}, Known{89.9, 1.0}, Known{30.0, 1.0}, Known{0.27, 1.0}, Known{0.13325, 0.804499},
          Known{0.0, 0.5}, Known{-0.13325, 0.195501}, Known{-0.2665, 0.0}, Known{-20.0, 0.0}}) {
        const VisibleFraction seen = visible_fraction(
            plain, {.azimuth = 77_deg, .altitude = Angle::from_degrees(known.altitude)}, GetParam());
        for (const float value : seen.values())
            EXPECT_NEAR(value, known.seen, known.seen == 1.0 || known.seen == 0.0 ? 0.0 : 2e-3)
                << known.altitude;
    }
}

TEST_P(SoftByEveryCaster, SeesMoreTheHigherTheSunBehindAWall)
{
    const Terrain terrain = wall(200, 4.0);
    VisibleFraction before(41, 200, 0.0f);
    for (double altitude = 5.0; altitude < 30.0; altitude += 0.39) {
        const VisibleFraction seen = visible_fraction(
            terrain, {.azimuth = 270_deg, .altitude = Angle::from_degrees(altitude)}, GetParam());
        for (std::size_t i = 10 * 200; i < 31 * 200; ++i) // the ends of the wall are seen from elsewhere
            ASSERT_GE(seen.values()[i], before.values()[i] - 1e-6f) << altitude << ", cell " << i;
        before = seen.copy();
    }
}

TEST_P(SoftByEveryCaster, TurnsAndMirrorsWithTheTerrain)
{
    for_seeds(12, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = GetParam().exact, .holes = GetParam().exact});
        const DirectionalLight light = random_light(dice);
        const VisibleFraction seen = visible_fraction(terrain, light, GetParam());
        const Terrain turned_terrain = turned(terrain);
        const Terrain mirrored_terrain = mirrored(terrain);
        const VisibleFraction of_turned = visible_fraction(turned_terrain, turned(light), GetParam());
        const VisibleFraction of_mirrored = visible_fraction(mirrored_terrain, mirrored(light), GetParam());
        // Azimuths of slices are rounded: a horizon may jump a hair sooner.
        EXPECT_LT(fraction_error(of_turned, turned(seen)).mean, 2e-3);
        EXPECT_LT(fraction_error(of_mirrored, mirrored(seen)).mean, 2e-3);
    });
}

TEST_P(SoftByEveryCaster, IsAboutTheMaskOnTheWhole)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    const Terrain terrain = make_mountains({.grid = {200, 200, {30.0, 30.0}}, .seed = 2});
    const DirectionalLight light = {.azimuth = 100.3_deg, .altitude = 12_deg};
    const VisibleFraction seen = visible_fraction(terrain, light, GetParam());
    const ShadowMask mask = GetParam().cast(terrain, light, {});
    double seen_sum = 0.0;
    double lit_sum = 0.0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        seen_sum += seen.values()[i];
        lit_sum += mask.values()[i] == Lit::yes ? 1.0 : 0.0;
    }
    EXPECT_NEAR(seen_sum / lit_sum, 1.0, 0.01);
    EXPECT_GT(lit_sum, 1000.0);
}

TEST_P(SoftByEveryCaster, NoDataIsNotANumberAndHidesNothing)
{
    Terrain terrain = wall(300, 2.0);
    for (std::size_t y = 0; y < 41; ++y)
        terrain.heights_m(y, 0) = kNan;
    terrain.heights_m(7, 100) = kNan;
    const VisibleFraction seen =
        visible_fraction(terrain, {.azimuth = 270_deg, .altitude = 20_deg}, GetParam());
    for (std::size_t y = 0; y < 41; ++y)
        for (std::size_t x = 0; x < 300; ++x)
            ASSERT_TRUE(std::isnan(terrain.heights_m(y, x)) ? std::isnan(seen(y, x)) : seen(y, x) == 1.0f);
}

TEST_P(SoftByEveryCaster, TheSmallestGridsHaveHalfShadowsToo)
{
    const DirectionalLight light = {.azimuth = 270_deg, .altitude = 45_deg};
    const Terrain one{Grid<float>(1, 1, 5.0f), {1.0, 1.0}};
    EXPECT_EQ(visible_fraction(one, light, GetParam())(0, 0), 1.0f);
    EXPECT_EQ(visible_fraction(HeightField{}, light, GetParam()).size(), 0U);
    Terrain row{Grid<float>(1, 30, 0.0f), {1.0, 1.0}};
    row.heights_m(0, 0) = 10.0f;
    // One row is no wall: only the sun's middle is behind it, when light is exactly along it. All slices but the
    // middle one pass it by.
    const VisibleFraction seen = visible_fraction(row, light, GetParam());
    EXPECT_EQ(seen(0, 29), 1.0f);
    EXPECT_LT(seen(0, 5), 1.0f);
    Terrain column{Grid<float>(30, 1, 0.0f), {1.0, 1.0}};
    column.heights_m(0, 0) = 10.0f;
    EXPECT_EQ(visible_fraction(column, {.azimuth = 0_deg, .altitude = 45_deg}, GetParam())(29, 0), 1.0f);
}

TEST_P(SoftByEveryCaster, GivesTheSameBytesForAnyNumberOfThreads)
{
    const Terrain terrain = make_mountains({.grid = {150, 170, {30.0, 30.0}}, .seed = 3});
    const DirectionalLight light = {.azimuth = 289.7_deg, .altitude = 9_deg};
    EXPECT_TRUE(same_bits(visible_fraction(terrain, light, GetParam(), {.threads = 1}),
                          visible_fraction(terrain, light, GetParam(), {.threads = 5})));
}

TEST(SoftShadows, AreTheSameByAllExactCasters)
{
    const Terrain terrain = make_mountains({.grid = {90, 80, {30.0, 30.0}}, .seed = 4});
    const DirectionalLight light = {.azimuth = 31_deg, .altitude = 15_deg};
    const VisibleFraction by_ray = soft(terrain, light, "ray");
    for (const char* name : {"fast-ray", "exact"}) {
        const FractionError error = fraction_error(soft(terrain, light, name), by_ray);
        EXPECT_LT(error.worst, 1e-6) << name;
    }
}

TEST(SoftShadows, CanBeCancelledAndReportProgress)
{
    const Terrain terrain = make_mountains({.grid = {90, 80, {30.0, 30.0}}, .seed = 4});
    double last = 0.0;
    visible_fraction(terrain, {}, caster_named("exact"), {.threads = 1, .progress = [&](double done) {
                                                              EXPECT_GE(done, last);
                                                              last = done;
                                                              return true;
                                                          }});
    EXPECT_NEAR(last, 1.0, 1e-12);
    EXPECT_THROW(visible_fraction(terrain, {}, caster_named("exact"),
                                  {.threads = 1, .progress = [](double) { return false; }}),
                 Cancelled);
}

TEST(SoftShadows, RefuseAnglesOutOfRange)
{
    const Terrain plain{Grid<float>(3, 3, 0.0f), {1.0, 1.0}};
    EXPECT_THROW(soft(plain, {.altitude = 91_deg}), InvalidInput);
    EXPECT_THROW(soft(plain, {.angular_diameter = 181_deg}), InvalidInput);
    EXPECT_THROW(soft(plain, {.angular_diameter = Angle::from_degrees(kNan)}), InvalidInput);
}

} // namespace
} // namespace duskline
