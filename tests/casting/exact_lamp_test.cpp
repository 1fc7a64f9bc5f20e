#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/ray.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace duskline {
namespace {

std::string described(const PointLight& lamp)
{
    return "lamp at row " + std::to_string(lamp.position.row) + ", column "
           + std::to_string(lamp.position.column) + ", " + std::to_string(lamp.position.height_m) + " m";
}

std::size_t differing(const ShadowMask& a, const ShadowMask& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a.values()[i] != b.values()[i];
    return count;
}

TEST(ExactLamp, GivesTheRaysOwnBytesOnSpikesTerracesPlateausAndHoles)
{
    // The same formula decides both. Only where two crossings lie on one straight line may the front take one for the
    // other, which tips a cell whose ground touches its ray to a billionth of a metre.
    std::size_t cells = 0;
    std::size_t ties = 0;
    for_seeds(1000, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = true, .holes = true});
        const PointLight lamp = random_lamp(dice, terrain);
        const ShadowMask truth = cast_by_ray(terrain, lamp, {.threads = 1});
        const ShadowMask mask = cast_by_exact(terrain, lamp, {.threads = 1});
        const TerrainRays rays(terrain, {.threads = 1});
        for (std::size_t row = 0; row < truth.rows(); ++row)
            for (std::size_t column = 0; column < truth.columns(); ++column)
                if (mask(row, column) != truth(row, column)) {
                    const double shadow_m =
                        rays.shadow_height_m(static_cast<double>(row), static_cast<double>(column), lamp);
                    EXPECT_NEAR(terrain.heights_m(row, column), shadow_m, 1e-9) << described(lamp);
                    ++ties;
                }
        cells += truth.size();
    });
    RecordProperty("cells", std::to_string(cells));
    RecordProperty("ties", std::to_string(ties));
    EXPECT_LE(ties, cells / 100'000);
}

TEST(ExactLamp, GivesTheSameBytesOnEverySimdLevelForAnyThreads)
{
    const Terrain terrain = make_mountains({.grid = {533, 611, {30.0, 25.0}}, .seed = 3});
    const HeightField field = terrain;
    for (const GridPoint place : {GridPoint{266.0, 305.0, 40.0}, GridPoint{17.3, 590.8, 5.0},
                                  GridPoint{-120.5, 80.25, 900.0}, GridPoint{5000.0, -7000.0, 12000.0}}) {
        PointLight lamp{place};
        if (const auto ground_m = ground_height_m(field, place.row, place.column))
            lamp.position.height_m += *ground_m;
        const ShadowMask truth = cast_by_fast_ray(terrain, lamp);
        for (const kernels::Kernels& level : kernels::runnable_kernels())
            for (const std::size_t threads : {std::size_t{1}, std::size_t{3}})
                EXPECT_EQ(differing(truth, cast_by_exact(terrain, lamp, {.threads = threads}, level.isa)), 0U)
                    << level.isa << ", " << threads << " threads, " << described(lamp);
    }
    const Terrain flat{Grid<float>(2, 2, 0.0f), {}};
    EXPECT_THROW(cast_by_exact(flat, PointLight{}, {}, "avx1024"), InvalidInput);
    EXPECT_THROW(cast_by_exact(flat, PointLight{{std::nan(""), 0.0, 0.0}}), InvalidInput);
}

TEST(ExactLamp, AWideGridIsCutIntoStripsThatAgree)
{
    // More cells to a line than a strip has, above and below the lamp and beside it.
    for (const bool wide : {true, false}) {
        const SampleGrid grid{wide ? 700U : 3000U, wide ? 3000U : 700U, {30.0, 30.0}};
        const Terrain terrain = make_mountains({.grid = grid, .seed = 8});
        const PointLight lamp{{wide ? 699.5 : 1480.25, wide ? 1520.75 : -3.0, 1400.0}};
        EXPECT_EQ(differing(cast_by_fast_ray(terrain, lamp), cast_by_exact(terrain, lamp)), 0U);
    }
}

TEST(ExactLamp, ShadowHeightsAreTheRays)
{
    std::size_t differ = 0;
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = true, .holes = true});
        const PointLight lamp = random_lamp(dice, terrain);
        const ShadowField truth = shadow_heights_by_ray(terrain, lamp, {.threads = 1});
        const ShadowField shadows = shadow_heights_by_exact(terrain, lamp, {.threads = 1});
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const float expected = truth.values()[i];
            const float actual = shadows.values()[i];
            differ += actual != expected && !(std::isnan(actual) && std::isnan(expected));
            if (std::isfinite(expected)) {
                EXPECT_NEAR(actual, expected, 1e-6 * std::abs(expected) + 1e-5) << described(lamp);
            } else {
                EXPECT_TRUE(std::isnan(expected) ? std::isnan(actual) : actual == expected)
                    << described(lamp);
            }
        }
    });
    EXPECT_LE(differ, 10U) << "all but ties to the bit";
}

TEST(ExactLamp, LongListsOfCandidatesArePruned)
{
    // A plane through the lamp: every line lies on the front, none above it, for ever.
    for (const double slope : {0.0, 0.13}) {
        Terrain plane{Grid<float>(900, 700), {10.0, 10.0}};
        for (std::size_t y = 0; y < 900; ++y)
            for (std::size_t x = 0; x < 700; ++x)
                plane.heights_m(y, x) =
                    static_cast<float>(slope * (static_cast<double>(y) - 400.0))
                    + (slope == 0.0 ? 0.0f : 1e-3f * static_cast<float>((y * 7 + x * 13) % 5));
        const PointLight lamp{{400.0, 350.0, slope == 0.0 ? 0.0 : 1e-3 * ((400 * 7 + 350 * 13) % 5)}};
        const ShadowMask truth = cast_by_fast_ray(plane, lamp);
        EXPECT_LE(differing(truth, cast_by_exact(plane, lamp)), truth.size() / 1000) << slope;
    }
}

TEST(ExactLamp, FarAwayItIsTheSun)
{
    for_seeds(20, [](Dice& dice) {
        const Terrain terrain = make_mountains(
            {.grid = {.rows = 120, .columns = 140, .cell_size_m = {20.0, 20.0}}, .seed = dice.below(1000)});
        const DirectionalLight sun{.azimuth = Angle::from_degrees(dice.between(0.0, 360.0)),
                                   .altitude = Angle::from_degrees(dice.between(3.0, 50.0))};
        const double distance_cells = std::pow(10.0, dice.between(6.0, 11.0));
        const auto [sine, cosine] = sine_cosine(sun.azimuth);
        const PointLight lamp{
            {-cosine * distance_cells, sine * distance_cells, tangent(sun.altitude) * distance_cells * 20.0}};
        const ShadowMask far = cast_by_exact(terrain, lamp);
        EXPECT_TRUE(same_mask(far, cast_by_fast_ray(terrain, lamp)));
        // The rays of a lamp a million cells away are a ten-thousandth of a radian apart.
        EXPECT_LE(differing(far, cast_by_ray(terrain, sun)), far.size() / 500);
    });
}

} // namespace
} // namespace duskline
