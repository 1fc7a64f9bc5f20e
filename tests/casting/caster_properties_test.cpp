// What every caster must satisfy, whatever its method: written over kCasters, so that a new caster is
// tested by being in the table. What a caster that is not the truth may get wrong is said in
// mask_assertions.h.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/casters.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class EveryCaster : public testing::TestWithParam<Caster> {
protected:
    // Spikes and cliffs a cell wide cast shadows a cell wide, of which an inexact caster may keep nothing.
    RandomTerrainOptions terrains() const { return {.rough = GetParam().exact, .holes = GetParam().exact}; }

    ShadowMask cast(const HeightField& field, const DirectionalLight& light) const
    {
        return GetParam().cast(field, light, {.threads = 1});
    }

    Grid<char> excused(const HeightField& field, const DirectionalLight& light) const
    {
        return excuses(GetParam(), field, light);
    }
};

INSTANTIATE_TEST_SUITE_P(All, EveryCaster, testing::ValuesIn(kCasters), test_name);

TEST_P(EveryCaster, AgreesWithTheRay)
{
    for_seeds(120, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        EXPECT_TRUE(same_mask(cast(terrain, light), cast_by_ray(terrain, light), excused(terrain, light)))
            << "azimuth " << light.azimuth.degrees() << ", altitude " << light.altitude.degrees();
    });
}

TEST_P(EveryCaster, AMaskIsWhatItsShadowHeightsMean)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        EXPECT_TRUE(
            same_mask(mask_of(terrain, GetParam().shadow_heights(terrain, light, {})), cast(terrain, light)));
    });
}

TEST_P(EveryCaster, APlaneThatTheLightReachesIsLitEverywhere)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    for_seeds(40, [&](Dice& dice) {
        DirectionalLight light = random_light(dice);
        light.altitude = Angle::from_degrees(dice.between(2.0, 88.0));
        const double slope = dice.between(0.0, light.altitude.degrees() - 1.0);
        const Terrain plane = make_plane({.grid = {.rows = 40, .columns = 33, .cell_size_m = {30.0, 20.0}},
                                          .slope = Angle::from_degrees(slope),
                                          .aspect = Angle::from_degrees(dice.between(0.0, 360.0))});
        EXPECT_TRUE(same_mask(cast(plane, light), ShadowMask(40, 33, Lit::yes)));
    });
}

TEST_P(EveryCaster, RaisingTheSunAddsNoShadow)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, terrains());
        const DirectionalLight low = random_light(dice);
        DirectionalLight high = low;
        high.altitude = Angle::from_degrees(dice.between(low.altitude.degrees(), 90.0));
        EXPECT_TRUE(no_new_shadow(cast(terrain, low), cast(terrain, high), excused(terrain, high)));
    });
}

TEST_P(EveryCaster, RaisingACellLightsNoOther)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain before = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        Terrain after = copy_of(before);
        const std::size_t row = dice.below(after.heights_m.rows());
        const std::size_t column = dice.below(after.heights_m.columns());
        after.heights_m(row, column) += static_cast<float>(dice.between(1.0, 500.0));
        Grid<char> excused_cells = excused(after, light);
        excused_cells(row, column) = 1;
        // Light that comes is shadow that goes.
        EXPECT_TRUE(no_new_shadow(cast(after, light), cast(before, light), excused_cells));
    });
}

TEST_P(EveryCaster, RemovingTerrainAddsNoShadow)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain before = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        Terrain after = copy_of(before);
        const std::size_t row = dice.below(after.heights_m.rows());
        const std::size_t column = dice.below(after.heights_m.columns());
        for (std::size_t y = row; y < std::min(row + 6, after.heights_m.rows()); ++y)
            for (std::size_t x = column; x < std::min(column + 6, after.heights_m.columns()); ++x)
                after.heights_m(y, x) = kNan;
        EXPECT_TRUE(no_new_shadow(cast(before, light), cast(after, light), excused(after, light)));
    });
}

