#include "gl/edge_distance.h"
#include "gl/gl_test.h"
#include "mask_assertions.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/ray.h>
#include <duskline/gl/program.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/terrain_shadow_map.h>
#include <duskline/products/mask_difference.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

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

// The two triangles of each square as they are drawn.
double mesh_height_m(const Terrain& terrain, double row, double column)
{
    const auto low = [](double at, std::size_t samples) {
        return std::min(static_cast<std::size_t>(at), samples - 2);
    };
    const std::size_t r = low(row, terrain.heights_m.rows());
    const std::size_t c = low(column, terrain.heights_m.columns());
    const double y = row - static_cast<double>(r);
    const double x = column - static_cast<double>(c);
    const auto height_m = [&](std::size_t i, std::size_t j) {
        return static_cast<double>(terrain.heights_m(r + i, c + j));
    };
    const double corner_m = y > x ? height_m(1, 0) : height_m(0, 1);
    const double to_corner_m = corner_m - height_m(0, 0);
    const double from_corner_m = height_m(1, 1) - corner_m;
    return height_m(0, 0) + std::max(x, y) * to_corner_m + std::min(x, y) * from_corner_m;
}

// The same triangles with so many samples a cell, so that rays, which see lines of samples alone, see the diagonals too.
Terrain refined(const Terrain& terrain, std::size_t by)
{
    const auto samples = [&](std::size_t cells) { return (cells - 1) * by + 1; };
    const double step = 1.0 / static_cast<double>(by);
    Terrain fine = {Grid<float>(samples(terrain.heights_m.rows()), samples(terrain.heights_m.columns())),
                    {step * terrain.cell_size_m.x, step * terrain.cell_size_m.y}};
    for (std::size_t row = 0; row < fine.heights_m.rows(); ++row)
        for (std::size_t column = 0; column < fine.heights_m.columns(); ++column)
            fine.heights_m(row, column) = static_cast<float>(
                mesh_height_m(terrain, step * static_cast<double>(row), step * static_cast<double>(column)));
    return fine;
}

// What is true of any place on or above a terrain, which may be refined.
class Truth {
public:
    Truth(const Terrain& terrain, const DirectionalLight& light, std::size_t refined_by = 1)
        : terrain_(terrain), light_(light), refined_by_(static_cast<double>(refined_by)),
          fine_(refined(terrain, refined_by)), rays_(fine_)
    {}

    GroundPlace at(double row, double column, double above_m) const
    {
        const double height_m = mesh_height_m(terrain_, row, column) + above_m;
        return {position_m({row, column, height_m}, terrain_.cell_size_m),
                !rays_.is_shadowed({row * refined_by_, column * refined_by_, height_m}, light_)};
    }
    bool is_lit(double row, double column) const { return at(row, column, 0.0).lit; }

    bool has_edge_within(double texels, double row, double column, const ShadowBox& box) const
    {
        const auto last = [](std::size_t samples) { return static_cast<double>(samples - 1); };
        const auto around = [&](double x_m, double y_m, double above_m) {
            return at(
                std::clamp(row - y_m / terrain_.cell_size_m.y, 0.0, last(terrain_.heights_m.rows())),
                std::clamp(column + x_m / terrain_.cell_size_m.x, 0.0, last(terrain_.heights_m.columns())),
                above_m);
        };
        return gl::has_edge_within(texels, around, box);
    }

private:
    const Terrain& terrain_;
    DirectionalLight light_;
    double refined_by_;
    Terrain fine_;
    TerrainRays rays_;
};

// How a mask by the map differs from the truth: of the cells that are in the box and not where it fades, nor so near the
// border of the grid that a kernel reaches out of it.
struct Difference {
    std::size_t cells = 0;
    std::size_t dark = 0;
    std::size_t wrong = 0;
    std::size_t far = 0;     ///< of those, with no edge of the truth within two texels
    std::size_t farther = 0; ///< nor within four
    double farthest_texels =
        0.0; ///< of all: by how much they would have to lie higher or lower, across the light
    std::size_t dark_outside = 0; ///< of those beyond the box
};

