#include "terrains.h"

#include <duskline/terrain/normals.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Normals, HornsWeightsGiveThePublishedSum)
{
    Terrain terrain{Grid<float>(3, 3), {2.0, 5.0}};
    const float heights[] = {1, 2, 4, 8, 16, 32, 64, 128, 256};
    std::copy_n(heights, 9, terrain.heights_m.data());
    const Slope slope = slope_at(terrain, 1, 1);
    EXPECT_DOUBLE_EQ(slope.dz_dx, ((4 + 2 * 32 + 256) - (1 + 2 * 8 + 64)) / 16.0);
    EXPECT_DOUBLE_EQ(slope.dz_dy, ((1 + 2 * 2 + 4) - (64 + 2 * 128 + 256)) / 40.0);
}

TEST(Normals, APlaneHasItsSlopeInEveryCellBordersAndCornersToo)
{
    Terrain terrain = make_plane(
        {.grid = {.rows = 7, .columns = 9, .cell_size_m = {3.0, 7.0}}, .slope = 30_deg, .aspect = 205_deg});
    const SineCosine downhill = sine_cosine(205_deg);
    const double fall = tangent(30_deg);
    for (std::size_t row = 0; row < 7; ++row)
        for (std::size_t column = 0; column < 9; ++column) {
            const Slope slope = slope_at(terrain, row, column);
            EXPECT_NEAR(slope.dz_dx, -fall * downhill.sine, 1e-6) << row << ' ' << column;
            EXPECT_NEAR(slope.dz_dy, -fall * downhill.cosine, 1e-6) << row << ' ' << column;
        }
}

TEST(Normals, APlaneKeepsItsSlopeAroundAHole)
{
    Terrain terrain = make_plane({.grid = {.rows = 7, .columns = 9}, .slope = 30_deg, .aspect = 70_deg});
    terrain.heights_m(3, 4) = kNan;
    const Slope far = slope_at(terrain, 1, 1);
    for (std::size_t row = 2; row <= 4; ++row)
        for (std::size_t column = 3; column <= 5; ++column) {
            const Slope slope = slope_at(terrain, row, column);
            if (row == 3 && column == 4) {
                EXPECT_TRUE(std::isnan(slope.dz_dx) && std::isnan(slope.dz_dy));
                continue;
            }
            EXPECT_NEAR(slope.dz_dx, far.dz_dx, 1e-6) << row << ' ' << column;
            EXPECT_NEAR(slope.dz_dy, far.dz_dy, 1e-6) << row << ' ' << column;
        }
}

TEST(Normals, ALoneCellAndALineOfCellsAreLevelAcross)
{
    const Terrain one{Grid<float>(1, 1, 5.0f), {1.0, 1.0}};
    EXPECT_EQ(slope_at(one, 0, 0).dz_dx, 0.0);
    EXPECT_EQ(slope_at(one, 0, 0).dz_dy, 0.0);
    const Terrain line = make_plane({.grid = {.rows = 1, .columns = 5}, .slope = 45_deg, .aspect = 270_deg});
    for (std::size_t column = 0; column < 5; ++column)
        EXPECT_NEAR(slope_at(line, 0, column).dz_dx, 1.0, 1e-6);
    EXPECT_EQ(slope_at(line, 0, 2).dz_dy, 0.0);
}

TEST(Normals, ARowGivesTheSlopesOfItsCells)
{
    Terrain terrain = make_mountains({.grid = {.rows = 9, .columns = 70, .cell_size_m = {30.0, 20.0}}});
    for (const auto& [row, column] : {std::pair{0, 3}, {4, 4}, {4, 5}, {5, 69}, {8, 30}, {2, 0}})
        terrain.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column)) = kNan;
    const HeightField whole = terrain;
    for (const HeightField& field : {whole, whole.window(1, 2, 6, 60), whole.window(2, 3, 3, 2)}) {
        std::vector<float> east(field.columns());
        std::vector<float> north(field.columns());
        for (std::size_t row = 0; row < field.rows(); ++row) {
            slopes_of_row(field, row, east, north);
            for (std::size_t column = 0; column < field.columns(); ++column) {
                const Slope slope = slope_at(field, row, column);
                const bool missing = std::isnan(field.heights_m(row, column));
                EXPECT_EQ(std::isnan(east[column]), missing) << row << ' ' << column;
                EXPECT_EQ(std::isnan(north[column]), missing) << row << ' ' << column;
                if (!missing) {
                    EXPECT_EQ(east[column], static_cast<float>(slope.dz_dx)) << row << ' ' << column;
                    EXPECT_EQ(north[column], static_cast<float>(slope.dz_dy)) << row << ' ' << column;
                }
            }
        }
    }
}

