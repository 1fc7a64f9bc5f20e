#include "gl/gl_test.h"
#include "mask_assertions.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/smap.h>
#include <duskline/casting/strider.h>
#include <duskline/casting/sweep.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_technique.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/terrain/ground_motion.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;

using Pixel = std::array<std::uint8_t, 4>;
using Pixels = Grid<Pixel>;

constexpr Pixel kBackground = {255, 0, 255, 0};
constexpr auto kNaN = std::numeric_limits<float>::quiet_NaN();

Terrain mountains(std::size_t rows, std::size_t columns)
{
    return make_mountains({.grid = {.rows = rows, .columns = columns, .cell_size_m = {20.0, 20.0}},
                           .height_m = 1500.0,
                           .feature_m = 1800.0,
                           .roughness = 0.55});
}

// The terrain alone on the background's colour.
Pixels picture_of(TerrainRenderer& renderer, const TerrainView& view, const TerrainLight& light,
                  const TerrainShadow& shadow = {}, const Texture* truth = nullptr)
{
    const Texture colour(TextureFormat::rgba8, view.width, view.height);
    const Texture depth(TextureFormat::depth32f, view.width, view.height);
    const Framebuffer framebuffer({&colour}, &depth);
    framebuffer.clear({1.0f, 0.0f, 1.0f, 0.0f});
    framebuffer.bind();
    renderer.draw_terrain(view, light, shadow, truth);
    return read_back_picture(view.width, view.height);
}

// A terrain on the card, its colours all one grey, transparent where there are no data.
struct Scene {
    explicit Scene(const Terrain& terrain)
        : textures(terrain, grey(terrain).view()), renderer(sources, textures)
    {}

    static Pixels grey(const Terrain& terrain)
    {
        Pixels colours(terrain.heights_m.rows(), terrain.heights_m.columns());
        std::ranges::transform(terrain.heights_m.values(), colours.values().begin(), [](float height_m) {
            return std::isnan(height_m) ? Pixel{0, 0, 0, 0} : Pixel{150, 150, 150, 255};
        });
        return colours;
    }

    Pixels picture(const TerrainView& view, const TerrainShadow& shadow = {}, const Texture* truth = nullptr)
    {
        return picture_of(renderer, view, light, shadow, truth);
    }

    ShaderSources sources;
    TerrainTextures textures;
    TerrainRenderer renderer;
    TerrainLight light = {.light = {.azimuth = 250_deg, .altitude = 25_deg}, .air = false};
};

TerrainView view_from(const Vector3& position_m, Angle heading, double pitch_deg)
{
    return {
        .camera = {position_m, heading, Angle::from_degrees(pitch_deg), 60_deg}, .width = 200, .height = 150};
}

// Straight down on the middle of square cells of 20 m.
TerrainView from_above(std::size_t side, double height_m)
{
    const double middle_m = 10.0 * static_cast<double>(side);
    return {.camera = {{middle_m, -middle_m, height_m}, 0_deg, Angle::from_degrees(-89.9), 30_deg},
            .width = 128,
            .height = 128};
}

int brightness(const Pixels& picture, std::size_t row, std::size_t column)
{
    return picture(row, column)[0];
}

// All that is left to do, at once.
void settle(ShadowTechnique& technique)
{
    for (int i = 0; technique.done() < 1.0 && i < 10000; ++i)
        technique.advance(std::chrono::seconds(1));
}

using TerrainPicture = GlTest;

TEST_F(TerrainPicture, HasNoCracks)
{
    const Terrain terrain = mountains(500, 500);
    Scene scene(terrain);
    std::size_t seen = 0;
    for (const double pixel_error : {0.5, 8.0})
        for (const double heading_deg : {10.0, 100.0, 200.0, 300.0}) {
            TerrainView view = view_from({5000.0, -5000.0, 1700.0}, Angle::from_degrees(heading_deg), -18.0);
            view.pixel_error = pixel_error;
            const Pixels picture = scene.picture(view);
            for (std::size_t column = 0; column < picture.columns(); ++column) {
                std::size_t row = 0;
                while (row < picture.rows() && picture(row, column) == kBackground)
                    ++row;
                // Under the skyline there is ground, all the way down.
                for (; row < picture.rows(); ++row, ++seen)
                    ASSERT_NE(picture(row, column), kBackground) << row << ", " << column;
            }
        }
    EXPECT_GT(seen, 100000U);
}

