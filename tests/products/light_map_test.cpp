#include "terrains.h"

#include <duskline/casting/casters.h>
#include <duskline/products/light_map.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float light_on_plane(Angle slope, Angle aspect, const MapLight& light, const LightMapOptions& options)
{
    const Terrain plane = make_plane({.grid = {.rows = 5, .columns = 5}, .slope = slope, .aspect = aspect});
    const LightMap map = light_map(plane, upward_normals(plane), std::span(&light, 1), options);
    return map.channels.at(0)(2, 2);
}

TEST(LightMap, APlaneGetsAmbientLightAndTheCosineOfItsAngleToTheSun)
{
    const MapLight sun{.source = DirectionalLight{.azimuth = 120_deg, .altitude = 35_deg}, .strength = 0.5};
    // Turned towards the sun and 20 degrees steep: 35 degrees from square to it; turned away: 75 degrees.
    const LightMapOptions lambert{.ambient = 0.125};
    EXPECT_NEAR(light_on_plane(20_deg, 120_deg, sun, lambert),
                0.125 + 0.5 * std::cos(35.0 * std::numbers::pi / 180.0), 1e-6);
    EXPECT_NEAR(light_on_plane(20_deg, 300_deg, sun, lambert),
                0.125 + 0.5 * std::cos(75.0 * std::numbers::pi / 180.0), 1e-6);
    EXPECT_FLOAT_EQ(light_on_plane(60_deg, 300_deg, sun, lambert), 0.125f);
    const LightMapOptions half{.model = LightModel::half_lambert, .ambient = 0.125};
    EXPECT_NEAR(light_on_plane(20_deg, 120_deg, sun, half),
                0.125 + 0.25 * (1.0 + std::cos(35.0 * std::numbers::pi / 180.0)), 1e-6);
    EXPECT_NEAR(light_on_plane(60_deg, 300_deg, sun, half),
                0.125 + 0.25 * (1.0 + std::cos(115.0 * std::numbers::pi / 180.0)), 1e-6);
    const LightMapOptions hillshade{.model = LightModel::hillshade, .ambient = 0.0};
    EXPECT_NEAR(light_on_plane(20_deg, 120_deg, sun, hillshade),
                (1.0 + 127.0 * std::cos(35.0 * std::numbers::pi / 180.0)) / 255.0, 1e-6);
    EXPECT_EQ(light_sample<std::uint8_t>(light_on_plane(60_deg, 300_deg, sun, hillshade)), 1);
}

TEST(LightMap, NeverLeavesZeroToOne)
{
    const std::vector<MapLight> suns(3, MapLight{.source = DirectionalLight{.altitude = 80_deg}});
    const Terrain plane = make_plane({.grid = {.rows = 3, .columns = 3}});
    for (const NamedLightModel& model : kLightModels) {
        const LightMap map = light_map(plane, upward_normals(plane), suns, {.model = model.model});
        EXPECT_EQ(map.channels.at(0)(1, 1), 1.0f) << model.name;
        const LightMap night =
            light_map(plane, upward_normals(plane), {}, {.model = model.model, .ambient = 0.0});
        EXPECT_EQ(night.channels.at(0)(1, 1), model.model == LightModel::hillshade ? 1.0f / 255.0f : 0.0f)
            << model.name;
    }
}

TEST(LightMap, ShadowsLeaveTheAmbientLightAndHalfShadowsHalfOfTheSun)
{
    const Terrain plane = make_plane({.grid = {.rows = 1, .columns = 4}});
    Grid<Lit> mask(1, 4, Lit::yes);
    mask(0, 1) = Lit::no;
    mask(0, 3) = Lit::unknown;
    Grid<float> fraction(1, 4, 1.0f);
    fraction(0, 1) = 0.0f;
    fraction(0, 2) = 0.25f;
    fraction(0, 3) = kNan;
    MapLight sun{.source = DirectionalLight{.altitude = 30_deg}, .lit = mask.view()};
    const LightMap hard = light_map(plane, upward_normals(plane), std::span(&sun, 1), {.ambient = 0.25});
    sun.lit = fraction.view();
    const LightMap soft = light_map(plane, upward_normals(plane), std::span(&sun, 1), {.ambient = 0.25});
    const float expected_hard[] = {0.75f, 0.25f, 0.75f, 0.75f};
    const float expected_soft[] = {0.75f, 0.25f, 0.375f, 0.75f};
    for (std::size_t x = 0; x < 4; ++x) {
        EXPECT_FLOAT_EQ(hard.channels.at(0)(0, x), expected_hard[x]) << x;
        EXPECT_FLOAT_EQ(soft.channels.at(0)(0, x), expected_soft[x]) << x;
    }
}