TEST_P(EveryCaster, LiftingTheWholeTerrainChangesNothing)
{
    for_seeds(40, [&](Dice& dice) {
        RandomTerrainOptions options = terrains();
        options.eighths = true; // so that the lifted heights are exact
        const Terrain terrain = random_terrain(dice, options);
        const DirectionalLight light = random_light(dice);
        Terrain lifted = copy_of(terrain);
        for (float& height_m : lifted.heights_m.values())
            height_m += 1024.0f;
        EXPECT_TRUE(same_mask(cast(lifted, light), cast(terrain, light), excused(lifted, light)));
    });
}

TEST_P(EveryCaster, TwiceTheHeightsAndTwiceTheCellsAreTheSameToTheBit)
{
    for_seeds(40, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        Terrain twice = copy_of(terrain);
        for (float& height_m : twice.heights_m.values())
            height_m *= 2.0f;
        twice.cell_size_m = {2.0 * terrain.cell_size_m.x, 2.0 * terrain.cell_size_m.y};
        EXPECT_TRUE(same_mask(cast(twice, light), cast(terrain, light)));
        ShadowField halved = GetParam().shadow_heights(twice, light, {});
        for (float& height_m : halved.values())
            height_m /= 2.0f;
        EXPECT_TRUE(same_bits(halved, GetParam().shadow_heights(terrain, light, {})));
    });
}

TEST_P(EveryCaster, TwiceTheHeightsNeedTwiceTheTangentOfTheSun)
{
    for_seeds(40, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        Terrain steep = copy_of(terrain);
        for (float& height_m : steep.heights_m.values())
            height_m *= 2.0f;
        DirectionalLight high = light;
        high.altitude = Angle::from_radians(std::atan(2.0 * tangent(light.altitude)));
        Grid<char> excused_cells = excused(steep, high);
        // The angle is rounded: cells in balance to the last bit of a double may tip.
        const ShadowField shadows = shadow_heights_by_fast_ray(steep, high);
        for (std::size_t i = 0; i < shadows.size(); ++i)
            if (std::abs(shadows.values()[i] - steep.heights_m.values()[i]) < 1e-3f)
                excused_cells.values()[i] = 1;
        EXPECT_TRUE(same_mask(cast(steep, high), cast(terrain, light), excused_cells));
    });
}

TEST_P(EveryCaster, TurningTerrainAndLightTurnsTheMask)
{
    for_seeds(60, [&](Dice& dice) {
        Terrain terrain = random_terrain(dice, terrains());
        DirectionalLight light = random_light(dice);
        for (int quarter = 0; quarter < 4; ++quarter) {
            Terrain next = turned(terrain);
            const DirectionalLight next_light = turned(light);
            EXPECT_TRUE(
                same_mask(cast(next, next_light), turned(cast(terrain, light)), excused(next, next_light)))
                << "from azimuth " << light.azimuth.degrees();
            terrain = std::move(next);
            light = next_light;
        }
    });
}

TEST_P(EveryCaster, MirroringTerrainAndLightMirrorsTheMask)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        const Terrain other = mirrored(terrain);
        const DirectionalLight other_light = mirrored(light);
        EXPECT_TRUE(
            same_mask(cast(other, other_light), mirrored(cast(terrain, light)), excused(other, other_light)))
            << "azimuth " << light.azimuth.degrees();
    });
}

TEST_P(EveryCaster, AFrameOfNoDataIsTheSameAsNone)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, terrains());
        const DirectionalLight light = random_light(dice);
        const Terrain framed = framed_by_no_data(terrain, 2);
        const ShadowMask mask = cast(framed, light);
        ShadowMask inside(terrain.heights_m.rows(), terrain.heights_m.columns());
        for (std::size_t row = 0; row < mask.rows(); ++row)
            for (std::size_t column = 0; column < mask.columns(); ++column) {
                if (row - 2 < inside.rows() && column - 2 < inside.columns())
                    inside(row - 2, column - 2) = mask(row, column);
                else
                    EXPECT_EQ(mask(row, column), Lit::unknown);
            }
        EXPECT_TRUE(same_mask(inside, cast(terrain, light), excused(terrain, light)));
    });
}