TEST_F(TerrainPicture, IsTheSameAgainWhateverWasDrawnBetween)
{
    const Terrain terrain = mountains(300, 300);
    Scene scene(terrain);
    const auto technique = shadow_technique_named("sweep").make(scene.sources, scene.textures, false);
    technique->cast(scene.light.light);
    const TerrainView here = view_from({3000.0, -3000.0, 1500.0}, 40_deg, -20.0);
    const Pixels first = scene.picture(here, technique->shadow());
    for (const double heading_deg : {90.0, 200.0}) {
        technique->cast({.azimuth = Angle::from_degrees(heading_deg), .altitude = 5_deg});
        scene.picture(view_from({1000.0, -2000.0, 2500.0}, Angle::from_degrees(heading_deg), -40.0),
                      technique->shadow());
    }
    technique->cast(scene.light.light);
    const Pixels again = scene.picture(here, technique->shadow());
    EXPECT_TRUE(std::ranges::equal(first.values(), again.values()));
}

TEST_F(TerrainPicture, IsBrightTowardsTheSun)
{
    const Terrain hill =
        make_gaussian_hill({.grid = {.rows = 129, .columns = 129, .cell_size_m = {20.0, 20.0}},
                            .height_m = 300.0,
                            .sigma_m = 350.0});
    Scene scene(hill);
    scene.light.light = {.azimuth = 270_deg, .altitude = 40_deg};
    const Pixels west = scene.picture(from_above(129, 4000.0));
    EXPECT_GT(brightness(west, 64, 45), brightness(west, 64, 82) + 30);
    scene.light.light.azimuth = 0_deg;
    const Pixels north = scene.picture(from_above(129, 4000.0));
    EXPECT_GT(brightness(north, 45, 64), brightness(north, 82, 64) + 30);
}

TEST_F(TerrainPicture, IsDarkInShadowAndOnlyThere)
{
    const Terrain wall = make_wall({.grid = {.rows = 129, .columns = 129, .cell_size_m = {20.0, 20.0}},
                                    .height_m = 400.0,
                                    .thickness_m = 60.0});
    Scene scene(wall);
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        const auto technique = kind.make(scene.sources, scene.textures, false);
        for (const double azimuth_deg : {0.0, 90.0, 180.0, 270.0}) {
            scene.light.light = {.azimuth = Angle::from_degrees(azimuth_deg), .altitude = 45_deg};
            technique->cast(scene.light.light);
            settle(*technique);
            const Pixels picture = scene.picture(from_above(129, 6000.0), technique->shadow());
            const ShadowMask mask = cast_by_exact(wall, scene.light.light);
            for (const auto& [row, column] : {std::pair{30, 30},
                                              {30, 64},
                                              {30, 90},
                                              {90, 30},
                                              {90, 64},
                                              {90, 90},
                                              {64, 30},
                                              {64, 90},
                                              {60, 75},
                                              {60, 55},
                                              {56, 64},
                                              {72, 64}}) {
                // Pixels as large as cells: 128 over 2 tan(15) 6000 m are some 25 m each.
                const double per_pixel = 2.0 * 6000.0 * std::tan(15.0 * 3.14159265 / 180.0) / 128.0 / 20.0;
                const auto cell = [&](int pixel) {
                    return static_cast<std::size_t>(std::lround(64.0 + (pixel - 63.5) * per_pixel));
                };
                if (wall.heights_m(cell(row), cell(column)) > 0.0f)
                    continue;
                const bool dark =
                    brightness(picture, static_cast<std::size_t>(row), static_cast<std::size_t>(column))
                    < 110;
                EXPECT_EQ(dark, kind.name != "none" && mask(cell(row), cell(column)) == Lit::no)
                    << kind.name << ", " << azimuth_deg << ": " << row << ", " << column;
            }
        }
    }
}

