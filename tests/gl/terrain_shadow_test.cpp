// terrain_shadow.glsl on the card and, compiled as C++, here; both against what the library knows to be true.

#include "gl/gl_test.h"
#include "gl/shader_as_cpp.h"
#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/ray.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/program.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/terrain_shadow.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace duskline::gl {

namespace shader {

static TerrainShadowBlock terrain_shadow;
static sampler2D terrain_shadow_heights;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion" // numbers are floats in GLSL
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#include <duskline/gl/shaders/terrain_shadow.glsl>
#pragma GCC diagnostic pop

} // namespace shader

namespace {

using namespace angle_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

using Texel = std::array<float, 2>;
using Position = std::array<float, 4>;

// What the shader says here.
class OnProcessor {
public:
    OnProcessor(Grid<Texel> texels, const TerrainShadowBlock& block) : texels_(std::move(texels))
    {
        shader::terrain_shadow_heights.texels = texels_.view();
        shader::terrain_shadow = block;
    }
    float factor(const Position& p) const { return shader::shadow_factor({p[0], p[1], p[2]}); }

private:
    Grid<Texel> texels_;
};

Grid<Texel> texels_of(const Texture& texture)
{
    return read_back<Texel>(texture);
}

constexpr const char* kAsk = R"(#version 430 core
#include "terrain_shadow.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 5) writeonly buffer Factors { float factors[]; };
void main()
{
    if (gl_GlobalInvocationID.x < uint(positions.length()))
        factors[gl_GlobalInvocationID.x] = shadow_factor(positions[gl_GlobalInvocationID.x].xyz);
}
)";

// What it says on the card.
std::vector<float> on_card(const Texture& shadow_heights, const TerrainShadowBlock& block,
                           const std::vector<Position>& positions)
{
    ShaderSources sources;
    sources.add("ask.comp.glsl", kAsk);
    const Program ask(sources, {{"ask.comp.glsl"}});
    Buffer block_buffer;
    bind_terrain_shadow(shadow_heights, block, block_buffer);
    Buffer places;
    places.upload(positions);
    places.bind_as_storage(4);
    const Buffer factors(positions.size() * sizeof(float));
    factors.bind_as_storage(5);
    dispatch(ask, positions.size());
    return factors.download<float>();
}

float as_float(double value)
{
    return static_cast<float>(value);
}

// Places over and a little beside a terrain, from its lowest ground to above its highest.
std::vector<Position> random_positions(Dice& dice, const HeightField& field, std::size_t count)
{
    const HeightRange range = height_range(field);
    std::vector<Position> positions;
    for (std::size_t i = 0; i < count; ++i) {
        const double column = dice.between(-1.0, static_cast<double>(field.columns()));
        const double row = dice.between(-1.0, static_cast<double>(field.rows()));
        positions.push_back({as_float(column * field.cell_size_m.x), as_float(-row * field.cell_size_m.y),
                             as_float(dice.between(range.lowest_m, range.highest_m + 10.0)), 1.0f});
    }
    return positions;
}

Terrain mountains(std::size_t side)
{
    return make_mountains({.grid = {side, side, {30.0, 30.0}}, .seed = 3});
}

using ShadowFactor = GlTest;

TEST_F(ShadowFactor, SaysOnTheCardWhatItSaysCompiledAsCpp)
{
    ShadowSweep hard{ShaderSources()};
    ShadowSweep soft(ShaderSources(), {.limbs = true});
    for_seeds(25, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 3});
        DirectionalLight light = random_light(dice);
        light.angular_diameter = Angle::from_degrees(dice.between(0.2, 5.0));
        const Texture heights = height_texture(terrain.heights_m.view());
        for (ShadowSweep* sweep : {&hard, &soft}) {
            const Texture& shadow = sweep->cast(heights, terrain.cell_size_m, light);
            const auto block = terrain_shadow_block(placement_in_metres(terrain.cell_size_m), shadow, light);
            const auto positions = random_positions(dice, terrain, 200);
            const auto factors = on_card(shadow, block, positions);
            const OnProcessor processor(texels_of(shadow), block);
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const auto& [x, y, z, one] = positions[i];
                // A hard edge may tip by rounding.
                const bool at_edge =
                    block.soft == 0.0f
                    && processor.factor({x, y, z - 1e-3f, 1.0f}) != processor.factor({x, y, z + 1e-3f, 1.0f});
                if (!at_edge) {
                    EXPECT_NEAR(factors[i], processor.factor(positions[i]), 2e-3)
                        << x << ", " << y << ", " << z;
                }
            }
        }
    });
}