TEST_P(EveryCaster, NoDataStaysNoDataAndEverythingElseIsKnown)
{
    for_seeds(30, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        for (const DirectionalLight& light : {random_light(dice), DirectionalLight{.altitude = 0_deg},
                                              DirectionalLight{.altitude = 90_deg}}) {
            const ShadowMask mask = cast(terrain, light);
            const ShadowField shadows = GetParam().shadow_heights(terrain, light, {});
            for (std::size_t i = 0; i < mask.size(); ++i) {
                const bool missing = std::isnan(terrain.heights_m.values()[i]);
                EXPECT_EQ(mask.values()[i] == Lit::unknown, missing);
                EXPECT_EQ(std::isnan(shadows.values()[i]), missing);
            }
        }
    });
}

TEST_P(EveryCaster, AHoleBesideTheLightsPathHidesNothingAndAHoleInTheWallLetsLightThrough)
{
    for (const Angle azimuth : {0_deg, 90_deg, 180_deg, 270_deg}) {
        Terrain wall =
            make_wall({.grid = {.rows = 41, .columns = 41}, .course = azimuth + 90_deg, .thickness_m = 3.0});
        const DirectionalLight light{.azimuth = azimuth, .altitude = 43_deg};
        const ShadowMask before = cast(wall, light);
        const bool across_rows = azimuth == 0_deg || azimuth == 180_deg;
        // A gap of five cells through the whole wall.
        for (std::size_t along = 18; along <= 22; ++along)
            for (std::size_t across = 19; across <= 21; ++across)
                (across_rows ? wall.heights_m(across, along) : wall.heights_m(along, across)) = kNan;
        const ShadowMask after = cast(wall, light);
        for (std::size_t row = 0; row < 41; ++row)
            for (std::size_t column = 0; column < 41; ++column) {
                const std::size_t along = across_rows ? column : row;
                const bool gap = along >= 18 && along <= 22;
                if (std::isnan(wall.heights_m(row, column)))
                    EXPECT_EQ(after(row, column), Lit::unknown);
                else
                    EXPECT_EQ(after(row, column), gap ? Lit::yes : before(row, column))
                        << row << ' ' << column;
            }
    }
}

TEST_P(EveryCaster, AtNightNothingIsLitAndUnderAnOverheadSunEverything)
{
    const Terrain cone = make_cone({.grid = {.rows = 9, .columns = 9}, .height_m = 3.0, .slope = 80_deg});
    for (const double altitude : {0.0, -0.0, -1e-9, -45.0, -90.0}) {
        const DirectionalLight light{.azimuth = 17_deg, .altitude = Angle::from_degrees(altitude)};
        EXPECT_TRUE(same_mask(cast(cone, light), ShadowMask(9, 9, Lit::no)));
        EXPECT_TRUE(same_bits(GetParam().shadow_heights(cone, light, {}), ShadowField(9, 9, kInfinity)));
    }
    const DirectionalLight noon{.azimuth = 17_deg, .altitude = 90_deg};
    EXPECT_TRUE(same_mask(cast(cone, noon), ShadowMask(9, 9, Lit::yes)));
    EXPECT_TRUE(same_bits(GetParam().shadow_heights(cone, noon, {}), ShadowField(9, 9, -kInfinity)));
}

TEST_P(EveryCaster, ASunAtTheHorizonAndOneNearTheZenithAreNoTrap)
{
    const Terrain wall = make_wall({.grid = {.rows = 65, .columns = 65}, .thickness_m = 3.0});
    for (const double azimuth : {0.0, 1e-9, 45.0, 90.0, 90.0 - 1e-9, 225.0, 300.1}) {
        const bool along_wall = std::abs(std::sin(azimuth * std::numbers::pi / 180.0)) < 1e-6;
        const bool from_east = azimuth < 180.0;
        const ShadowMask low =
            cast(wall, {.azimuth = Angle::from_degrees(azimuth), .altitude = Angle::from_degrees(1e-6)});
        const ShadowMask high =
            cast(wall, {.azimuth = Angle::from_degrees(azimuth), .altitude = Angle::from_degrees(89.999)});
        EXPECT_TRUE(same_mask(high, ShadowMask(65, 65, Lit::yes))) << azimuth;
        EXPECT_EQ(low(32, from_east ? 10 : 54), along_wall ? Lit::yes : Lit::no) << azimuth;
        EXPECT_EQ(low(32, from_east ? 54 : 10), Lit::yes) << azimuth;
        EXPECT_EQ(low(32, 32), Lit::yes) << azimuth;
    }
}