TEST_F(TerrainPicture, ShowsWhatIsBehindWhereThereAreNoData)
{
    Terrain terrain = mountains(129, 129);
    for (std::size_t row = 50; row < 80; ++row)
        std::ranges::fill(terrain.heights_m.row(row).subspan(50, 30), kNaN);
    Scene scene(terrain);
    const Pixels picture = scene.picture(from_above(129, 4500.0));
    EXPECT_EQ(picture(64, 64), kBackground);
    EXPECT_NE(picture(64, 20), kBackground);
}

TEST_F(TerrainPicture, MarksWhatDiffersFromTheTruth)
{
    const Terrain terrain = make_plane({.grid = {.rows = 65, .columns = 65, .cell_size_m = {20.0, 20.0}}});
    Scene scene(terrain);
    const auto technique = shadow_technique_named("exact").make(scene.sources, scene.textures, false);
    technique->cast(scene.light.light);
    Grid<std::uint8_t> answers(65, 65, 255);
    for (std::size_t row = 0; row < 65; ++row)
        std::ranges::fill(answers.row(row).subspan(0, 32), 0);
    Texture truth(TextureFormat::r8, 65, 65);
    truth.upload(answers);
    const Pixels picture = scene.picture(from_above(65, 2000.0), technique->shadow(), &truth);
    EXPECT_EQ(picture(64, 90), scene.picture(from_above(65, 2000.0), technique->shadow())(64, 90));
    EXPECT_GT(picture(64, 30)[0], picture(64, 30)[2] + 100); // lit, and should not be
}

TEST_F(TerrainPicture, FollowsChangedHeights)
{
    Terrain terrain = mountains(200, 200);
    Scene scene(terrain);
    const auto technique = shadow_technique_named("exact").make(scene.sources, scene.textures, false);
    technique->cast(scene.light.light);
    const CellRectangle changed = {.first_row = 60, .first_column = 90, .rows = 30, .columns = 20};
    for (std::size_t row = 60; row < 90; ++row)
        for (float& height_m : terrain.heights_m.row(row).subspan(90, 20))
            height_m += 500.0f;
    scene.textures.heights_changed(changed);
    scene.renderer.heights_changed(changed);
    technique->heights_changed(changed);
    const TerrainView view = view_from({2000.0, -3800.0, 1500.0}, 0_deg, -20.0);
    const Pixels edited = scene.picture(view, technique->shadow());

    Scene anew(terrain);
    const auto cast_anew = shadow_technique_named("exact").make(anew.sources, anew.textures, false);
    cast_anew->cast(anew.light.light);
    const Pixels fresh = anew.picture(view, cast_anew->shadow());
    EXPECT_TRUE(std::ranges::equal(edited.values(), fresh.values()));
}

TEST_F(TerrainPicture, FollowsChangedColours)
{
    const Terrain terrain = mountains(200, 200);
    Scene scene(terrain);
    Pixels ground = Scene::grey(terrain);
    for (std::size_t row = 60; row < 90; ++row)
        std::ranges::fill(ground.row(row).subspan(90, 20), Pixel{220, 40, 40, 255});
    scene.textures.colours_changed(ground.view(), {60, 90, 30, 20});
    const TerrainView view = view_from({2000.0, -3800.0, 1500.0}, 0_deg, -20.0);
    const Pixels repainted = scene.picture(view);
    TerrainTextures textures(terrain, ground.view());
    TerrainRenderer renderer(scene.sources, textures);
    EXPECT_TRUE(std::ranges::equal(repainted.values(), picture_of(renderer, view, scene.light).values()));
    EXPECT_FALSE(std::ranges::equal(repainted.values(), Scene(terrain).picture(view).values()));
    EXPECT_THROW(scene.textures.colours_changed(Pixels(20, 29).view(), {}), InvalidInput);
}

using MovingGround = GlTest;

