#include "terrains.h"

#include <duskline/casting/casters.h>
#include <duskline/casting/finer_mask.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/refined.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(FinerMask, AWallsShadowEndsWithinTheCellWhereItDoes)
{
    // 10 m under 45 degrees, the wall at cell 32 falling to 0 within a cell: lit again 10 m before its foot.
    const Terrain wall =
        make_wall({.grid = {.rows = 9, .columns = 65, .cell_size_m = {4.0, 4.0}}, .height_m = 10.0});
    const DirectionalLight light{.azimuth = 90_deg, .altitude = 45_deg};
    const Terrain finer = refined(wall, 72, 8 * 65);
    const ShadowMask mask = finer_mask(wall, cast_by_exact(wall, light), light, finer);
    std::size_t dark = 0;
    for (std::size_t x = 0; x < mask.columns(); ++x)
        dark += mask(36, x) == Lit::no ? 1U : 0U;
    // From 10 m west of the crest to the crest, in finer cells of half a metre.
    EXPECT_NEAR(static_cast<double>(dark), 20.0, 1.0);
}

TEST(FinerMask, IsTheRaysAnswerFromTheGroundUnderEveryCentre)
{
    std::size_t cells = 0;
    std::size_t edges = 0;
    std::size_t differ = 0;
    for_seeds(12, [&](Dice& dice) {
        const Terrain terrain =
            random_terrain(dice, {.smallest = 20, .largest = 40, .rough = false, .holes = false});
        const DirectionalLight light = random_sun(dice, terrain.cell_size_m);
        const ShadowMask mask = cast_by_exact(terrain, light);
        const Terrain finer = refined(terrain, 2 * terrain.heights_m.rows(), 4 * terrain.heights_m.columns());
        const ShadowMask result = finer_mask(terrain, mask, light, finer, {.threads = 2});
        const TerrainRays rays(terrain);
        for (std::size_t y = 0; y < result.rows(); ++y)
            for (std::size_t x = 0; x < result.columns(); ++x) {
                const double row = finer_place(y, result.rows(), mask.rows()).place;
                const double column = finer_place(x, result.columns(), mask.columns()).place;
                const auto ground_m = ground_height_m(terrain, row, column);
                if (!ground_m)
                    continue;
                const bool dark = rays.is_shadowed({row, column, *ground_m}, light);
                ++cells;
                edges += dark != (mask(y / 2, x / 4) == Lit::no) ? 1U : 0U;
                differ += dark != (result(y, x) == Lit::no) ? 1U : 0U;
            }
    });
    EXPECT_GT(edges, cells / 100);
    EXPECT_LT(differ, edges / 20) << "only what is narrower than a cell may be missed";
}

TEST(FinerMask, OnTheSameCellsItIsTheMask)
{
    for_seeds(10, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = false});
        const DirectionalLight light = random_sun(dice, terrain.cell_size_m);
        const ShadowMask mask = cast_by_ray(terrain, light);
        const ShadowMask same = finer_mask(terrain, mask, light, terrain);
        for (std::size_t i = 0; i < mask.size(); ++i)
            ASSERT_EQ(same.values()[i], mask.values()[i]) << i;
    });
}

TEST(FinerMask, TakesALampAtItsPlaceOverTheTerrain)
{
    // The lamp stands 12 m over the ground, the wall of 6 m is 12 m away: its shadow reaches 12 m beyond.
    const Terrain wall =
        make_wall({.grid = {.rows = 9, .columns = 65, .cell_size_m = {4.0, 4.0}}, .height_m = 6.0});
    const PointLight lamp{{4.0, 35.0, 12.0}};
    const Terrain finer = refined(wall, 9, 8 * 65);
    const ShadowMask mask = finer_mask(wall, cast_by_ray(wall, lamp), lamp, finer);
    const auto at_m = [](double metres_west_of_wall) {
        return static_cast<std::size_t>((32.5 - metres_west_of_wall / 4.0) * 8.0);
    };
    EXPECT_EQ(mask(4, at_m(11.0)), Lit::no);
    EXPECT_EQ(mask(4, at_m(13.0)), Lit::yes);
}