TEST_P(EveryCaster, TheSmallestGridsWork)
{
    const DirectionalLight light{.azimuth = 203_deg, .altitude = 10_deg};
    EXPECT_TRUE(cast({}, light).empty());
    EXPECT_TRUE(cast({{nullptr, 0, 5}, {}}, light).empty());
    EXPECT_TRUE(cast({{nullptr, 5, 0}, {}}, light).empty());
    EXPECT_TRUE(GetParam().shadow_heights({}, light, {}).empty());
    const Terrain one{Grid<float>(1, 1, 7.0f), {1.0, 1.0}};
    EXPECT_TRUE(same_mask(cast(one, light), ShadowMask(1, 1, Lit::yes)));
    EXPECT_TRUE(same_bits(GetParam().shadow_heights(one, light, {}), ShadowField(1, 1, -kInfinity)));
    const Terrain hole{Grid<float>(1, 1, kNan), {1.0, 1.0}};
    EXPECT_TRUE(same_mask(cast(hole, light), ShadowMask(1, 1, Lit::unknown)));
    const Terrain holes{Grid<float>(7, 5, kNan), {1.0, 1.0}};
    EXPECT_TRUE(same_mask(cast(holes, light), ShadowMask(7, 5, Lit::unknown)));
}

TEST_P(EveryCaster, ALineOfCellsShadesAlongItselfAndNotAcross)
{
    Terrain line{Grid<float>(1, 30, 0.0f), {1.0, 1.0}};
    line.heights_m(0, 20) = 9.5f;
    Terrain column{turned(line.heights_m), {1.0, 1.0}}; // the tower is at row 20
    for (const auto& [azimuth, along] :
         {std::pair{90.0, true}, {0.0, false}, {180.0, false}, {45.0, false}}) {
        DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 45_deg};
        for (std::size_t i = 0; i < 30; ++i) {
            const Lit expected = along && i >= 11 && i < 20 ? Lit::no : Lit::yes;
            EXPECT_EQ(cast(line, light)(0, i), expected) << "column " << i << ", azimuth " << azimuth;
            light.azimuth = Angle::from_degrees(azimuth + 90.0);
            EXPECT_EQ(cast(column, light)(i, 0), expected) << "row " << i << ", azimuth " << azimuth + 90.0;
            light.azimuth = Angle::from_degrees(azimuth);
        }
    }
}

TEST_P(EveryCaster, AWallIsWatertightAtEveryAzimuth)
{
    // The thinnest wall that a caster owes: one cell for the exact ones; those that look only at samples
    // along one family of lines find every wall whose samples overlap on them, which two cells do.
    const double thickness_m = GetParam().exact ? 1.0 : 2.5;
    const Terrain north_south =
        make_wall({.grid = {.rows = 61, .columns = 61}, .height_m = 400.0, .thickness_m = thickness_m});
    const Terrain east_west = turned(north_south);
    for_seeds(GetParam().name == "ray" ? 400 : 1500, [&](Dice& dice) {
        const double from_normal = dice.between(-44.0, 44.0);
        const double side = dice.chance(0.5) ? 90.0 : 270.0;
        const DirectionalLight light{.azimuth = Angle::from_degrees(side + from_normal), .altitude = 30_deg};
        const ShadowMask a = cast(north_south, light);
        const ShadowMask b = cast(east_west, turned(light));
        // Near the middle of the wall, where no ray passes its ends; 27 cells away the shadow is still 380
        // m high.
        for (std::size_t along = 29; along <= 31; ++along)
            for (std::size_t away = 4; away <= 26; ++away) {
                const std::size_t far = side == 90.0 ? 30 - away : 30 + away;
                const std::size_t near = side == 90.0 ? 30 + away : 30 - away;
                ASSERT_EQ(a(along, far), Lit::no) << light.azimuth.degrees();
                ASSERT_EQ(b(far, along), Lit::no) << light.azimuth.degrees();
                ASSERT_EQ(a(along, near), Lit::yes) << light.azimuth.degrees();
            }
    });
}