TEST(LightMap, ALampFadesWithTheSquareOfItsDistance)
{
    // 30 m over level ground in cells of 10 m: 4 cells to the side it is 50 m away, under a cosine of 3 / 5.
    const Terrain plane = make_plane({.grid = {.rows = 9, .columns = 9, .cell_size_m = {10.0, 10.0}}});
    const MapLight lamp{.source = PointLight{{4.0, 2.0, 30.0}}, .strength = 0.5, .reach_m = 30.0};
    const LightMap map = light_map(plane, upward_normals(plane), std::span(&lamp, 1), {.ambient = 0.0});
    EXPECT_NEAR(map.channels.at(0)(4, 2), 0.5, 1e-6);
    EXPECT_NEAR(map.channels.at(0)(4, 6), 0.5 * 0.36 * 0.6, 1e-6);
    EXPECT_NEAR(map.channels.at(0)(8, 2), 0.5 * 0.36 * 0.6, 1e-6);
    EXPECT_NEAR(map.channels.at(0)(0, 2), 0.5 * 0.36 * 0.6, 1e-6);
}

TEST(LightMap, ALampOnTheGroundLightsNoNumberThatIsNone)
{
    const Terrain plane = make_plane({.grid = {.rows = 3, .columns = 3}});
    const MapLight lamp{.source = PointLight{{1.0, 1.0, 0.0}}};
    const LightMap map = light_map(plane, upward_normals(plane), std::span(&lamp, 1), {.ambient = 0.25});
    for (const float light : map.channels.at(0).values())
        EXPECT_EQ(light, 0.25f);
}

TEST(LightMap, AFarStrongLampIsASun)
{
    Dice dice(7);
    const Terrain terrain = random_terrain(dice, {.smallest = 30, .largest = 40, .holes = false});
    const DirectionalLight sun{.azimuth = 250_deg, .altitude = 40_deg};
    const Vector3 towards = direction_towards(sun);
    const double away_m = 1e9;
    const MapLight far{.source = PointLight{{-towards.y * away_m / terrain.cell_size_m.y,
                                             towards.x * away_m / terrain.cell_size_m.x, towards.z * away_m}},
                       .reach_m = away_m};
    const MapLight light{.source = sun};
    const NormalField normals = upward_normals(terrain);
    const LightMap by_lamp = light_map(terrain, normals, std::span(&far, 1));
    const LightMap by_sun = light_map(terrain, normals, std::span(&light, 1));
    for (std::size_t i = 0; i < terrain.heights_m.size(); ++i)
        ASSERT_NEAR(by_lamp.channels.at(0).values()[i], by_sun.channels.at(0).values()[i], 1e-5) << i;
}

TEST(LightMap, LightsAddUpAndKeepTheirColours)
{
    const Terrain plane = make_plane({.grid = {.rows = 3, .columns = 3}});
    const DirectionalLight high{.altitude = 90_deg};
    const std::vector<MapLight> lights = {{.source = high, .strength = 0.25, .colour = {1.0f, 0.5f, 0.0f}},
                                          {.source = high, .strength = 0.5, .colour = {0.0f, 0.5f, 1.0f}}};
    const LightMapOptions options{.ambient = 0.125, .ambient_colour = {0.0f, 0.0f, 1.0f}};
    const LightMap map = light_map(plane, upward_normals(plane), lights, options);
    ASSERT_EQ(map.channels.size(), 3U);
    EXPECT_FLOAT_EQ(map.channels[0](1, 1), 0.25f);
    EXPECT_FLOAT_EQ(map.channels[1](1, 1), 0.375f);
    EXPECT_FLOAT_EQ(map.channels[2](1, 1), 0.625f);
}