TEST(Normals, TheNormalStandsOnTheGround)
{
    const Vector3 normal = upward_normal({1.0, -2.0});
    EXPECT_NEAR(length(normal), 1.0, 1e-15);
    EXPECT_NEAR(dot(normal, {1.0, 0.0, 1.0}), 0.0, 1e-15);
    EXPECT_NEAR(dot(normal, {0.0, 1.0, -2.0}), 0.0, 1e-15);
    EXPECT_GT(normal.z, 0.0);
}

TEST(NormalField, HoldsTheUnitNormalsOfHornsSlopesAndNothingWhereThereIsNoData)
{
    for_seeds(10, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const NormalField normals = upward_normals(terrain, {.threads = 2});
        for (std::size_t row = 0; row < terrain.heights_m.rows(); ++row)
            for (std::size_t column = 0; column < terrain.heights_m.columns(); ++column) {
                if (std::isnan(terrain.heights_m(row, column))) {
                    ASSERT_TRUE(std::isnan(normals.east(row, column))
                                && std::isnan(normals.north(row, column))
                                && std::isnan(normals.up(row, column)));
                    continue;
                }
                const Vector3 expected = upward_normal(slope_at(terrain, row, column));
                ASSERT_NEAR(normals.east(row, column), expected.x, 1e-6);
                ASSERT_NEAR(normals.north(row, column), expected.y, 1e-6);
                ASSERT_NEAR(normals.up(row, column), expected.z, 1e-6);
                ASSERT_GT(normals.up(row, column), 0.0f);
            }
    });
}

TEST(PackedNormal, ComesBackWithinTheAngleThatIsPromised)
{
    Dice dice(11);
    double sum_deg = 0.0;
    double worst_deg = 0.0;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
        // Slopes as mountains have them, and cliffs.
        const Vector3 normal = upward_normal({dice.between(-3.0, 3.0), dice.between(-3.0, 3.0)});
        const Vector3 back = unpacked(packed(normal));
        const double error_deg =
            std::asin(std::min(1.0, length(back - normal) / 2.0)) * 360.0 / std::numbers::pi;
        sum_deg += error_deg;
        worst_deg = std::max(worst_deg, error_deg);
    }
    EXPECT_LT(worst_deg, 0.4);
    EXPECT_GT(worst_deg, 0.3);
    EXPECT_NEAR(sum_deg / count, 0.17, 0.01);
}

TEST(PackedNormal, KeepsTheAxesAndNoData)
{
    EXPECT_EQ(packed({0.0, 0.0, 1.0}), (PackedNormal{0, 0, 127}));
    EXPECT_EQ(packed({-1.0, 0.0, 0.0}), (PackedNormal{-127, 0, 0}));
    EXPECT_DOUBLE_EQ(unpacked({0, 0, 127}).z, 1.0);
    EXPECT_EQ(packed(unpacked({0, 0, 0})), (PackedNormal{0, 0, 0}));
    EXPECT_TRUE(std::isnan(unpacked({0, 0, 0}).z));
}

TEST(PackedNormal, AFieldThroughBytesHoldsWhatEachNormalBecomes)
{
    Dice dice(5);
    const Terrain terrain = random_terrain(dice, {.smallest = 20, .largest = 30});
    const NormalField normals = upward_normals(terrain);
    const NormalField back = through_bytes(normals);
    for (std::size_t i = 0; i < normals.up.size(); ++i) {
        const Vector3 expected =
            unpacked(packed({normals.east.values()[i], normals.north.values()[i], normals.up.values()[i]}));
        if (std::isnan(expected.z)) {
            ASSERT_TRUE(std::isnan(back.up.values()[i]));
            continue;
        }
        ASSERT_FLOAT_EQ(back.east.values()[i], static_cast<float>(expected.x));
        ASSERT_FLOAT_EQ(back.north.values()[i], static_cast<float>(expected.y));
        ASSERT_FLOAT_EQ(back.up.values()[i], static_cast<float>(expected.z));
    }
}

} // namespace
} // namespace duskline
