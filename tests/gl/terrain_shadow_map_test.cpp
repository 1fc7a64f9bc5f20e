#include "gl/gl_test.h"
#include "mask_assertions.h"

#include <duskline/casting/exact.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/terrain_shadow_map.h>
#include <duskline/products/mask_difference.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;

using Pixel = std::array<std::uint8_t, 4>;

struct Scene {
    explicit Scene(const Terrain& terrain)
        : colours(terrain.heights_m.rows(), terrain.heights_m.columns(), Pixel{150, 150, 150, 255}),
          textures(terrain, colours.view()), renderer(sources, textures)
    {}

    ShaderSources sources;
    Grid<Pixel> colours;
    TerrainTextures textures;
    TerrainRenderer renderer;
};

Terrain hills(double cell_m)
{
    return make_mountains({.grid = {.rows = 300, .columns = 300, .cell_size_m = {cell_m, cell_m}},
                           .height_m = 40.0 * cell_m,
                           .feature_m = 80.0 * cell_m,
                           .roughness = 0.35});
}

// From so far above the ground in the middle of it.
TerrainView view_over(const Terrain& terrain, double clearance_m, Angle heading, std::size_t column = 150)
{
    const GridPoint middle = {150.0, static_cast<double>(column),
                              static_cast<double>(terrain.heights_m(150, column)) + clearance_m};
    return {.camera = {position_m(middle, terrain.cell_size_m), heading, Angle::from_degrees(-15.0), 60_deg},
            .width = 200,
            .height = 150};
}

// How a mask by the map differs from the truth: of the cells that are in the box and not where it fades, nor so near the
// border of the grid that a kernel reaches out of it.
struct Difference {
    std::size_t cells = 0;
    std::size_t dark = 0;
    std::size_t wrong = 0;
    std::size_t far = 0;          ///< of those, farther than two texels from where they would be right
    double farthest_texels = 0.0; ///< of all; measured across the light
    std::size_t dark_outside = 0; ///< of those beyond the box
};

bool holds(const ShadowBox& box, const Vector3& place_m, double share)
{
    const Vector3 from_centre_m = place_m - box.centre_m;
    return std::max({std::abs(dot(from_centre_m, box.axes.right)), std::abs(dot(from_centre_m, box.axes.up)),
                     std::abs(dot(from_centre_m, box.axes.towards_light))})
           <= 0.5 * share * box.side_m;
}

Difference difference(const Terrain& terrain, const ShadowMask& mask, const DirectionalLight& light,
                      const ShadowBox& box, const Vector3& eye_m)
{
    const ShadowMask truth = cast_by_exact(terrain, light);
    const ShadowField shadow = shadow_heights_by_exact(terrain, light);
    const double across = sine_cosine(light.altitude).cosine;
    Difference result;
    for (std::size_t row = 3; row < mask.rows() - 3; ++row)
        for (std::size_t column = 3; column < mask.columns() - 3; ++column) {
            const double height_m = static_cast<double>(terrain.heights_m(row, column));
            const Vector3 place_m = position_m(
                {static_cast<double>(row), static_cast<double>(column), height_m}, terrain.cell_size_m);
            if (length(place_m - eye_m) > box.radius_m || !holds(box, place_m, 1.001)) {
                result.dark_outside += mask(row, column) == Lit::no ? 1U : 0U;
                continue;
            }
            if (length(place_m - eye_m) > 0.9 * box.radius_m || !holds(box, place_m, 0.999))
                continue;
            ++result.cells;
            result.dark += truth(row, column) == Lit::no ? 1U : 0U;
            if (mask(row, column) == truth(row, column))
                continue;
            ++result.wrong;
            const double off_m = std::abs(height_m - static_cast<double>(shadow(row, column))) * across;
            result.far += off_m > 2.0 * box.texel_m ? 1U : 0U;
            result.farthest_texels = std::max(result.farthest_texels, off_m / box.texel_m);
        }
    return result;
}

using TerrainShadowMapTest = GlTest;

// Cells are some texels wide. Shadows and gaps as narrow as a texel, or a kernel, may be lost.
TEST_F(TerrainShadowMapTest, IsRightButForTwoTexelsAtEdgesFromEveryHeight)
{
    for (const double clearance_m : {15.0, 50.0, 100.0, 200.0}) {
        const Terrain terrain = hills(clearance_m / 6.0);
        Scene scene(terrain);
        for (const auto& [filter, texels] :
             {std::pair{ShadowMapFilter::none, 4.0}, {ShadowMapFilter::kernels, 7.0}}) {
            TerrainShadowMap technique(
                scene.sources, scene.textures,
                {.size = 512, .filter = filter, .linear_compare = filter != ShadowMapFilter::none});
            for (const auto& [altitude_deg, azimuth_deg] :
                 {std::pair{6.0, 75.0}, {20.0, 200.0}, {45.0, 0.0}}) {
                const DirectionalLight light = {.azimuth = Angle::from_degrees(azimuth_deg),
                                                .altitude = Angle::from_degrees(altitude_deg)};
                const TerrainView view =
                    view_over(terrain, clearance_m, Angle::from_degrees(azimuth_deg + 40.0));
                technique.look_from(view);
                technique.cast(light);
                const Difference found = difference(terrain, scene.renderer.lit_mask(technique.shadow()),
                                                    light, technique.map().box(), view.camera.position_m);
                EXPECT_LE(found.farthest_texels, texels)
                    << clearance_m << ", " << altitude_deg << ": " << found.wrong << " of " << found.cells
                    << ", " << found.dark << " dark";
                EXPECT_LE(found.far, found.cells / 500);
                EXPECT_GT(found.cells, 5000U);
                EXPECT_EQ(found.dark_outside, 0U);
                if (altitude_deg < 30.0) {
                    EXPECT_GT(found.dark, 200U);
                }
            }
        }
    }
}

