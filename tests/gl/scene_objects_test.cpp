#include "gl/gl_test.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/sweep.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/scene_objects.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;

using Pixel = std::array<std::uint8_t, 4>;
using Pixels = Grid<Pixel>;

constexpr DepthRange kDepth = {1.0, 50000.0};
constexpr int kDark = 70; // brighter surfaces see the sun

Terrain mountains()
{
    return make_mountains({.grid = {.rows = 200, .columns = 200, .cell_size_m = {20.0, 20.0}},
                           .height_m = 1500.0,
                           .feature_m = 1800.0});
}

// Things alone, without their terrain, so that nothing hides them.
struct Stage {
    Stage(const Terrain& terrain, Scenery scenery)
        : textures(terrain, Pixels(terrain.heights_m.rows(), terrain.heights_m.columns(), Pixel{}).view()),
          objects(sources, textures, std::move(scenery))
    {}

    Pixels picture(const TerrainView& view, const Texture* shadow_heights, double seconds = 0.0)
    {
        const Texture colour(TextureFormat::rgba8, view.width, view.height);
        const Texture depth(TextureFormat::depth32f, view.width, view.height);
        const Framebuffer framebuffer({&colour}, &depth);
        framebuffer.clear({0.0f, 0.0f, 0.0f, 0.0f});
        framebuffer.bind();
        objects.draw(view, kDepth, light, shadow_heights, seconds);
        return read_back_picture(view.width, view.height);
    }

    ShaderSources sources;
    TerrainTextures textures;
    SceneObjects objects;
    TerrainLight light = {.light = {.azimuth = 250_deg, .altitude = 14_deg}, .ambient = 0.05f, .air = false};
};

// A cell with shadow well above its ground, and hardly higher or lower over the cells around.
struct ShadedCell {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
    double ground_m = 0.0;
    double shadow_m = 0.0;
    double slack_m = 0.0; ///< how far shadows around differ
};

ShadedCell shaded_cell(const Terrain& terrain, const ShadowField& shadow_m)
{
    for (std::uint32_t row = 20; row < 180; ++row)
        for (std::uint32_t column = 20; column < 180; ++column) {
            const ShadedCell cell{row, column, terrain.heights_m(row, column), shadow_m(row, column), 0.0};
            double slack_m = 0.0;
            for (std::uint32_t y = row - 1; y <= row + 1; ++y)
                for (std::uint32_t x = column - 1; x <= column + 1; ++x)
                    slack_m = std::max(slack_m, std::abs(shadow_m(y, x) - cell.shadow_m));
            if (cell.shadow_m > cell.ground_m + 120.0 && slack_m < 12.0)
                return {row, column, cell.ground_m, cell.shadow_m, slack_m};
        }
    ADD_FAILURE() << "no such cell";
    return {};
}

// From where the light comes from, level, at a height.
TerrainView view_with_the_light(const StandingObject& object, double height_m, const DirectionalLight& light,
                                double away_m)
{
    const SineCosine azimuth = sine_cosine(light.azimuth);
    const Vector3 at = position_m(
        {static_cast<double>(object.row), static_cast<double>(object.column), height_m}, {20.0, 20.0});
    return {.camera = {at + Vector3{azimuth.sine, azimuth.cosine, 0.0} * away_m, light.azimuth + 180_deg,
                       0_deg, 20_deg},
            .width = 96,
            .height = 192};
}

using SceneObjectsTest = GlTest;

TEST_F(SceneObjectsTest, ATowerIsDarkUpToTheHeightOfTheShadow)
{
    const Terrain terrain = mountains();
    const DirectionalLight light = {.azimuth = 250_deg, .altitude = 14_deg};
    for (const ShadowField& shadow_m :
         {shadow_heights_by_sweep(terrain, light), shadow_heights_by_exact(terrain, light)}) {
        const ShadedCell cell = shaded_cell(terrain, shadow_m);
        const double height_m = 2.0 * (cell.shadow_m - cell.ground_m);
        const StandingObject tower{cell.row, cell.column, height_m, 12.0, light.azimuth};
        Stage stage(terrain, {.towers = {tower}});
        const double away_m = 6.0 * height_m;
        const TerrainView view = view_with_the_light(tower, cell.shadow_m, light, away_m);
        const Texture heights = height_texture(shadow_m.view());
        const Pixels picture = stage.picture(view, &heights);

        std::size_t dark = 0;
        std::size_t lit = 0;
        for (std::size_t row = 0; row < view.height; ++row) {
            const double up = 1.0 - 2.0 * (static_cast<double>(row) + 0.5) / static_cast<double>(view.height);
            const double at_m = cell.shadow_m + up * std::tan(10.0 * 3.14159265 / 180.0) * (away_m - 6.0);
            const bool on_tower = at_m > cell.ground_m + 5.0 && at_m < cell.ground_m + height_m - 5.0;
            if (!on_tower || std::abs(at_m - cell.shadow_m) < cell.slack_m + 4.0)
                continue;
            ASSERT_EQ(picture(row, 48)[3], 255) << row;
            const bool in_shadow = at_m < cell.shadow_m;
            EXPECT_EQ(picture(row, 48)[0] < kDark, in_shadow) << row << ": " << at_m << " m";
            (in_shadow ? dark : lit) += 1;
        }
        EXPECT_GT(dark, 10U);
        EXPECT_GT(lit, 10U);
        // Where nothing casts, all of it is lit.
        EXPECT_GT(stage.picture(view, nullptr)(140, 48)[0], kDark);
    }
}