// What was brought up to date frame after frame is what a cast of the ground of that moment says.
TEST_F(MovingGround, HasItsShadowsInTheSameFrame)
{
    Terrain at_rest = mountains(150, 170);
    at_rest.heights_m(70, 80) = kNaN;
    for (const GroundMotionKind& kind : ground_motions()) {
        const auto motion = kind.make(at_rest, {});
        Terrain terrain{at_rest.heights_m.copy(), at_rest.cell_size_m};
        Scene scene(terrain);
        const auto exact = shadow_technique_named("exact").make(scene.sources, scene.textures, false);
        const auto sweep = shadow_technique_named("sweep").make(scene.sources, scene.textures, false);
        const DirectionalLight light = {.azimuth = 123_deg, .altitude = 14_deg};
        exact->cast(light);
        sweep->cast(light);
        double before_s = 0.0;
        for (const double share : {0.1, 0.14, 0.5, 0.54, 0.9, 1.0}) {
            const double now_s = share * kind.period_s;
            const CellRectangle changed =
                move_ground(*motion, at_rest, before_s, now_s, terrain.heights_m.view());
            scene.textures.heights_changed(changed);
            exact->heights_changed(changed);
            sweep->heights_changed(changed);
            EXPECT_TRUE(same_mask(cast_by_exact(terrain, light), scene.renderer.lit_mask(exact->shadow())))
                << kind.name << share;
            EXPECT_TRUE(same_mask(mask_of(terrain, shadow_heights_by_sweep(terrain, light)),
                                  scene.renderer.lit_mask(sweep->shadow())))
                << kind.name << share;
            before_s = now_s;
        }
    }
}

TEST_F(TerrainPicture, RefusesColoursOfAnotherSize)
{
    const Terrain terrain = mountains(20, 30);
    EXPECT_THROW(TerrainTextures(terrain, Pixels(20, 29).view()), InvalidInput);
}

using Techniques = GlTest;

TEST_F(Techniques, AnswerAsTheirCasters)
{
    Terrain terrain = mountains(150, 170);
    terrain.heights_m(70, 80) = kNaN;
    Scene scene(terrain);
    const auto exact = shadow_technique_named("exact").make(scene.sources, scene.textures, false);
    const auto sweep = shadow_technique_named("sweep").make(scene.sources, scene.textures, false);
    for (const double azimuth_deg : {0.0, 33.0, 135.0, 200.0, 291.0}) {
        const DirectionalLight light = {.azimuth = Angle::from_degrees(azimuth_deg), .altitude = 12_deg};
        exact->cast(light);
        sweep->cast(light);
        EXPECT_TRUE(same_mask(cast_by_exact(terrain, light), scene.renderer.lit_mask(exact->shadow())));
        EXPECT_TRUE(same_mask(mask_of(terrain, shadow_heights_by_sweep(terrain, light)),
                              scene.renderer.lit_mask(sweep->shadow())));
    }
}

TEST_F(Techniques, SilhouettesAnswerAsTheirCasterButForTies)
{
    Terrain terrain = mountains(80, 95);
    terrain.heights_m(40, 50) = kNaN;
    Scene scene(terrain);
    for (const char* name : {"full-scan", "smap-binary", "smap-quad", "smap-parallel", "smap-cells"}) {
        const auto technique = shadow_technique_named(name).make(scene.sources, scene.textures, false);
        for (const double azimuth_deg : {0.0, 33.0, 200.0, 291.0}) {
            const DirectionalLight light = {.azimuth = Angle::from_degrees(azimuth_deg), .altitude = 12_deg};
            technique->cast(light);
            EXPECT_TRUE(same_mask(scene.renderer.lit_mask(technique->shadow()), cast_by_smap(terrain, light),
                                  ties(terrain, shadow_heights_by_smap(terrain, light))))
                << name << ", " << azimuth_deg;
        }
        for (const Angle altitude : {-5_deg, 0_deg, 90_deg}) {
            technique->cast({.azimuth = 33_deg, .altitude = altitude});
            EXPECT_TRUE(same_mask(scene.renderer.lit_mask(technique->shadow()),
                                  cast_by_smap(terrain, {.azimuth = 33_deg, .altitude = altitude})))
                << name << ", " << altitude.degrees();
        }
    }
}

