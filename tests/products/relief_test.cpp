#include <duskline/casting/ray.h>
#include <duskline/products/relief.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr Rgba8 kGround = {120, 90, 60, 255};

Tint brown()
{
    return plain_tint(Palette({{0.0, colour_from_srgb(kGround[0], kGround[1], kGround[2]), 1.0f}}));
}

LitFraction all(const HeightField& field, float fraction)
{
    return {field.rows(), field.columns(), fraction};
}

void expect_pixel(const Rgba8& found, const Rgba8& expected)
{
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], 1) << "channel " << i;
    EXPECT_EQ(found[3], expected[3]);
}

float brightness(const Rgba8& pixel)
{
    return luminance(SrgbDecoder().colour(pixel));
}

// The middle pixel of a plane that falls towards `aspect`, lit from the north-west.
float brightness_of_slope(Angle slope, Angle aspect)
{
    const Terrain terrain = make_plane({.grid = {9, 9, {10.0, 10.0}}, .slope = slope, .aspect = aspect});
    const Picture picture = relief(terrain, {.azimuth = 315_deg, .altitude = 45_deg}, all(terrain, 1.0f),
                                   {.tint = brown(), .exaggeration = 1.0});
    return brightness(picture(4, 4));
}

TEST(Relief, LevelGroundInTheLightShowsItsOwnColour)
{
    const Terrain terrain = make_plane({.grid = {40, 50, {10.0, 10.0}}, .height_m = 100.0});
    for (const double altitude : {5.0, 30.0, 80.0}) {
        const DirectionalLight light = {.azimuth = 100_deg, .altitude = Angle::from_degrees(altitude)};
        const Picture picture = relief(terrain, light, all(terrain, 1.0f), {.tint = brown(), .air = false});
        for (const Rgba8& pixel : picture.values())
            expect_pixel(pixel, kGround);
    }
    const Picture half_way_up = relief(terrain, {.altitude = 45_deg}, all(terrain, 1.0f), {.tint = brown()});
    expect_pixel(half_way_up(20, 20), kGround);
}

TEST(Relief, LevelGroundInShadowHasTheAmbientShareOfTheLight)
{
    const Terrain terrain = make_plane({.grid = {40, 50, {10.0, 10.0}}});
    for (const double ambient : {0.1, 0.5}) {
        const Picture picture =
            relief(terrain, {}, all(terrain, 0.0f), {.tint = brown(), .ambient = ambient, .air = false});
        const float lit = luminance(colour_from_srgb(kGround[0], kGround[1], kGround[2]));
        EXPECT_NEAR(brightness(picture(20, 20)), ambient * lit, 0.002);
    }
}

TEST(Relief, ShadowsUnderASkyAreDarkerAndBluerThanTheLight)
{
    const Terrain terrain = make_plane({.grid = {8, 8, {10.0, 10.0}}});
    const DirectionalLight light = {.azimuth = 100_deg, .altitude = 10_deg};
    const Rgba8 lit = relief(terrain, light, all(terrain, 1.0f), {.tint = brown()})(4, 4);
    const Rgba8 shaded = relief(terrain, light, all(terrain, 0.0f), {.tint = brown()})(4, 4);
    EXPECT_LT(brightness(shaded), 0.5f * brightness(lit));
    const Colour a = SrgbDecoder().colour(lit);
    const Colour b = SrgbDecoder().colour(shaded);
    EXPECT_GT(b.blue / b.red, a.blue / a.red);
}

TEST(Relief, SlopesAreTheBrighterTheMoreTheyFaceTheLight)
{
    const float towards = brightness_of_slope(30_deg, 315_deg);
    const float half_towards = brightness_of_slope(30_deg, 270_deg);
    const float across = brightness_of_slope(30_deg, 225_deg);
    const float half_away = brightness_of_slope(30_deg, 180_deg);
    const float away = brightness_of_slope(30_deg, 135_deg);
    EXPECT_GT(towards, half_towards + 0.005f);
    EXPECT_GT(half_towards, across + 0.005f);
    EXPECT_GT(across, half_away + 0.005f);
    EXPECT_GT(half_away, away + 0.005f);
    EXPECT_GT(away, 0.0f);
    // Left and right of the light are alike.
    EXPECT_NEAR(half_towards, brightness_of_slope(30_deg, 0_deg), 0.003f);
    EXPECT_NEAR(half_away, brightness_of_slope(30_deg, 90_deg), 0.003f);
}