TEST(LightMap, GreyLightsMakeOneChannel)
{
    const Terrain plane = make_plane({.grid = {.rows = 2, .columns = 2}});
    const MapLight grey{.colour = {0.5f, 0.5f, 0.5f}};
    const MapLight red{.colour = {1.0f, 0.5f, 0.5f}};
    const NormalField normals = upward_normals(plane);
    EXPECT_EQ(light_map(plane, normals, std::span(&grey, 1)).channels.size(), 1U);
    EXPECT_EQ(light_map(plane, normals, {}).channels.size(), 1U);
    EXPECT_EQ(light_map(plane, normals, std::span(&red, 1)).channels.size(), 3U);
    EXPECT_EQ(light_map(plane, normals, {}, {.ambient_colour = {0, 0, 1}}).channels.size(), 3U);
}

TEST(LightMap, NoDataStaysWithoutLightWhateverTheModelAndTheLight)
{
    Terrain terrain = make_plane({.grid = {.rows = 5, .columns = 6}, .slope = 20_deg});
    terrain.heights_m(2, 3) = kNan;
    const ShadowMask mask = cast_by_ray(terrain, DirectionalLight{});
    const std::vector<MapLight> lights = {
        {.source = DirectionalLight{}, .lit = mask.view(), .colour = {1.0f, 0.5f, 0.0f}},
        {.source = PointLight{{1.0, 1.0, 50.0}}}};
    for (const NamedLightModel& model : kLightModels) {
        const LightMap map = light_map(terrain, upward_normals(terrain), lights, {.model = model.model});
        for (const Grid<float>& channel : map.channels)
            for (std::size_t i = 0; i < channel.size(); ++i)
                ASSERT_EQ(std::isnan(channel.values()[i]), i == 2 * 6 + 3) << model.name << ' ' << i;
    }
}

TEST(LightMap, ASunBelowTheHorizonLightsOnlyWhatIsSaidToSeeIt)
{
    const DirectionalLight night{.azimuth = 90_deg, .altitude = -1_deg};
    const Grid<float> seen(5, 5, 0.5f);
    const LightMapOptions options{.ambient = 0.25};
    EXPECT_EQ(light_on_plane(30_deg, 90_deg, {.source = night}, options), 0.25f);
    EXPECT_GT(light_on_plane(30_deg, 90_deg, {.source = night, .lit = seen.view()}, options), 0.45f);
}

TEST(LightMap, IsTheSameForAnyNumberOfThreads)
{
    Dice dice(3);
    const Terrain terrain = random_terrain(dice, {.smallest = 90, .largest = 120});
    const DirectionalLight sun{.azimuth = 200_deg, .altitude = 25_deg};
    const ShadowMask mask = cast_by_exact(terrain, sun);
    const std::vector<MapLight> lights = {{.source = sun, .lit = mask.view()},
                                          {.source = PointLight{{10.0, 20.0, 500.0}}}};
    const LightMap one =
        light_map(terrain, upward_normals(terrain, {.threads = 1}), lights, {}, {.threads = 1});
    const LightMap four =
        light_map(terrain, upward_normals(terrain, {.threads = 4}), lights, {}, {.threads = 4});
    EXPECT_EQ(
        std::memcmp(one.channels[0].data(), four.channels[0].data(), one.channels[0].size() * sizeof(float)),
        0);
}

TEST(LightMap, TurnsWithTheTerrain)
{
    for_seeds(20, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight sun = random_light(dice);
        const MapLight light{.source = sun};
        const MapLight turned_light{.source = turned(sun)};
        const Terrain turned_terrain = turned(terrain);
        const Grid<float> map =
            turned(light_map(terrain, upward_normals(terrain), std::span(&light, 1)).channels[0]);
        const LightMap of_turned =
            light_map(turned_terrain, upward_normals(turned_terrain), std::span(&turned_light, 1));
        for (std::size_t i = 0; i < map.size(); ++i) {
            const float expected = map.values()[i];
            const float found = of_turned.channels[0].values()[i];
            ASSERT_TRUE(std::abs(expected - found) < 1e-5f || (std::isnan(expected) && std::isnan(found)))
                << i;
        }
    });
}