TEST_P(EveryCaster, TheOutermostCellsAreShadedToo)
{
    // Light along rows and columns, or a hair beside: the shadow of a wall from border to border has no gap.
    const Terrain wall = make_wall({.grid = {.rows = 31, .columns = 31}, .thickness_m = 3.0});
    for (int quarter = 0; quarter < 4; ++quarter)
        for (const double beside : {0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-7, -1e-7}) {
            Terrain terrain = copy_of(wall);
            for (int i = 0; i < quarter; ++i)
                terrain = turned(terrain);
            const ShadowMask mask = cast(
                terrain, {.azimuth = Angle::from_degrees(90.0 * (quarter + 1) + beside), .altitude = 44_deg});
            ShadowMask upright = mask.copy();
            for (int i = quarter; i < 4; ++i)
                upright = turned(upright);
            for (std::size_t row = 0; row < 31; ++row)
                for (std::size_t column = 0; column < 31; ++column)
                    EXPECT_EQ(upright(row, column), column >= 4 && column < 14 ? Lit::no : Lit::yes)
                        << row << ' ' << column << ", quarter " << quarter << ", beside " << beside;
        }
}

TEST_P(EveryCaster, AHairBesideAnAxisOrDiagonalIsLikeOnIt)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 90, .columns = 90, .cell_size_m = {75.0, 75.0}}, .seed = 3});
    for (int eighth = 0; eighth < 8; ++eighth) {
        const DirectionalLight on{.azimuth = Angle::from_degrees(45.0 * eighth), .altitude = 21.7_deg};
        const ShadowMask expected = cast_by_fast_ray(terrain, on);
        const std::size_t dark = static_cast<std::size_t>(std::ranges::count(expected.values(), Lit::no));
        EXPECT_GT(dark, 400U);
        for (const double beside : {1e-9, -1e-9}) {
            DirectionalLight light = on;
            light.azimuth = Angle::from_degrees(45.0 * eighth + beside);
            EXPECT_TRUE(same_mask(cast(terrain, light), expected, excused(terrain, on)))
                << light.azimuth.degrees();
        }
    }
}

TEST_P(EveryCaster, AzimuthsAFullTurnApartAreTheSame)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 50, .columns = 60, .cell_size_m = {75.0, 75.0}}});
    const ShadowMask expected = cast(terrain, {.azimuth = 5_deg, .altitude = 20_deg});
    for (const double azimuth : {725.0, 365.0, -355.0, 360e6 + 5.0})
        EXPECT_TRUE(same_mask(cast(terrain, {.azimuth = Angle::from_degrees(azimuth), .altitude = 20_deg}),
                              expected));
}

TEST_P(EveryCaster, ThreadsDoNotChangeABit)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 150, .columns = 211, .cell_size_m = {40.0, 75.0}}});
    for (const double azimuth : {0.0, 45.0, 100.3, 203.0, 270.0}) {
        const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 12_deg};
        const ShadowMask mask = cast(terrain, light);
        const ShadowField shadows = GetParam().shadow_heights(terrain, light, {.threads = 1});
        for (const std::size_t threads : {2U, 3U, 0U}) {
            EXPECT_TRUE(same_mask(GetParam().cast(terrain, light, {.threads = threads}), mask));
            EXPECT_TRUE(same_bits(GetParam().shadow_heights(terrain, light, {.threads = threads}), shadows));
        }
    }
}

TEST_P(EveryCaster, AWindowOfALargerGridIsAsGoodAsACopy)
{
    for_seeds(30, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 12});
        const HeightField whole = terrain;
        const HeightField window = whole.window(3, 1, whole.rows() - 5, whole.columns() - 4);
        const Terrain copy = copy_of(window);
        const DirectionalLight light = random_light(dice);
        EXPECT_TRUE(same_mask(cast(window, light), cast(copy, light)));
        EXPECT_TRUE(same_bits(GetParam().shadow_heights(window, light, {}),
                              GetParam().shadow_heights(copy, light, {})));
    });
}