bool holds(const ShadowBox& box, const Vector3& place_m, double share)
{
    const Vector3 from_centre_m = place_m - box.centre_m;
    return std::max({std::abs(dot(from_centre_m, box.axes.right)), std::abs(dot(from_centre_m, box.axes.up)),
                     std::abs(dot(from_centre_m, box.axes.towards_light))})
           <= 0.5 * share * box.side_m;
}

// What is true of a terrain in a light.
struct Cast {
    Cast(const Terrain& cast_terrain, const DirectionalLight& from)
        : terrain(cast_terrain), light(from), mask(cast_by_exact(terrain, light)),
          shadow(shadow_heights_by_exact(terrain, light)), around(terrain, light)
    {}

    const Terrain& terrain;
    DirectionalLight light;
    ShadowMask mask;
    ShadowField shadow;
    Truth around;
};

Difference difference(const Cast& truth, const ShadowMask& mask, const ShadowBox& box, const Vector3& eye_m)
{
    const Terrain& terrain = truth.terrain;
    const double across = sine_cosine(truth.light.altitude).cosine;
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
            result.dark += truth.mask(row, column) == Lit::no ? 1U : 0U;
            if (mask(row, column) == truth.mask(row, column))
                continue;
            ++result.wrong;
            const double off_m = std::abs(height_m - static_cast<double>(truth.shadow(row, column))) * across;
            const auto is_far = [&](double texels) {
                return !truth.around.has_edge_within(texels, static_cast<double>(row),
                                                     static_cast<double>(column), box);
            };
            if (is_far(2.0)) {
                ++result.far;
                result.farther += is_far(4.0) ? 1U : 0U;
            }
            result.farthest_texels = std::max(result.farthest_texels, off_m / box.texel_m);
        }
    return result;
}

using TerrainShadowMapTest = GlTest;

DirectionalLight light_from(double azimuth_deg, double altitude_deg)
{
    return {.azimuth = Angle::from_degrees(azimuth_deg), .altitude = Angle::from_degrees(altitude_deg)};
}

// Of the light: azimuth and altitude, degrees.
constexpr std::array<std::pair<double, double>, 5> kSuns = {
    {{75.0, 2.0}, {75.0, 6.0}, {200.0, 20.0}, {0.0, 45.0}, {130.0, 80.0}}};

// Texels are from a tenth of a cell wide to a whole one. What remains lies at the foot of a slope that the light grazes: see
// the documentation.
TEST_F(TerrainShadowMapTest, IsRightButForTwoTexelsAtEdgesFromEveryHeight)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    const auto with = [&](ShadowMapOptions options) {
        options.size = 512;
        return std::make_unique<TerrainShadowMap>(scene.sources, scene.textures, options);
    };
    const std::array techniques = {with({}), with({.filter = ShadowMapFilter::none}),
                                   with({.filter = ShadowMapFilter::disc})};
    const std::array<double, 3> far_shares = {1e-5, 2e-5, 2e-5};
    std::array<Difference, 3> all = {};
    for (const auto& [azimuth_deg, altitude_deg] : kSuns) {
        const Cast truth(terrain, light_from(azimuth_deg, altitude_deg));
        for (const double clearance_m : {15.0, 50.0, 100.0, 200.0})
            for (std::size_t i = 0; i < techniques.size(); ++i) {
                TerrainShadowMap& technique = *techniques.at(i);
                const TerrainView view =
                    view_over(terrain, clearance_m, Angle::from_degrees(azimuth_deg + 40.0));
                technique.look_from(view);
                technique.cast(truth.light);
                const Difference found = difference(truth, scene.renderer.lit_mask(technique.shadow()),
                                                    technique.map().box(), view.camera.position_m);
                EXPECT_EQ(found.dark_outside, 0U);
                EXPECT_GT(found.cells, 500U);
                all.at(i).cells += found.cells;
                all.at(i).dark += found.dark;
                all.at(i).wrong += found.wrong;
                all.at(i).far += found.far;
                all.at(i).farther += found.farther;
            }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Difference& found = all.at(i);
        EXPECT_LE(static_cast<double>(found.far), far_shares.at(i) * static_cast<double>(found.cells))
            << i << ": " << found.far << " of " << found.cells;
        EXPECT_LE(found.farther, i == 0 ? 0U : 2U) << i;
        EXPECT_LT(found.wrong, found.cells / 50) << i;
        EXPECT_GT(found.dark, found.cells / 4);
    }
}