TEST(Relief, FollowsItsFormulaOnASlopeInTheLight)
{
    // r = cos(45 - 20) / sin 45 towards the light; no ambient light, no soft clip for so dark a ground.
    const Terrain terrain = make_plane({.grid = {9, 9, {10.0, 10.0}}, .slope = 20_deg, .aspect = 90_deg});
    const Tint grey = plain_tint(Palette({{0.0, {0.2f, 0.2f, 0.2f}, 1.0f}}));
    const Picture picture = relief(terrain, {.azimuth = 90_deg, .altitude = 45_deg}, all(terrain, 1.0f),
                                   {.tint = grey, .exaggeration = 1.0, .ambient = 0.0, .air = false});
    const double r = sine_cosine(Angle::from_degrees(65.0)).sine / sine_cosine(45_deg).sine;
    EXPECT_NEAR(brightness(picture(4, 4)), 0.2 * 2.6 * r / (1.6 + r), 0.003);
}

TEST(Relief, ExaggerationIsTheSameAsSteeperSlopes)
{
    const Terrain low =
        make_gaussian_hill({.grid = {33, 33, {10.0, 10.0}}, .height_m = 20.0, .sigma_m = 60.0});
    const Terrain high =
        make_gaussian_hill({.grid = {33, 33, {10.0, 10.0}}, .height_m = 60.0, .sigma_m = 60.0});
    const Picture a = relief(low, {}, all(low, 1.0f), {.tint = brown(), .exaggeration = 3.0});
    const Picture b = relief(high, {}, all(high, 1.0f), {.tint = brown(), .exaggeration = 1.0});
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_NEAR(a.values()[i][k], b.values()[i][k], 1) << i;
}

TEST(Relief, AGlobesLevelGroundDarkensAwayFromTheLight)
{
    // 100 km on the Moon tilt by 3.3 degrees: sin(10 - 3.3) / sin(10) of the light.
    const Terrain terrain = make_plane({.grid = {21, 201, {1000.0, 1000.0}}});
    const Tint grey = plain_tint(Palette({{0.0, {0.2f, 0.2f, 0.2f}, 1.0f}}));
    const EarthCurvature moon = {
        .coefficient = 1.0, .radius_m = 1737400.0, .tangent_row = 10.0, .tangent_column = 100.0};
    const Picture picture =
        relief(terrain, {.azimuth = 90_deg, .altitude = 10_deg}, all(terrain, 1.0f),
               {.tint = grey, .exaggeration = 5.0, .ambient = 0.0, .curvature = moon, .air = false});
    const auto expected = [](double tilt_degrees) {
        const double r =
            sine_cosine(Angle::from_degrees(10.0 + tilt_degrees)).sine / sine_cosine(10_deg).sine;
        return 0.2 * 2.6 * r / (1.6 + r);
    };
    const double tilt = Angle::from_radians(std::atan(100000.0 / 1737400.0)).degrees();
    EXPECT_NEAR(brightness(picture(10, 100)), expected(0.0), 0.003);
    EXPECT_NEAR(brightness(picture(10, 0)), expected(-tilt), 0.003);
    EXPECT_NEAR(brightness(picture(10, 200)), expected(tilt), 0.003);
}

TEST(Relief, ShadowKeepsTheFormOfTheGround)
{
    const Terrain hill =
        make_gaussian_hill({.grid = {65, 65, {10.0, 10.0}}, .height_m = 80.0, .sigma_m = 60.0});
    const Picture picture = relief(hill, {.azimuth = 270_deg, .altitude = 20_deg}, all(hill, 0.0f),
                                   {.tint = brown(), .exaggeration = 1.0});
    EXPECT_GT(brightness(picture(32, 26)), brightness(picture(32, 38)) + 0.003f); // sides
    EXPECT_GT(brightness(picture(32, 32)), brightness(picture(32, 48)));          // top and foot
}

TEST(Relief, NoDataIsTransparentOrThePalettesPixel)
{
    Terrain terrain = make_plane({.grid = {20, 20, {10.0, 10.0}}});
    terrain.heights_m(3, 5) = std::numeric_limits<float>::quiet_NaN();
    LitFraction lit = all(terrain, 1.0f);
    lit(3, 5) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(relief(terrain, {}, lit, {.tint = brown()})(3, 5), (Rgba8{0, 0, 0, 0}));

    Tint with_colour = brown();
    with_colour.ground.no_data = Rgba8{9, 8, 7, 255};
    const Picture picture = relief(terrain, {}, lit, {.tint = with_colour});
    EXPECT_EQ(picture(3, 5), (Rgba8{9, 8, 7, 255}));
    EXPECT_EQ(picture(3, 6)[3], 255);
}

TEST(Relief, ALightBelowTheHorizonLeavesTheSky)
{
    const Terrain terrain = make_plane({.grid = {8, 8, {10.0, 10.0}}});
    const DirectionalLight night = {.azimuth = 0_deg, .altitude = -3_deg};
    const Picture picture = relief(terrain, night, all(terrain, 0.0f), {.tint = brown()});
    const float lit = luminance(colour_from_srgb(kGround[0], kGround[1], kGround[2]));
    EXPECT_GT(brightness(picture(4, 4)), 0.15f * lit);
    EXPECT_LT(brightness(picture(4, 4)), 0.35f * lit);
}