TEST_F(Techniques, StriderShowsWholeMasksOnlyAndCatchesUp)
{
    Terrain terrain = mountains(200, 170);
    terrain.heights_m(40, 50) = kNaN;
    Scene scene(terrain);
    const auto technique = shadow_technique_named("strider").make(scene.sources, scene.textures, false);
    const DirectionalLight morning = {.azimuth = 100_deg, .altitude = 12_deg};
    const DirectionalLight noon = {.azimuth = 180_deg, .altitude = 40_deg};
    const DirectionalLight evening = {.azimuth = 250_deg, .altitude = 9_deg};
    const auto shown = [&] { return scene.renderer.lit_mask(technique->shadow()); };

    technique->cast(morning); // there is nothing else to show
    EXPECT_EQ(technique->done(), 1.0);
    EXPECT_TRUE(same_mask(shown(), cast_by_strider(terrain, morning)));

    technique->cast(noon);
    EXPECT_LT(technique->done(), 1.0);
    EXPECT_TRUE(same_mask(shown(), cast_by_strider(terrain, morning)));
    settle(*technique);
    EXPECT_TRUE(same_mask(shown(), cast_by_strider(terrain, noon)));

    technique->cast(evening);
    for (std::size_t row = 60; row < 80; ++row)
        terrain.heights_m(row, 60) += 700.0f;
    const CellRectangle changed = {.first_row = 60, .first_column = 60, .rows = 20, .columns = 1};
    scene.textures.heights_changed(changed);
    technique->heights_changed(changed);
    settle(*technique);
    EXPECT_TRUE(same_mask(shown(), cast_by_strider(terrain, evening)));
}

TEST_F(Techniques, StriderWorksNoLongerThanItIsToldAndGoesOnInTheNextFrame)
{
    const Terrain terrain = mountains(700, 700);
    Scene scene(terrain);
    const auto technique = shadow_technique_named("strider").make(scene.sources, scene.textures, false);
    technique->cast({.azimuth = 100_deg, .altitude = 12_deg});
    technique->cast({.azimuth = 110_deg, .altitude = 12_deg});
    double before = technique->done();
    int frames = 0;
    for (; technique->done() < 1.0; ++frames) {
        technique->advance(std::chrono::microseconds(0));
        EXPECT_GT(technique->done(), before);
        before = technique->done();
    }
    EXPECT_GT(frames, 5); // of some 65,000 cells each
}

TEST_F(Techniques, BakedMapsAreExactUnderTheirSuns)
{
    Terrain terrain = mountains(90, 110);
    terrain.heights_m(40, 50) = kNaN;
    Scene scene(terrain);
    const auto technique = shadow_technique_named("baked").make(scene.sources, scene.textures, false);
    const auto shown = [&] { return scene.renderer.lit_mask(technique->shadow()); };
    const LightCourse day = {{{.azimuth = 90_deg, .altitude = 0_deg},
                              {.azimuth = 120_deg, .altitude = 20_deg},
                              {.azimuth = 180_deg, .altitude = 35_deg},
                              {.azimuth = 250_deg, .altitude = 8_deg}}};
    technique->set_course(day);
    EXPECT_EQ(technique->done(), 0.0);
    for (const DirectionalLight& sun : day.lights) {
        technique->cast(sun);
        EXPECT_TRUE(same_mask(shown(), cast_by_exact(terrain, sun)));
    }
    EXPECT_EQ(technique->done(), 1.0);

    for (std::size_t row = 20; row < 40; ++row)
        terrain.heights_m(row, 60) += 700.0f;
    const CellRectangle changed = {.first_row = 20, .first_column = 60, .rows = 20, .columns = 1};
    scene.textures.heights_changed(changed);
    technique->heights_changed(changed);
    EXPECT_TRUE(same_mask(shown(), cast_by_exact(terrain, day.lights[3]))); // what is shown, at once
    EXPECT_EQ(technique->done(), 0.25);
    settle(*technique);
    technique->cast(day.lights[1]);
    EXPECT_TRUE(same_mask(shown(), cast_by_exact(terrain, day.lights[1])));
}