TEST(FinerMask, NoDataStaysUnknownAndSizesMustFit)
{
    Terrain terrain = make_plane({.grid = {.rows = 4, .columns = 4}});
    terrain.heights_m(1, 2) = std::nanf("");
    const DirectionalLight light;
    const ShadowMask mask = cast_by_ray(terrain, light);
    const Terrain finer = refined(terrain, 8, 8);
    const ShadowMask result = finer_mask(terrain, mask, light, finer);
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x)
            EXPECT_EQ(result(y, x), y / 2 == 1 && x / 2 == 2 ? Lit::unknown : Lit::yes);
    EXPECT_THROW(finer_mask(finer, mask, light, finer), InvalidInput);
    EXPECT_THROW(finer_mask(finer, result, light, terrain), InvalidInput);
}

// In how many finer cells a mask is not what rays from their ground say.
struct Differences {
    std::size_t cells = 0;
    std::size_t finer = 0;     // finer_mask
    std::size_t blown_up = 0;  // the mask, every cell repeated
    std::size_t resampled = 0; // a caster on the ground's finer samples

    static double percent(std::size_t part, std::size_t all)
    {
        return 100.0 * static_cast<double>(part) / static_cast<double>(all);
    }
    std::string in_words() const
    {
        return std::to_string(percent(finer, cells)) + " % of finer cells differ, blown up "
               + std::to_string(percent(blown_up, cells)) + " %, resampled "
               + std::to_string(percent(resampled, cells)) + " %";
    }
};

Differences differences_on(const Terrain& terrain, const DirectionalLight& light, std::size_t factor)
{
    const std::size_t rows = factor * terrain.heights_m.rows();
    const std::size_t columns = factor * terrain.heights_m.columns();
    const Terrain samples = refined(terrain, rows, columns);
    const ShadowMask mask = cast_by_exact(terrain, light);
    const ShadowMask finer = finer_mask(terrain, mask, light, samples);
    const ShadowMask resampled = cast_by_exact(samples, light);
    const TerrainRays rays(terrain);
    Differences differ;
    for (std::size_t y = factor; y + factor < rows; ++y)
        for (std::size_t x = factor; x + factor < columns; ++x) {
            const double row = finer_place(y, rows, mask.rows()).place;
            const double column = finer_place(x, columns, mask.columns()).place;
            const double ground_m = ground_height_m(terrain, row, column).value();
            const Lit truth = rays.is_shadowed({row, column, ground_m}, light) ? Lit::no : Lit::yes;
            ++differ.cells;
            differ.finer += finer(y, x) != truth ? 1U : 0U;
            differ.blown_up += mask(y / factor, x / factor) != truth ? 1U : 0U;
            differ.resampled += resampled(y, x) != truth ? 1U : 0U;
        }
    return differ;
}

TEST(FinerMask, OnMountainsItIsFarCloserToTheTruthThanTheMaskBlownUpOrFinerSamples)
{
    const Terrain terrain = make_mountains({.grid = {150, 150, {30.0, 30.0}}, .seed = 11, .roughness = 0.5});
    for (const double altitude : {8.0, 25.0})
        for (const std::size_t factor : {2U, 3U, 4U}) {
            const Differences differ = differences_on(
                terrain, {.azimuth = 203_deg, .altitude = Angle::from_degrees(altitude)}, factor);
            SCOPED_TRACE(std::to_string(altitude) + " degrees, times " + std::to_string(factor) + ": "
                         + differ.in_words());
            EXPECT_LT(10 * differ.finer, differ.blown_up);
            if (factor % 2 == 0) {
                EXPECT_LT(4 * differ.finer, differ.resampled);
            }
        }
}

} // namespace
} // namespace duskline
