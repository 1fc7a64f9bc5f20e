#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/ray.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace duskline {
namespace {

std::size_t differing(const ShadowMask& a, const ShadowMask& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a.values()[i] != b.values()[i];
    return count;
}

TEST(Exact, GivesTheRaysOwnBytesOnSpikesTerracesPlateausAndHoles)
{
    // Not "up to ties": the same formula decides both. Only where two crossings lie on one straight line may the
    // front take one for the other.
    std::size_t cells = 0;
    std::size_t wrong = 0;
    for_seeds(1000, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = true, .holes = true});
        const DirectionalLight light = random_light(dice);
        const ShadowMask truth = cast_by_ray(terrain, light, {.threads = 1});
        const std::size_t differ = differing(cast_by_exact(terrain, light, {.threads = 1}), truth);
        EXPECT_LE(differ, truth.size() / 1000)
            << "azimuth " << light.azimuth.degrees() << ", altitude " << light.altitude.degrees();
        cells += truth.size();
        wrong += differ;
    });
    RecordProperty("cells", std::to_string(cells));
    RecordProperty("differing", std::to_string(wrong));
    EXPECT_LE(wrong, cells / 100'000);
}

TEST(Exact, DecidesWhatIsFinerThanTheRoundingOfItsBrackets)
{
    // Centimetres at 4000 m: every line and every piece of a column line lies within the brackets' slack of the
    // others, and none may get lost there.
    for_seeds(40, [](Dice& dice) {
        Terrain terrain{Grid<float>(40, 40), {1.0, 1.0}};
        for (float& height_m : terrain.heights_m.values())
            height_m = static_cast<float>(4000.0 + dice.between(0.0, 0.1));
        const DirectionalLight light{Angle::from_degrees(dice.between(0.0, 360.0)),
                                     Angle::from_degrees(dice.between(0.5, 4.0))};
        const ShadowMask truth = cast_by_ray(terrain, light, {.threads = 1});
        EXPECT_EQ(differing(truth, cast_by_exact(terrain, light, {.threads = 1})), 0U)
            << "azimuth " << light.azimuth.degrees() << ", altitude " << light.altitude.degrees();
    });
}

TEST(Exact, GivesTheSameBytesOnEverySimdLevelForAnyThreads)
{
    for (const double azimuth : {0.0, 11.3, 45.0, 100.3, 203.0, 270.0, 331.6}) {
        const Terrain terrain = make_mountains(
            {.grid = {533, 611, {30.0, 25.0}}, .seed = static_cast<std::uint64_t>(azimuth) + 1});
        const DirectionalLight light{Angle::from_degrees(azimuth), Angle::from_degrees(6.0)};
        const ShadowMask truth = cast_by_fast_ray(terrain, light);
        for (const kernels::Kernels& level : kernels::runnable_kernels())
            for (const std::size_t threads : {std::size_t{1}, std::size_t{3}})
                EXPECT_EQ(differing(truth, cast_by_exact(terrain, light, {.threads = threads}, level.isa)),
                          0U)
                    << level.isa << ", " << threads << " threads, azimuth " << azimuth;
    }
    const Terrain flat{Grid<float>(2, 2, 0.0f), {}};
    EXPECT_THROW(cast_by_exact(flat, DirectionalLight{}, {}, "avx1024"), InvalidInput);
}

TEST(Exact, ShadowHeightsAreTheRays)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = true, .holes = true});
        const DirectionalLight light = random_light(dice);
        const ShadowField truth = shadow_heights_by_ray(terrain, light, {.threads = 1});
        const ShadowField shadows = shadow_heights_by_exact(terrain, light, {.threads = 1});
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const float expected = truth.values()[i];
            const float actual = shadows.values()[i];
            if (std::isfinite(expected))
                EXPECT_NEAR(actual, expected, 1e-6 * std::abs(expected) + 1e-5);
            else
                EXPECT_TRUE(std::isnan(expected) ? std::isnan(actual) : actual == expected);
        }
    });
}

TEST(Exact, LongListsOfCandidatesArePruned)
{
    // A plane along the light: every line lies on the front, none above it, for ever.
    const double altitude = 7.0;
    Terrain plane = make_plane({.grid = {1500, 300, {10.0, 10.0}},
                                .slope = Angle::from_degrees(altitude),
                                .aspect = Angle::from_degrees(180.0)});
    // Bent by less than rounding settles, so that brackets can not decide.
    for (std::size_t y = 0; y < 1500; ++y)
        for (std::size_t x = 0; x < 300; ++x)
            plane.heights_m(y, x) += 1e-3f * static_cast<float>((y * 7 + x * 13) % 5);
    for (const double azimuth : {0.0, 17.0}) {
        const DirectionalLight light{Angle::from_degrees(azimuth), Angle::from_degrees(altitude)};
        const ShadowMask truth = cast_by_ray(plane, light);
        EXPECT_LE(differing(truth, cast_by_exact(plane, light)), truth.size() / 1000);
    }
}

TEST(Exact, ALakeUnderASunOnTheHorizonIsDecidedByShortLists)
{
    // At 3810 m rounding spans many lines of a sun this low: all of them may matter, and column lines besides.
    for (const double bump_m : {0.0, 0.5}) {
        Terrain lake{Grid<float>(300, 280, 3810.0f), {30.0, 30.0}};
        Dice dice(7);
        for (float& height_m : lake.heights_m.values())
            height_m += static_cast<float>(dice.between(0.0, bump_m));
        for (const double altitude : {0.03, 0.001})
            for (const double azimuth : {203.0, 270.0}) {
                const DirectionalLight light{Angle::from_degrees(azimuth), Angle::from_degrees(altitude)};
                EXPECT_EQ(differing(cast_by_fast_ray(lake, light), cast_by_exact(lake, light)), 0U)
                    << "bumps of " << bump_m << " m, azimuth " << azimuth << ", altitude " << altitude;
            }
    }
}

} // namespace
} // namespace duskline