constexpr const char* kAsk = R"(#version 430 core
#include "terrain_shadow_map.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Places { vec2 places[]; }; // columns and rows
layout(std430, binding = 5) writeonly buffer Answers { float answers[]; };
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(answers.length()))
        answers[i] = terrain_shadow_map(places[i]);
}
)";

using Place = std::array<float, 2>;

// Random ones that the box holds, before it fades.
std::vector<Place> places_in(const ShadowBox& box, const Vector3& eye_m, const Terrain& terrain)
{
    std::mt19937 random(7);
    const double most = static_cast<double>(terrain.heights_m.rows() - 1);
    const auto number = [&] {
        return static_cast<float>(most * static_cast<double>(random()) / 4294967296.0);
    };
    std::vector<Place> places;
    for (int i = 0; i < 20000; ++i) {
        const Place place = {number(), number()};
        const double column = static_cast<double>(place[0]);
        const double row = static_cast<double>(place[1]);
        const Vector3 at_m =
            position_m({row, column, mesh_height_m(terrain, row, column)}, terrain.cell_size_m);
        const double from_border = std::min({row, column, most - row, most - column});
        if (from_border > 10.0 && length(at_m - eye_m) < 0.9 * box.radius_m && holds(box, at_m, 0.98))
            places.push_back(place);
    }
    return places;
}

std::vector<float> ask(const Program& program, const TerrainShadowMap& technique,
                       const std::vector<Place>& places)
{
    Buffer questions;
    const Buffer answers(places.size() * sizeof(float));
    questions.upload(places);
    questions.bind_as_storage(4);
    answers.bind_as_storage(5);
    technique.bind(program, 0);
    dispatch(program, places.size());
    return answers.download<float>();
}

TEST_F(TerrainShadowMapTest, IsRightButForTwoTexelsAtEdgesBetweenTheCellsToo)
{
    const Terrain terrain = hills(5.0);
    Scene scene(terrain);
    scene.sources.add("ask.comp.glsl", kAsk);
    TerrainShadowMap technique(scene.sources, scene.textures, {.size = 512});
    const Program program(scene.sources, {{"ask.comp.glsl"}, technique.look_up_defines()});
    for (const auto& [azimuth_deg, altitude_deg] : kSuns) {
        const DirectionalLight light = light_from(azimuth_deg, altitude_deg);
        const Truth truth(terrain, light, 4);
        for (const double clearance_m : {50.0, 100.0, 200.0}) {
            const TerrainView view = view_over(terrain, clearance_m, Angle::from_degrees(azimuth_deg + 40.0));
            technique.look_from(view);
            technique.cast(light);
            const ShadowBox& box = technique.map().box();
            const std::vector<Place> places = places_in(box, view.camera.position_m, terrain);
            const std::vector<float> lit = ask(program, technique, places);
            std::size_t far = 0;
            for (std::size_t i = 0; i < places.size(); ++i) {
                const double column = static_cast<double>(places[i][0]);
                const double row = static_cast<double>(places[i][1]);
                if ((lit[i] > 0.5f) != truth.is_lit(row, column))
                    far += truth.has_edge_within(2.0, row, column, box) ? 0U : 1U;
            }
            EXPECT_EQ(far, 0U) << clearance_m << " m, " << altitude_deg << " degrees, of " << places.size();
            EXPECT_GT(places.size(), 500U);
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
    const Difference found = difference(Cast(terrain, light), scene.renderer.lit_mask(technique.shadow()),
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
