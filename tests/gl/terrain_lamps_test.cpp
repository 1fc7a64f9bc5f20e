#include "gl/gl_test.h"

#include <duskline/casting/exact.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/terrain_lamps.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <utility>

namespace duskline::gl {
namespace {

using namespace angle_literals;

using Pixel = std::array<std::uint8_t, 4>;

Terrain hills()
{
    return make_mountains({.grid = {.rows = 150, .columns = 150, .cell_size_m = {10.0, 10.0}},
                           .height_m = 250.0,
                           .feature_m = 500.0,
                           .roughness = 0.35});
}

// By night, from straight above.
struct Scene {
    explicit Scene(Terrain ground)
        : terrain(std::move(ground)),
          colours(terrain.heights_m.rows(), terrain.heights_m.columns(), Pixel{150, 150, 150, 255}),
          textures(terrain, colours.view()), renderer(sources, textures),
          lamps(sources, textures, {.size = 512})
    {
        view.camera = {position_m({74.5, 74.5, 4000.0}, terrain.cell_size_m), 0_deg, -90_deg, 20_deg};
        view.width = 150;
        view.height = 150;
        view.pixel_error = 0.1;
        light.light.altitude = -30_deg;
        light.sun_colour = {0.0f, 0.0f, 0.0f};
        light.sky_light = {0.0f, 0.0f, 0.0f};
        light.air = false;
        light.lamps = &lamps;
    }

    Grid<Pixel> picture()
    {
        const Texture colour(TextureFormat::rgba8, view.width, view.height);
        const Texture depth(TextureFormat::depth32f, view.width, view.height);
        const Framebuffer framebuffer({&colour}, &depth);
        framebuffer.clear({0.0f, 0.0f, 0.0f, 0.0f});
        framebuffer.bind();
        renderer.draw_terrain(view, light, {});
        return read_back_picture(view.width, view.height);
    }

    // A lamp so far over a cell, as bright as the sun from afar, so that what it lights is not black.
    SceneLamp lamp_over(std::size_t row, std::size_t column, double over_m) const
    {
        const GridPoint place = {static_cast<double>(row) + 0.3, static_cast<double>(column) + 0.2,
                                 static_cast<double>(terrain.heights_m(row, column)) + over_m};
        return {.position_m = position_m(place, terrain.cell_size_m), .bright_m = 3000.0, .range_m = 9000.0};
    }

    Terrain terrain;
    ShaderSources sources;
    Grid<Pixel> colours;
    TerrainTextures textures;
    TerrainRenderer renderer;
    TerrainLamps lamps;
    TerrainView view;
    TerrainLight light;
};

// The cell that a pixel of the picture shows, to a cell or two.
std::array<std::size_t, 2> cell_of(const Scene& scene, std::size_t row, std::size_t column)
{
    const double height_m = 4000.0 - static_cast<double>(scene.terrain.heights_m(75, 75));
    const double per_pixel = 2.0 * height_m * tangent(10_deg) / 150.0 / scene.terrain.cell_size_m.x;
    const auto cell = [&](std::size_t pixel) {
        return static_cast<std::size_t>(
            std::clamp(74.5 + (static_cast<double>(pixel) - 74.5) * per_pixel, 0.0, 149.0));
    };
    return {cell(row), cell(column)};
}

// Whether all cells around are as one.
bool is_far_from_edges(const ShadowMask& mask, std::size_t row, std::size_t column, std::size_t apart)
{
    if (row < apart || column < apart || row + apart >= mask.rows() || column + apart >= mask.columns())
        return false;
    for (std::size_t r = row - apart; r <= row + apart; ++r)
        for (std::size_t c = column - apart; c <= column + apart; ++c)
            if (mask(r, c) != mask(row, column))
                return false;
    return true;
}

using TerrainLampsTest = GlTest;

TEST_F(TerrainLampsTest, LightWhatIsLitByExactAwayFromEdges)
{
    Scene scene(hills());
    const SceneLamp lamp = scene.lamp_over(75, 75, 120.0);
    EXPECT_EQ(scene.lamps.update({&lamp, 1}), 6U);
    const Grid<Pixel> picture = scene.picture();
    const ShadowMask truth =
        cast_by_exact(scene.terrain, PointLight{grid_point(lamp.position_m, scene.terrain.cell_size_m)});
    std::size_t lit = 0;
    std::size_t dark = 0;
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < picture.rows(); ++row)
        for (std::size_t column = 0; column < picture.columns(); ++column) {
            const auto [cell_row, cell_column] = cell_of(scene, row, column);
            if (!is_far_from_edges(truth, cell_row, cell_column, 4))
                continue;
            const bool should = truth(cell_row, cell_column) == Lit::yes;
            (should ? lit : dark) += 1;
            wrong += (picture(row, column)[0] > 8) == should ? 0U : 1U;
        }
    EXPECT_GT(lit, 1500U);
    EXPECT_GT(dark, 1500U);
    EXPECT_LE(wrong, (lit + dark) / 200);
}

TEST_F(TerrainLampsTest, ChangeNothingWhenThereAreNone)
{
    Scene scene(hills());
    scene.light.light.altitude = 30_deg;
    scene.light.sun_colour = {1.0f, 1.0f, 1.0f};
    const Grid<Pixel> with = scene.picture();
    scene.light.lamps = nullptr;
    EXPECT_TRUE(std::ranges::equal(with.values(), scene.picture().values()));
}

TEST_F(TerrainLampsTest, FollowTheGround)
{
    Scene scene(make_plane({.grid = {.rows = 150, .columns = 150, .cell_size_m = {10.0, 10.0}}}));
    const SceneLamp lamp = scene.lamp_over(75, 30, 20.0);
    scene.lamps.update({&lamp, 1});
    const Grid<Pixel> before = scene.picture();
    EXPECT_GT(before(75, 120)[0], 8);
    // A wall between the lamp and that place.
    const CellRectangle wall = {0, 60, 150, 2};
    for (std::size_t row = 0; row < 150; ++row)
        for (const std::size_t column : {60U, 61U})
            scene.terrain.heights_m(row, column) = 50.0f;
    scene.textures.heights_changed(wall);
    scene.renderer.heights_changed(wall);
    scene.lamps.heights_changed(wall);
    EXPECT_EQ(scene.lamps.update({&lamp, 1}), 6U);
    EXPECT_EQ(scene.picture()(75, 120)[0], 0);
}

} // namespace
} // namespace duskline::gl