TEST_F(ShadowFactor, OfExactShadowHeightsIsTheExactMaskOnTheGround)
{
    for_seeds(10, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.square_cells = true});
        const DirectionalLight light = random_light(dice);
        const ShadowMask mask = cast_by_exact(terrain, light);
        const Texture shadow = height_texture(shadow_heights_by_exact(terrain, light).view());
        // Cells as units of length, so that places of cells are whole numbers.
        const auto block = terrain_shadow_block({}, shadow, light);
        const OnProcessor processor(texels_of(shadow), block);
        for (std::size_t row = 0; row < mask.rows(); ++row)
            for (std::size_t column = 0; column < mask.columns(); ++column)
                if (mask(row, column) != Lit::unknown) {
                    EXPECT_EQ(processor.factor({static_cast<float>(column), -static_cast<float>(row),
                                                terrain.heights_m(row, column), 1.0f}),
                              mask(row, column) == Lit::yes ? 1.0f : 0.0f)
                        << row << ", " << column;
                }
    });
}

TEST_F(ShadowFactor, OfPointsAboveTheGroundIsTheRaysAnswer)
{
    const Terrain terrain = mountains(200);
    const DirectionalLight light{.azimuth = 212_deg, .altitude = 12_deg};
    const Texture shadow = height_texture(shadow_heights_by_exact(terrain, light).view());
    const auto block = terrain_shadow_block(placement_in_metres(terrain.cell_size_m), shadow, light);
    const OnProcessor processor(texels_of(shadow), block);
    const TerrainRays rays(terrain);
    Dice dice(11);
    int asked = 0;
    int wrong = 0;
    while (asked < 4000) {
        const double row = dice.between(0.0, 199.0);
        const double column = dice.between(0.0, 199.0);
        const double height_m = *ground_height_m(terrain, row, column) + dice.between(0.0, 150.0);
        const float factor =
            processor.factor({as_float(column * 30.0), as_float(-row * 30.0), as_float(height_m), 1.0f});
        wrong += factor != (rays.is_shadowed({row, column, height_m}, light) ? 0.0f : 1.0f);
        ++asked;
    }
    // What lies between cells is interpolated: right at an edge it may be either.
    EXPECT_LE(wrong, asked / 100);
}

TEST_F(ShadowFactor, OfBothEdgesOfTheDiscIsTheVisibleFraction)
{
    const Terrain terrain = mountains(200);
    const DirectionalLight light{.azimuth = 212_deg, .altitude = 12_deg, .angular_diameter = 2_deg};
    ShadowSweep sweep(ShaderSources(), {.limbs = true});
    const Texture& shadow = sweep.cast(height_texture(terrain.heights_m.view()), terrain.cell_size_m, light);
    const OnProcessor processor(
        texels_of(shadow), terrain_shadow_block(placement_in_metres(terrain.cell_size_m), shadow, light));
    const VisibleFraction truth = visible_fraction(terrain, light, caster_named("exact"));
    double off = 0.0;
    std::size_t penumbra = 0;
    for (std::size_t row = 0; row < 200; ++row)
        for (std::size_t column = 0; column < 200; ++column) {
            const float factor =
                processor.factor({30.0f * static_cast<float>(column), -30.0f * static_cast<float>(row),
                                  terrain.heights_m(row, column), 1.0f});
            const float fraction = truth(row, column);
            penumbra += fraction > 0.0f && fraction < 1.0f;
            off += std::abs(factor - fraction);
        }
    ASSERT_GT(penumbra, 500U);
    EXPECT_LT(off / static_cast<double>(penumbra), 0.06); // in the mean of the penumbra
}