TEST_F(SceneObjectsTest, TreesAndAircraftAreDarkInsideAShadowAndLitAboveIt)
{
    const Terrain terrain = mountains();
    const DirectionalLight light = {.azimuth = 250_deg, .altitude = 14_deg};
    const ShadowField shadow_m = shadow_heights_by_sweep(terrain, light);
    const Texture heights = height_texture(shadow_m.view());
    const ShadedCell cell = shaded_cell(terrain, shadow_m);
    const auto brightest = [&](const Scenery& scenery, double at_m) {
        Stage stage(terrain, scenery);
        const TerrainView view = view_with_the_light({cell.row, cell.column}, at_m, light, 150.0);
        int brightness = 0;
        const Pixels picture = stage.picture(view, &heights);
        for (const Pixel& pixel : picture.values())
            brightness = std::max<int>(brightness, pixel[1]);
        return brightness;
    };
    const double over_shadow_m = cell.shadow_m - cell.ground_m;
    EXPECT_LT(brightest({.trees = {{cell.row, cell.column, 40.0, 15.0}}}, cell.ground_m + 20.0), kDark);
    EXPECT_GT(brightest({.trees = {{cell.row, cell.column, 2.0 * over_shadow_m, 15.0}}},
                        cell.ground_m + 1.5 * over_shadow_m),
              kDark);
    const auto aircraft_at = [&](double at_m) {
        return Scenery{.aircraft = CirclingAircraft{
                           .middle = {static_cast<double>(cell.row), static_cast<double>(cell.column), at_m},
                           .radius_m = 0.0,
                           .span_m = 30.0}};
    };
    EXPECT_GT(brightest(aircraft_at(cell.shadow_m + 40.0), cell.shadow_m + 40.0), kDark);
    EXPECT_LT(brightest(aircraft_at(cell.shadow_m - 40.0), cell.shadow_m - 40.0), kDark);
    EXPECT_GT(brightest(aircraft_at(cell.shadow_m - 40.0), cell.shadow_m - 40.0), 0); // and in the picture
}

// Each pixel of a cloud as the shadow heights over its cell say; what is not in shadow is to the bit as without any.
TEST_F(SceneObjectsTest, CloudsAreDarkWhereTheirPlaceIsInShadow)
{
    const Terrain terrain = mountains();
    const DirectionalLight light = {.azimuth = 250_deg, .altitude = 14_deg};
    const ShadowField shadow_m = shadow_heights_by_sweep(terrain, light);
    const Texture heights = height_texture(shadow_m.view());
    const double layer_m = 1000.0;
    Stage stage(terrain, {.clouds = CloudLayer{.height_m = layer_m, .feature_m = 900.0, .cover = 0.9}});
    const double over_m = 9000.0;
    const TerrainView view = {
        .camera = {{1990.0, -1990.0, layer_m + over_m}, 0_deg, Angle::from_degrees(-90.0), 24_deg},
        .width = 128,
        .height = 128};
    const Pixels with = stage.picture(view, &heights);
    const Pixels without = stage.picture(view, nullptr);
    const double cells_a_pixel = 2.0 * over_m * std::tan(12.0 * 3.14159265 / 180.0) / 128.0 / 20.0;
    std::size_t dark = 0;
    std::size_t lit = 0;
    for (std::size_t y = 0; y < 128; ++y)
        for (std::size_t x = 0; x < 128; ++x) {
            const double row = 99.5 + (static_cast<double>(y) - 63.5) * cells_a_pixel;
            const double column = 99.5 + (static_cast<double>(x) - 63.5) * cells_a_pixel;
            if (without(y, x)[3] < 100 || row < 2.0 || row > 196.0 || column < 2.0 || column > 196.0)
                continue;
            std::size_t shading = 0;
            for (std::size_t i = 0; i < 16; ++i)
                shading += static_cast<double>(shadow_m(static_cast<std::size_t>(row) - 1 + i / 4,
                                                        static_cast<std::size_t>(column) - 1 + i % 4))
                                   > layer_m
                               ? 1U
                               : 0U;
            if (shading == 0) {
                EXPECT_EQ(with(y, x), without(y, x)) << y << ", " << x;
                ++lit;
            } else if (shading == 16) {
                EXPECT_LT(with(y, x)[0] + 20, without(y, x)[0]) << y << ", " << x;
                ++dark;
            }
        }
    EXPECT_GT(dark, 100U);
    EXPECT_GT(lit, 500U);
}

TEST_F(SceneObjectsTest, StandOnTheGroundThatIsThereNow)
{
    Terrain terrain = make_plane({.grid = {.rows = 60, .columns = 60, .cell_size_m = {20.0, 20.0}}});
    const StandingObject tower{30, 30, 60.0, 20.0, 250_deg};
    Stage stage(terrain, {.towers = {tower}});
    const TerrainView view = view_with_the_light(tower, 60.0, stage.light.light, 600.0);
    const auto top_row = [&] {
        const Pixels picture = stage.picture(view, nullptr);
        std::size_t row = 0;
        while (row < view.height && picture(row, 48)[3] == 0)
            ++row;
        return row;
    };
    const std::size_t before = top_row();
    for (float& height_m : terrain.heights_m.values())
        height_m += 50.0f;
    stage.textures.heights_changed({0, 0, 60, 60});
    // 192 pixels are 2 tan(10) 590 m.
    EXPECT_NEAR(static_cast<double>(before - top_row()),
                50.0 * 192.0 / (2.0 * std::tan(10.0 * 3.14159265 / 180.0) * 590.0), 1.5);
}

} // namespace
} // namespace duskline::gl