TEST_P(EveryCaster, ProgressNeverFallsAndEndsAtOne)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 120, .columns = 90, .cell_size_m = {75.0, 75.0}}});
    for (const double azimuth : {10.0, 100.0})
        for (const std::size_t threads : {1U, 3U}) {
            double last = 0.0;
            const auto progress = [&](double done) {
                EXPECT_GE(done, last);
                EXPECT_LE(done, 1.0);
                last = done;
                return true;
            };
            const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 12_deg};
            GetParam().cast(terrain, light, {.threads = threads, .progress = progress});
            EXPECT_EQ(last, 1.0);
            last = 0.0;
            GetParam().shadow_heights(terrain, light, {.threads = threads, .progress = progress});
            EXPECT_EQ(last, 1.0);
        }
}

TEST_P(EveryCaster, CancellingEndsTheWork)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 120, .columns = 90, .cell_size_m = {75.0, 75.0}}});
    for (const std::size_t threads : {1U, 3U}) {
        const Execution execution{.threads = threads, .progress = [](double) { return false; }};
        EXPECT_THROW(GetParam().cast(terrain, {.altitude = 12_deg}, execution), Cancelled);
        EXPECT_THROW(GetParam().shadow_heights(terrain, {.altitude = 12_deg}, execution), Cancelled);
    }
}

TEST_P(EveryCaster, ValuesOutOfRangeAreRefused)
{
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    const Angle nan = Angle::from_degrees(std::nan(""));
    EXPECT_THROW(cast(flat, {.azimuth = nan}), InvalidInput);
    EXPECT_THROW(cast(flat, {.azimuth = Angle::from_degrees(kInfinity)}), InvalidInput);
    EXPECT_THROW(cast(flat, {.altitude = nan}), InvalidInput);
    EXPECT_THROW(cast(flat, {.altitude = 90.1_deg}), InvalidInput);
    EXPECT_THROW(cast(flat, {.altitude = -90.1_deg}), InvalidInput);
    for (const CellSize cell :
         {CellSize{0.0, 1.0}, CellSize{1.0, -2.0}, CellSize{std::nan(""), 1.0}, CellSize{1.0, kInfinity}}) {
        EXPECT_THROW(cast({flat.heights_m.view(), cell}, {}), InvalidInput);
        EXPECT_THROW(GetParam().shadow_heights({flat.heights_m.view(), cell}, {}, {}), InvalidInput);
    }
}

TEST_P(EveryCaster, HostileHeightsDoNoHarm)
{
    // Not heights, and nothing is promised but an end, and an answer where there is data.
    Terrain terrain = make_mountains({.grid = {.rows = 33, .columns = 47, .cell_size_m = {75.0, 75.0}}});
    constexpr float nasty[] = {kInfinity,
                               -kInfinity,
                               kNan,
                               std::numeric_limits<float>::max(),
                               std::numeric_limits<float>::lowest(),
                               std::numeric_limits<float>::denorm_min(),
                               -0.0f};
    Dice dice(1);
    for (float& height_m : terrain.heights_m.values())
        if (dice.chance(0.1))
            height_m = nasty[dice.below(7)];
    for (const double azimuth : {0.0, 45.0, 100.3, 203.0}) {
        const ShadowMask mask = cast(terrain, {.azimuth = Angle::from_degrees(azimuth), .altitude = 5_deg});
        for (std::size_t i = 0; i < mask.size(); ++i)
            EXPECT_EQ(mask.values()[i] == Lit::unknown, std::isnan(terrain.heights_m.values()[i]));
    }
}

TEST(Casters, AreFoundByName)
{
    EXPECT_EQ(caster_named("ray").cast, decltype(Caster::cast){cast_by_ray});
    EXPECT_EQ(caster_named("fast-ray").cast, decltype(Caster::cast){cast_by_fast_ray});
    EXPECT_EQ(kCasters.front().name, "ray") << "the reference comes first";
    try {
        caster_named("rays");
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()).rfind("no caster is called 'rays'; there are: ray, fast-ray", 0),
                  0U);
    }
}

} // namespace
} // namespace duskline
