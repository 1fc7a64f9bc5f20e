#include <duskline/geometry/invalid_input.h>
#include <duskline/products/ground_colours.h>
#include <duskline/products/relief.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

Terrain hills()
{
    return make_mountains(
        {.grid = {.rows = 40, .columns = 60, .cell_size_m = {30.0, 30.0}}, .feature_m = 600.0});
}

TEST(GroundPicture, IsTheReliefOfLevelGroundInFullLight)
{
    Terrain level{Grid<float>(20, 30, 800.0f), {30.0, 30.0}};
    const Tint tint = fitted(tint_named("natural"), {.high_m = 2000.0f, .highest_m = 2500.0f}, {});
    const Picture ground = ground_picture(level, tint);
    const LitFraction lit(20, 30, 1.0f);
    const Picture relief_picture =
        relief(level, {.azimuth = 315_deg, .altitude = 45_deg}, lit, {.tint = tint, .air = false});
    for (std::size_t i = 0; i < ground.size(); ++i)
        for (std::size_t channel = 0; channel < 4; ++channel)
            EXPECT_LE(std::abs(ground.values()[i].at(channel) - relief_picture.values()[i].at(channel)), 1);
}

TEST(GroundPicture, ShowsTheTextureWhereThatIsOpaque)
{
    const Terrain terrain = hills();
    Grid<Rgba8> texture(40, 60, Rgba8{10, 200, 30, 0});
    texture(5, 6) = {10, 200, 30, 255};
    const Tint tint = plain_tint(Palette());
    const Picture with = ground_picture(terrain, tint, texture.view());
    const Picture without = ground_picture(terrain, tint);
    EXPECT_NEAR(with(5, 6)[1], 200, 1);
    EXPECT_NEAR(with(5, 6)[0], 10, 1);
    EXPECT_EQ(with(5, 7), without(5, 7));
}

TEST(GroundPicture, IsTransparentWhereThereAreNoData)
{
    Terrain terrain = hills();
    terrain.heights_m(3, 4) = std::numeric_limits<float>::quiet_NaN();
    const Picture picture = ground_picture(terrain, fitted(tint_named("natural"), height_span(terrain), {}));
    EXPECT_EQ(picture(3, 4), (Rgba8{0, 0, 0, 0}));
    EXPECT_EQ(picture(3, 5)[3], 255);
}

TEST(GroundPicture, RefusesATextureOfAnotherSize)
{
    const Grid<Rgba8> texture(39, 60, Rgba8{});
    const Terrain terrain = hills();
    EXPECT_THROW(ground_picture(terrain, plain_tint(Palette()), texture.view()), InvalidInput);
}

} // namespace
} // namespace duskline