TEST_F(ShadowFactor, OfAWallHasThePenumbraOfTrigonometry)
{
    // A wall of 20 m along a line across the light: its shadow begins to lift at 20 cot(a + r) and ends at 20 cot(a - r).
    const Terrain terrain =
        make_wall({.grid = {.rows = 33, .columns = 301}, .height_m = 20.0, .offset_m = -100.0});
    const DirectionalLight light{.azimuth = 270_deg, .altitude = 10_deg, .angular_diameter = 2_deg};
    ShadowSweep sweep(ShaderSources(), {.limbs = true});
    const Texture& shadow = sweep.cast(height_texture(terrain.heights_m.view()), {}, light);
    const OnProcessor processor(texels_of(shadow), terrain_shadow_block({}, shadow, light));
    for (int metres = 80; metres < 160; ++metres) {
        const double altitude = std::atan2(20.0, metres) / Angle::from_degrees(1.0).radians();
        const double t =
            std::clamp(altitude - 10.0, -1.0, 1.0); // of the wall's top over the disc's centre; radius 1
        const double expected = 0.5 - (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
        EXPECT_NEAR(processor.factor({50.0f + static_cast<float>(metres), -16.0f, 0.0f, 1.0f}), expected,
                    0.02)
            << metres;
    }
}

TEST_F(ShadowFactor, OfALevelPlainIsThePartOfTheDiscAboveTheHorizontal)
{
    const Terrain terrain = make_plane({.grid = {.rows = 9, .columns = 9}});
    ShadowSweep sweep(ShaderSources(), {.limbs = true});
    const Texture heights = height_texture(terrain.heights_m.view());
    for (const auto& [altitude, expected] :
         {std::pair{0.5, 0.804499}, {0.0, 0.5}, {-0.5, 0.195501}, {-2.0, 0.0}}) {
        const DirectionalLight light{
            .azimuth = 200_deg, .altitude = Angle::from_degrees(altitude), .angular_diameter = 2_deg};
        const Texture& shadow = sweep.cast(heights, {}, light);
        const OnProcessor processor(texels_of(shadow), terrain_shadow_block({}, shadow, light));
        EXPECT_NEAR(processor.factor({4.0f, -4.0f, 0.0f, 1.0f}), expected, 1e-5) << altitude;
    }
}

TEST_F(ShadowFactor, HasNoShadowBesideTheGridAndOverNoData)
{
    Grid<float> shadow_m(4, 4, 100.0f);
    for (std::size_t column = 0; column < 4; ++column)
        shadow_m(0, column) = std::numeric_limits<float>::quiet_NaN();
    const Texture shadow = height_texture(shadow_m.view());
    const OnProcessor processor(texels_of(shadow), terrain_shadow_block({}, shadow, {}));
    EXPECT_EQ(processor.factor({1.0f, -2.0f, 0.0f, 1.0f}), 0.0f);
    EXPECT_EQ(processor.factor({1.0f, -0.5f, 0.0f, 1.0f}), 0.0f); // what is known counts
    EXPECT_EQ(processor.factor({1.0f, 0.0f, 0.0f, 1.0f}), 1.0f);
    EXPECT_EQ(processor.factor({1.0f, -3.6f, 0.0f, 1.0f}), 1.0f);
    EXPECT_EQ(processor.factor({-0.6f, -2.0f, 0.0f, 1.0f}), 1.0f);
}

TEST_F(ShadowFactor, FindsItsPlaceInAnyAxes)
{
    Grid<float> shadow_m(3, 5, -100.0f);
    shadow_m(2, 4) = 50.0f;
    const Texture shadow = height_texture(shadow_m.view());
    // y up, z south, decimetres, and an origin far away.
    const GridPlacement placement{.origin = {1000.0, -20.0, 7000.0},
                                  .column_step = {300.0, 0.0, 0.0},
                                  .row_step = {0.0, 0.0, 200.0},
                                  .metre_up = {0.0, 10.0, 0.0}};
    const OnProcessor processor(texels_of(shadow), terrain_shadow_block(placement, shadow, {}));
    EXPECT_EQ(processor.factor({2200.0f, 479.0f, 7400.0f, 1.0f}), 0.0f); // 49.9 m over cell (2, 4)
    EXPECT_EQ(processor.factor({2200.0f, 481.0f, 7400.0f, 1.0f}), 1.0f);
    EXPECT_EQ(processor.factor({1900.0f, -19.0f, 7400.0f, 1.0f}), 1.0f);
    EXPECT_THAT(
        [&] {
            terrain_shadow_block({.row_step = {2.0, 0.0, 0.0}}, shadow, {});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("one plane")));
}

} // namespace
} // namespace duskline::gl
