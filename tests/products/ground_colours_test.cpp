#include <duskline/geometry/invalid_input.h>
#include <duskline/products/ground_colours.h>
#include <duskline/products/relief.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(GroundPicture, PaintedAnewWhereHeightsChangedIsThatOfTheNewHeights)
{
    Terrain terrain = make_plane({.grid = {.rows = 40, .columns = 60, .cell_size_m = {30.0, 30.0}},
                                  .height_m = 900.0,
                                  .slope = 10_deg});
    const Tint tint = fitted(tint_named("natural"), {.high_m = 2000.0f, .highest_m = 2500.0f}, {});
    const HeightField field = terrain;
    const GroundColours colours(field, tint, {}, {});
    Picture picture = ground_picture(terrain, tint);
    const CellRectangle changed{.first_row = 10, .first_column = 59, .rows = 12, .columns = 1};
    for (std::size_t row = 10; row < 22; ++row)
        terrain.heights_m(row, 59) += 900.0f;
    const Picture fresh = ground_picture(terrain, tint);
    EXPECT_NE(picture(15, 58), fresh(15, 58)); // steeper
    paint_ground(colours, repainted(changed, terrain), picture.view());
    EXPECT_TRUE(std::ranges::equal(picture.values(), fresh.values()));
}

TEST(GroundPicture, KeepsWaterThatMovesWater)
{
    const Terrain at_rest =
        make_cone({.grid = {.rows = 60, .columns = 60, .cell_size_m = {30.0, 30.0}}, .height_m = 400.0});
    Terrain moved{at_rest.heights_m.copy(), at_rest.cell_size_m};
    moved.heights_m(2, 3) += 5.0f;
    const Tint tint =
        fitted(tint_named("natural"), height_span(at_rest), {.kind = SeaKind::surface, .level_m = 0.0f});
    const HeightField moved_field = moved;
    const HeightField still_field = at_rest;
    const GroundColours colours(moved_field, still_field, tint, {}, {});
    Picture picture(60, 60);
    paint_ground(colours, {0, 0, 60, 60}, picture.view());
    EXPECT_EQ(picture(2, 3), ground_picture(at_rest, tint)(2, 3));
    EXPECT_NE(picture(2, 3), ground_picture(moved, tint)(2, 3));
}

TEST(GroundPicture, RefusesATextureOfAnotherSize)
{
    const Grid<Rgba8> texture(39, 60, Rgba8{});
    const Terrain terrain = hills();
    EXPECT_THROW(ground_picture(terrain, plain_tint(Palette()), texture.view()), InvalidInput);
}

} // namespace
} // namespace duskline