TEST_F(TerrainShadowMapTest, CoarseCastersShadeNothingTheyShouldNot)
{
    // From high up, where the map's texels are as large as several cells.
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 64});
    const DirectionalLight light = {.azimuth = 75_deg, .altitude = 20_deg};
    const TerrainView view = view_over(terrain, 1500.0, 10_deg);
    technique.look_from(view);
    technique.cast(light);
    EXPECT_GT(TerrainCasters(scene.sources, scene.textures).step(technique.map().box()), 1U);
    const Difference found = difference(terrain, scene.renderer.lit_mask(technique.shadow()), light,
                                        technique.map().box(), view.camera.position_m);
    EXPECT_GT(found.cells, 10000U);
    EXPECT_LE(found.farthest_texels, 2.0);
}

TEST_F(TerrainShadowMapTest, GoesWithTheEye)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 512});
    const DirectionalLight light = {.azimuth = 75_deg, .altitude = 15_deg};
    TerrainView view = view_over(terrain, 10.0, 0_deg);
    EXPECT_TRUE(technique.look_from(view));
    EXPECT_FALSE(technique.look_from(view));
    for (const std::size_t middle : {60U, 240U}) {
        view = view_over(terrain, 10.0, 0_deg, middle);
        EXPECT_TRUE(technique.look_from(view));
        technique.cast(light);
        const ShadowMask mask = scene.renderer.lit_mask(technique.shadow());
        for (std::size_t row = 0; row < 300; ++row)
            for (std::size_t column = 0; column < 300; ++column)
                if (std::abs(5.0 * static_cast<double>(column) - view.camera.position_m.x) > 130.0) {
                    ASSERT_EQ(mask(row, column), Lit::yes) << row << ", " << column;
                }
    }
}

TEST_F(TerrainShadowMapTest, WithoutAnEyeHoldsTheWholeTerrain)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 2048});
    const DirectionalLight light = {.azimuth = 75_deg, .altitude = 15_deg};
    technique.cast(light);
    const ShadowMask truth = cast_by_exact(terrain, light);
    const MaskDifference found = mask_difference(truth, scene.renderer.lit_mask(technique.shadow()));
    EXPECT_LT(found.differing, found.cells / 50);
}

TEST_F(TerrainShadowMapTest, TheWideMapShadesWhatTheNearOneDoesNotHold)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    const DirectionalLight light = {.azimuth = 75_deg, .altitude = 15_deg};
    const TerrainView view = view_over(terrain, 20.0, 30_deg);
    const ShadowMask truth = cast_by_exact(terrain, light);
    std::array<std::size_t, 2> differing = {};
    for (const double wide_reach : {0.0, 96.0}) {
        TerrainShadowMap technique(scene.sources, scene.textures, {.size = 2048, .wide_reach = wide_reach});
        technique.look_from(view);
        technique.cast(light);
        const ShadowMask mask = scene.renderer.lit_mask(technique.shadow());
        for (std::size_t row = 0; row < 100; ++row) // ahead
            for (std::size_t column = 150; column < 250; ++column)
                differing.at(wide_reach > 0.0 ? 1 : 0) += mask(row, column) != truth(row, column) ? 1U : 0U;
    }
    EXPECT_GT(differing[0], 2000U);
    EXPECT_LT(differing[1], 300U) << differing[0];
}

TEST_F(TerrainShadowMapTest, ALightBelowTheHorizonLightsNothing)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 128});
    for (const Angle altitude : {-10_deg, 0_deg}) {
        const DirectionalLight light = {.azimuth = 75_deg, .altitude = altitude};
        technique.cast(light);
        EXPECT_TRUE(same_mask(scene.renderer.lit_mask(technique.shadow()), cast_by_exact(terrain, light)));
    }
}

TEST_F(TerrainShadowMapTest, FollowsEditsOfTheGround)
{
    Terrain terrain = hills(5.0);
    const DirectionalLight light = {.azimuth = 75_deg, .altitude = 15_deg};
    Scene scene(terrain);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 512});
    const TerrainView view = view_over(terrain, 60.0, 300_deg);
    technique.look_from(view);
    technique.cast(light);
    const CellRectangle changed = {.first_row = 80, .first_column = 100, .rows = 30, .columns = 40};
    for (std::size_t row = 80; row < 110; ++row)
        for (std::size_t column = 100; column < 140; ++column)
            terrain.heights_m(row, column) += 60.0f;
    scene.textures.heights_changed(changed);
    technique.heights_changed(changed);
    const ShadowMask edited = scene.renderer.lit_mask(technique.shadow());

    Scene anew(terrain);
    TerrainShadowMap cast_anew(anew.sources, anew.textures, {.size = 512});
    cast_anew.look_from(view);
    cast_anew.cast(light);
    EXPECT_TRUE(same_mask(edited, anew.renderer.lit_mask(cast_anew.shadow())));
}

} // namespace
} // namespace duskline::gl