TEST(LightMap, SamplesAreRoundedAndNoDataIsZero)
{
    EXPECT_EQ(light_sample<std::uint8_t>(1.0f), 255);
    EXPECT_EQ(light_sample<std::uint8_t>(0.5f), 128);
    EXPECT_EQ(light_sample<std::uint8_t>(0.0f), 0);
    EXPECT_EQ(light_sample<std::uint8_t>(kNan), 0);
    EXPECT_EQ(light_sample<std::uint16_t>(1.0f), 65535);
    EXPECT_EQ(light_sample<std::uint16_t>(100.25f / 65535.0f), 100);
}

TEST(LightMap, LaidOverAPictureItIsTheirProduct)
{
    const Terrain plane = make_plane({.grid = {.rows = 2, .columns = 3}});
    const NormalField normals = upward_normals(plane);
    Grid<Rgba8> texture(2, 3, {255, 51, 0, 255});
    LightMap grey = light_map(plane, normals, {}, {.ambient = 0.5});
    multiply(grey, texture.view());
    ASSERT_EQ(grey.channels.size(), 3U);
    EXPECT_FLOAT_EQ(grey.channels[0](1, 2), 0.5f);
    EXPECT_FLOAT_EQ(grey.channels[1](1, 2), 0.1f);
    EXPECT_FLOAT_EQ(grey.channels[2](1, 2), 0.0f);
    LightMap blue = light_map(plane, normals, {}, {.ambient = 0.5, .ambient_colour = {0.5f, 1.0f, 1.0f}});
    multiply(blue, texture.view());
    EXPECT_FLOAT_EQ(blue.channels[0](0, 0), 0.25f);
    EXPECT_FLOAT_EQ(blue.channels[1](0, 0), 0.1f);
    const Grid<Rgba8> small(2, 2, {0, 0, 0, 0});
    EXPECT_THROW(multiply(blue, small.view()), InvalidInput);
}

std::string refusal(const MapLight& light, const LightMapOptions& options = {})
{
    const Terrain plane = make_plane({.grid = {.rows = 4, .columns = 6}});
    try {
        light_map(plane, upward_normals(plane), std::span(&light, 1), options);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "nothing was refused";
}

TEST(LightMap, RefusesWhatIsNoLight)
{
    const Grid<Lit> small(3, 6, Lit::yes);
    EXPECT_THAT(refusal({.strength = -1.0}), HasSubstr("strength of a light must be at least 0, got -1"));
    EXPECT_THAT(refusal({.strength = static_cast<double>(kNan)}), HasSubstr("strength"));
    EXPECT_THAT(refusal({.reach_m = 0.0}), HasSubstr("reach of a lamp must be above 0"));
    EXPECT_THAT(refusal({.colour = {1.0f, -0.5f, 1.0f}}), HasSubstr("colour of a light"));
    EXPECT_THAT(refusal({.lit = small.view()}),
                HasSubstr("the mask must have the size of the terrain, 4 x 6"));
    EXPECT_THAT(refusal({.source = DirectionalLight{.altitude = 91_deg}}), HasSubstr("altitude"));
    EXPECT_THAT(refusal({}, {.ambient = -0.1}), HasSubstr("ambient light must be at least 0"));
    const Terrain plane = make_plane({.grid = {.rows = 4, .columns = 6}});
    const Terrain other = make_plane({.grid = {.rows = 4, .columns = 5}});
    EXPECT_THROW(light_map(plane, upward_normals(other), {}), InvalidInput);
    EXPECT_THROW(light_model_named("phong"), InvalidInput);
    EXPECT_EQ(light_model_named("half-lambert").model, LightModel::half_lambert);
}

TEST(LightMap, ATerrainOfNoCellsHasAMapOfNone)
{
    const Terrain nothing{Grid<float>(0, 0), {}};
    EXPECT_TRUE(light_map(nothing, upward_normals(nothing), {}).channels.at(0).empty());
}

} // namespace
} // namespace duskline