TEST(Relief, ATextureTakesTheTintsPlaceWhereItIsOpaque)
{
    const Terrain terrain = make_plane({.grid = {8, 8, {10.0, 10.0}}});
    Picture texture(8, 8, Rgba8{40, 140, 90, 255});
    texture(2, 2) = {255, 255, 255, 0};
    const Picture picture =
        relief(terrain, {}, all(terrain, 1.0f), {.tint = brown(), .texture = texture.view(), .air = false});
    expect_pixel(picture(4, 4), {40, 140, 90, 255});
    expect_pixel(picture(2, 2), kGround);
}

TEST(Relief, AnIslandsSeaIsBrightAlongTheShoreAndDeepFarOut)
{
    Terrain terrain = make_cone({.grid = {301, 301, {10.0, 10.0}}, .ground_m = -1e-3, .height_m = 300.0});
    for (float& height_m : terrain.heights_m.values())
        height_m = std::max(0.0f, height_m);
    const Tint tint = fitted(tint_named("natural"), height_span(terrain), likely_sea(height_span(terrain)));
    ASSERT_EQ(tint.sea.kind, SeaKind::surface);
    const Picture picture =
        relief(terrain, {}, all(terrain, 1.0f), {.tint = tint, .exaggeration = 1.0, .air = false});
    float last = 1.0f;
    for (const std::size_t column : {186U, 195U, 205U, 220U}) { // the shore lies at 180
        EXPECT_LT(brightness(picture(150, column)), last) << column;
        last = brightness(picture(150, column));
    }
    expect_pixel(picture(10, 10), {0x2A, 0x4C, 0x66, 255});
}

TEST(Relief, IsTheSameForAnyNumberOfThreads)
{
    const Terrain terrain = make_mountains({.grid = {210, 130, {30.0, 30.0}}, .seed = 5});
    const DirectionalLight light = {.azimuth = 203_deg, .altitude = 15_deg};
    const LitFraction lit = lit_fraction(cast_by_ray(terrain, light));
    const ReliefOptions options = {.tint = fitted(tint_named("natural"), height_span(terrain), {})};
    const Picture one = relief(terrain, light, lit, options, {.threads = 1});
    const Picture many = relief(terrain, light, lit, options, {.threads = 5});
    EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
}

TEST(Relief, WorksOnTheSmallestTerrains)
{
    const Tint tint = fitted(tint_named("natural"), {}, {SeaKind::surface, 0.0f});
    for (const auto& [rows, columns] : {std::pair<std::size_t, std::size_t>{1, 1}, {1, 7}, {7, 1}, {3, 3}}) {
        const Terrain terrain = make_plane({.grid = {rows, columns, {10.0, 10.0}}});
        const Picture picture = relief(terrain, {}, all(terrain, 1.0f), {.tint = tint});
        EXPECT_EQ(picture(0, 0)[3], 255);
    }
    EXPECT_TRUE(relief(HeightField{}, {}, {}, {}).empty());
}

TEST(Relief, RefusesWhatMakesNoSense)
{
    const Terrain terrain = make_plane({.grid = {8, 8, {10.0, 10.0}}});
    const LitFraction lit = all(terrain, 1.0f);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double ambient : {-0.1, 1.0, nan})
        EXPECT_THROW(relief(terrain, {}, lit, {.ambient = ambient}), InvalidInput) << ambient;
    for (const double exaggeration : {0.0, -2.0, nan})
        EXPECT_THROW(relief(terrain, {}, lit, {.exaggeration = exaggeration}), InvalidInput) << exaggeration;
    EXPECT_THROW(relief(terrain, {}, LitFraction(8, 7, 1.0f)), InvalidInput);
    const Picture texture(4, 8, Rgba8{});
    EXPECT_THROW(relief(terrain, {}, lit, {.texture = texture.view()}), InvalidInput);
}

TEST(ShadingExaggeration, GrowsWithTheSunAndFallsWithTheSlopesAndStaysInItsBounds)
{
    const auto of = [](Angle slope, Angle altitude) {
        const Terrain terrain = make_plane({.grid = {16, 16, {10.0, 10.0}}, .slope = slope});
        return shading_exaggeration(terrain, {.azimuth = 0_deg, .altitude = altitude});
    };
    // 0.55 tan(altitude) / (tan(slope) / sqrt 2)
    EXPECT_NEAR(of(10_deg, 30_deg), 0.55 * 0.577350 / (0.176327 / std::sqrt(2.0)), 1e-3);
    EXPECT_EQ(of(40_deg, 10_deg), 1.0);
    EXPECT_EQ(of(1_deg, 80_deg), 6.0);
    EXPECT_EQ(of(0_deg, 45_deg), 1.0);
    EXPECT_EQ(of(10_deg, -5_deg), 1.0);
}

} // namespace
} // namespace duskline