TEST_F(Techniques, BakedMapsTurnIntoOneAnother)
{
    const Terrain terrain = mountains(150, 150);
    Scene scene(terrain);
    const auto technique = shadow_technique_named("baked").make(scene.sources, scene.textures, false);
    const LightCourse course = {
        {{.azimuth = 160_deg, .altitude = 12_deg}, {.azimuth = 200_deg, .altitude = 12_deg}}};
    technique->set_course(course);
    const TerrainView view = view_from({1500.0, -3300.0, 1900.0}, 10_deg, -35.0);
    const auto picture_at = [&](double azimuth_deg) {
        technique->cast({.azimuth = Angle::from_degrees(azimuth_deg), .altitude = 12_deg});
        return scene.picture(view, technique->shadow());
    };
    const Pixels first = picture_at(160.0);
    const Pixels middle = picture_at(180.0);
    const Pixels last = picture_at(200.0);
    std::size_t turning = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const auto [dark, bright] = std::minmax({first.values()[i][0], last.values()[i][0]});
        ASSERT_GE(middle.values()[i][0] + 1, dark);
        ASSERT_LE(middle.values()[i][0], bright + 1);
        turning +=
            bright > dark + 40 && middle.values()[i][0] > dark + 10 && middle.values()[i][0] < bright - 10;
    }
    EXPECT_GT(turning, 300U);
    // Cells answer as the map that is nearer.
    technique->cast({.azimuth = 172_deg, .altitude = 12_deg});
    EXPECT_TRUE(
        same_mask(scene.renderer.lit_mask(technique->shadow()), cast_by_exact(terrain, course.lights[0])));
    technique->cast({.azimuth = 188_deg, .altitude = 12_deg});
    EXPECT_TRUE(
        same_mask(scene.renderer.lit_mask(technique->shadow()), cast_by_exact(terrain, course.lights[1])));
}

TEST_F(Techniques, SoftExactIsTheVisibleFraction)
{
    Terrain terrain = mountains(100, 120);
    terrain.heights_m(40, 50) = kNaN;
    Scene scene(terrain);
    const DirectionalLight light = {.azimuth = 212_deg, .altitude = 12_deg, .angular_diameter = 2_deg};
    const auto technique = shadow_technique_named("exact").make(scene.sources, scene.textures, true);
    technique->cast(light);
    ASSERT_EQ(technique->shadow().lookup, ShadowLookup::fraction);
    const auto bytes = read_back<std::uint8_t>(*technique->shadow().texture);
    const VisibleFraction fraction = visible_fraction(terrain, light, caster_named("exact"));
    std::size_t half = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const float part = std::isnan(fraction.values()[i]) ? 1.0f : fraction.values()[i];
        ASSERT_NEAR(static_cast<float>(bytes.values()[i]) / 255.0f, part, 0.0021f);
        half += part > 0.1f && part < 0.9f ? 1U : 0U;
    }
    EXPECT_GT(half, 200U);
}

TEST_F(Techniques, SoftEdgesAreSeenAsSoftAsTheyAre)
{
    // A wall across the light; half-shadow behind it, wider the farther away (ShadowFactor.OfAWall...).
    const Terrain wall =
        make_wall({.grid = {.rows = 33, .columns = 301}, .height_m = 20.0, .offset_m = -100.0});
    Scene scene(wall);
    scene.light.light = {.azimuth = 270_deg, .altitude = 10_deg, .angular_diameter = 2_deg};
    const TerrainView view = {
        .camera = {{50.0 + 113.0, -16.0, 60.0}, 0_deg, Angle::from_degrees(-89.9), 40_deg},
        .width = 128,
        .height = 64};
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        if (!kind.has_soft_edges)
            continue;
        const auto technique = kind.make(scene.sources, scene.textures, true);
        technique->cast(scene.light.light);
        const Pixels picture = scene.picture(view, technique->shadow());
        const auto lit = [&](std::size_t column) { return brightness(picture, 32, column); };
        EXPECT_GT(lit(127), lit(0) + 60) << kind.name;
        std::size_t between = 0;
        for (std::size_t column = 0; column < 128; ++column) {
            if (column > 0) {
                EXPECT_GE(lit(column) + 1, lit(column - 1)) << kind.name << ", " << column;
            }
            between += lit(column) > lit(0) + 5 && lit(column) < lit(127) - 5 ? 1U : 0U;
        }
        // 20 m cot(9 deg) - 20 m cot(11 deg) are 23 m; 43.7 m high, so 87 m wide, is the picture.
        EXPECT_NEAR(static_cast<double>(between), 23.0 * 128.0 / 87.0, 10.0) << kind.name;
    }
}

