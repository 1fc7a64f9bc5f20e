#include "gl/gl_test.h"
#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/sweep.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

Grid<float> swept(ShadowSweep& sweep, const HeightField& field, const DirectionalLight& light)
{
    return read_back<float>(sweep.cast(height_texture(field.heights_m), field.cell_size_m, light));
}

DirectionalLight at_altitude(DirectionalLight light, Angle altitude)
{
    light.altitude = altitude;
    return light;
}

// The shadow heights of a light at that altitude, or along the horizontal.
Grid<float> swept_by_processor(const HeightField& field, const DirectionalLight& light, double altitude)
{
    if (altitude > 0.0)
        return shadow_heights_by_sweep(field, at_altitude(light, Angle::from_degrees(altitude)));
    LightFrame frame = light_frame(light, field.cell_size_m);
    frame.drop_m = 0.0;
    Grid<float> answers(field.rows(), field.columns());
    const auto heights = in_light_order(field.heights_m, frame);
    SweepFront(heights.lines, heights.cells, frame)
        .advance(heights, in_light_order(answers.view(), frame), {});
    return answers;
}

// One component of a texture of two.
Grid<float> component(const Grid<std::array<float, 2>>& both, std::size_t i)
{
    Grid<float> one(both.rows(), both.columns());
    std::ranges::transform(both.values(), one.values().begin(), [i](const auto& texel) { return texel[i]; });
    return one;
}

using ShadowSweepTest = GlTest;

TEST_F(ShadowSweepTest, HasTheBitsOfTheProcessorsSweepOnRandomTerrain)
{
    ShadowSweep sweep{ShaderSources()};
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        EXPECT_TRUE(same_bits(swept(sweep, terrain, light), shadow_heights_by_sweep(terrain, light)));
    });
}

TEST_F(ShadowSweepTest, HasTheSameBitsHoweverManyLinesASegmentHas)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 300, .columns = 261, .cell_size_m = {30.0, 25.0}}});
    ShadowSweep by_32(ShaderSources(), {.lines_per_segment = 32});
    ShadowSweep by_96(ShaderSources(), {.lines_per_segment = 96});
    ShadowSweep in_one(ShaderSources(), {.lines_per_segment = 320});
    for (const double azimuth : {0.0, 37.0, 90.0, 135.0, 200.0, 251.0, 288.7}) {
        const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 4_deg};
        const ShadowField expected = shadow_heights_by_sweep(terrain, light);
        EXPECT_TRUE(same_bits(swept(by_32, terrain, light), expected)) << azimuth;
        EXPECT_TRUE(same_bits(swept(by_96, terrain, light), expected)) << azimuth;
        EXPECT_TRUE(same_bits(swept(in_one, terrain, light), expected)) << azimuth;
    }
}

TEST_F(ShadowSweepTest, CastsBothEdgesOfTheDiscAtOnce)
{
    ShadowSweep sweep(ShaderSources(), {.limbs = true});
    for_seeds(40, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        DirectionalLight light = random_light(dice);
        light.angular_diameter = Angle::from_degrees(dice.between(0.0, 8.0));
        const double altitude = light.altitude.degrees();
        const double radius = 0.5 * light.angular_diameter.degrees();
        const auto both = read_back<std::array<float, 2>>(
            sweep.cast(height_texture(terrain.heights_m.view()), terrain.cell_size_m, light));
        const auto upper = Angle::from_degrees(std::min(altitude + radius, 90.0));
        const ShadowField of_upper = shadow_heights_by_sweep(terrain, at_altitude(light, upper));
        const Grid<float> first = component(both, 0);
        EXPECT_TRUE(same_bits(component(both, 1), swept_by_processor(terrain, light, altitude - radius)));
        for (std::size_t i = 0; i < first.size(); ++i) {
            const float ground_m = terrain.heights_m.values()[i];
            if (of_upper.values()[i] > ground_m) {
                ASSERT_EQ(first.values()[i], of_upper.values()[i]) << i;
            } else if (!std::isnan(ground_m)) {
                ASSERT_LE(first.values()[i], of_upper.values()[i]) << i;
            }
        }
    });
}

TEST_F(ShadowSweepTest, AnswersForLightUnderTheHorizonAndStraightOverhead)
{
    ShadowSweep sweep{ShaderSources()};
    const Terrain terrain = make_cone({.grid = {.rows = 20, .columns = 30}});
    for (const Angle altitude : {-10_deg, 0_deg, 90_deg}) {
        const DirectionalLight light{.azimuth = 30_deg, .altitude = altitude};
        EXPECT_TRUE(same_bits(swept(sweep, terrain, light), shadow_heights_by_sweep(terrain, light)));
    }
}

TEST_F(ShadowSweepTest, FollowsTerrainOfAnotherSize)
{
    ShadowSweep sweep{ShaderSources()};
    const DirectionalLight light{.azimuth = 100_deg, .altitude = 20_deg};
    for (const std::size_t rows : {1U, 40U, 7U, 90U}) {
        const Terrain terrain = make_cone({.grid = {.rows = rows, .columns = 50}});
        EXPECT_TRUE(same_bits(swept(sweep, terrain, light), shadow_heights_by_sweep(terrain, light)));
    }
}

TEST_F(ShadowSweepTest, RefusesValuesOutOfRangeInWords)
{
    EXPECT_THAT([] { ShadowSweep(ShaderSources(), {.lines_per_segment = 33}); },
                ThrowsMessage<InvalidInput>(HasSubstr("multiple of 32, got 33")));
    ShadowSweep sweep{ShaderSources()};
    const Texture heights(TextureFormat::r32f, 4, 4);
    EXPECT_THROW(sweep.cast(heights, {.x = 0.0, .y = 1.0}, {}), InvalidInput);
    EXPECT_THROW(sweep.cast(heights, {}, {.altitude = 91_deg}), InvalidInput);
}

} // namespace
} // namespace duskline::gl