TEST_F(Techniques, CountTheBlackTexelsOfTheProcessorsMap)
{
    const Terrain terrain = mountains(100, 120);
    const DirectionalLight light = {.azimuth = 33_deg, .altitude = 12_deg};
    const SilhouetteStatistics statistics = SilhouetteMap(terrain, light).statistics();
    Scene scene(terrain);
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        const auto technique = kind.make(scene.sources, scene.textures, false);
        technique->cast(light);
        const bool has_map = kind.name.starts_with("smap");
        ASSERT_EQ(technique->black_share().has_value(), has_map) << kind.name;
        if (has_map) {
            EXPECT_EQ(*technique->black_share(),
                      static_cast<double>(statistics.black) / static_cast<double>(statistics.texels))
                << kind.name;
        }
    }
}

TEST_F(Techniques, LeaveGroundInFullLightAsItIsWithoutShadows)
{
    const Terrain hill =
        make_gaussian_hill({.grid = {.rows = 129, .columns = 129, .cell_size_m = {20.0, 20.0}},
                            .height_m = 300.0,
                            .sigma_m = 350.0});
    Scene scene(hill);
    scene.light.light = {.azimuth = 212_deg, .altitude = 60_deg};
    const TerrainView view =
        from_above(129, 1000.0); // from farther edges are wider than the light's clearance
    const Pixels expected = scene.picture(view);
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        const auto technique = kind.make(scene.sources, scene.textures, false);
        technique->cast(scene.light.light);
        EXPECT_TRUE(std::ranges::equal(scene.picture(view, technique->shadow()).values(), expected.values()))
            << kind.name;
    }
}

// Pixels that ask for themselves and pixels between cells that answered: edges of shadows differ, nothing else.
TEST_F(Techniques, ShowTheSamePictureButForEdges)
{
    const Terrain terrain = mountains(150, 150);
    Scene scene(terrain);
    scene.light.light.altitude = 12_deg;
    const TerrainView view = view_from({1500.0, -3300.0, 1900.0}, 10_deg, -35.0);
    const auto exact = shadow_technique_named("exact").make(scene.sources, scene.textures, false);
    exact->cast(scene.light.light);
    const Pixels expected = scene.picture(view, exact->shadow());
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        const auto technique = kind.make(scene.sources, scene.textures, false);
        technique->cast(scene.light.light);
        const Pixels picture = scene.picture(view, technique->shadow());
        std::size_t differing = 0;
        for (std::size_t i = 0; i < picture.size(); ++i)
            differing += std::abs(picture.values()[i][0] - expected.values()[i][0]) > 30 ? 1U : 0U;
        if (kind.name == "none")
            EXPECT_GT(differing, picture.size() / 5);
        else
            EXPECT_LT(differing, picture.size() / 25) << kind.name;
    }
}

TEST_F(Techniques, SaySameFromEveryCamera)
{
    const Terrain terrain = mountains(150, 150);
    Scene scene(terrain);
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        const auto technique = kind.make(scene.sources, scene.textures, false);
        technique->cast(scene.light.light);
        const ShadowMask before = scene.renderer.lit_mask(technique->shadow());
        scene.picture(view_from({100.0, -2000.0, 1500.0}, 80_deg, -10.0), technique->shadow());
        EXPECT_TRUE(same_mask(before, scene.renderer.lit_mask(technique->shadow()))) << kind.name;
    }
}

TEST_F(Techniques, SoftEdgesHaveTheirMiddleWhereHardOnesAre)
{
    const Terrain terrain = mountains(150, 150);
    Scene scene(terrain);
    for (const ShadowTechniqueKind& kind : shadow_techniques()) {
        if (!kind.has_soft_edges)
            continue;
        const auto soft = kind.make(scene.sources, scene.textures, true);
        soft->cast(scene.light.light);
        const ShadowMask truth = cast_by_exact(terrain, scene.light.light);
        const ShadowMask mask = scene.renderer.lit_mask(soft->shadow());
        std::size_t differing = 0;
        for (std::size_t i = 0; i < mask.size(); ++i)
            differing += mask.values()[i] != truth.values()[i] ? 1U : 0U;
        EXPECT_LT(differing, mask.size() / 200) << kind.name;
    }
}

TEST_F(Techniques, AreFoundByNameAndOthersListed)
{
    EXPECT_EQ(shadow_technique_named("sweep").name, "sweep");
    EXPECT_THROW(shadow_technique_named("swoop"), InvalidInput);
}

} // namespace
} // namespace duskline::gl
