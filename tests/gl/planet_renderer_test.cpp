#include "gl/gl_test.h"
#include "gl/made_planet.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/reversed_depth.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace duskline::gl {
namespace {

using namespace angle_literals;

using Pixel = std::array<std::uint8_t, 4>;
using Pixels = Grid<Pixel>;

constexpr Pixel kBackground = {255, 0, 255, 0};
constexpr double kRadius_m = 6371000.0;

// Mountains of several sizes, at most 2 `highest_m` apart, with no sea.
MadePlanet::Height mountains(double highest_m, double waves)
{
    return [=](const Vector3& d) {
        const double coarse =
            std::sin(waves * d.x + 1.0) * std::sin(waves * d.y) * std::sin(waves * d.z + 2.0);
        const double fine = std::sin(5.3 * waves * d.x) * std::sin(4.7 * waves * d.y + 0.5);
        return highest_m * (1.0 + 0.8 * coarse + 0.2 * fine);
    };
}

// A planet on the card.
struct Scene {
    explicit Scene(const Globe& globe, MadePlanet::Height height = {})
        : planet(globe, std::move(height)), renderer(sources, globe, planet.source())
    {}

    PlanetView view_from(const Vector3& eye_m, double heading_deg, double pitch_deg) const
    {
        return {.eye_m = eye_m,
                .axes = looking(planet.globe(), eye_m, heading_deg, pitch_deg),
                .vertical_view = 50_deg,
                .width = 200,
                .height = 150};
    }

    // The ground alone on the background's colour.
    Pixels picture(const PlanetView& view, const std::vector<PlanetPatch>& patches,
                   const PlanetShadow& shadow = {})
    {
        const Texture colour(TextureFormat::rgba8, view.width, view.height);
        const Texture depth(TextureFormat::depth32f, view.width, view.height);
        const Framebuffer framebuffer({&colour}, &depth);
        framebuffer.clear({1.0f, 0.0f, 1.0f, 0.0f});
        framebuffer.bind();
        if (with_sky)
            renderer.draw(view, light, patches, shadow);
        else
            renderer.draw_ground(view, light, patches, shadow);
        return read_back_picture(view.width, view.height);
    }

    ShaderSources sources;
    MadePlanet planet;
    PlanetRenderer renderer;
    PlanetLight light;
    bool with_sky = false;
};

int brightness(const Pixel& pixel)
{
    return pixel[0] + pixel[1] + pixel[2];
}

std::size_t count(const Pixels& picture, const Pixel& colour)
{
    return static_cast<std::size_t>(std::ranges::count(picture.values(), colour));
}

using PlanetPicture = GlTest;

TEST_F(PlanetPicture, ShowsAGlobeAsLargeAsItIs)
{
    Scene scene(sphere_of_radius(kRadius_m));
    PlanetView view = scene.view_from(Vector3{0.6, 0.8, 0.0} * (kRadius_m + 1e7), 0.0, -90.0);
    view.vertical_view = 60_deg;
    const Pixels picture = scene.picture(view, whole_level(1));
    const auto seen = static_cast<double>(picture.size() - count(picture, kBackground));
    const double limb = std::tan(std::asin(kRadius_m / (kRadius_m + 1e7)));
    const double radius_px = limb * 150.0 / 2.0 / std::tan(30.0 * 3.14159265 / 180.0);
    EXPECT_NEAR(seen, 3.14159265 * radius_px * radius_px, 0.005 * seen);
}

TEST_F(PlanetPicture, IsDarkAtNightAndBrightByDay)
{
    Scene scene(kWgs84, [](const Vector3&) { return 100.0; });
    const auto middle = [&](const Vector3& sun) {
        scene.light.to_sun = sun;
        const Vector3 eye_m = {1.2e7, 0.0, 0.0};
        PlanetView view = scene.view_from(eye_m, 0.0, -89.9);
        return brightness(scene.picture(view, whole_level(0))(75, 100));
    };
    const int noon = middle({1.0, 0.0, 0.0});
    const int evening = middle(normalized({0.1, 1.0, 0.0}));
    const int midnight = middle({-1.0, 0.0, 0.0});
    EXPECT_GT(noon, 250);
    EXPECT_LT(evening, noon - 60);
    EXPECT_LT(midnight, 75);
    EXPECT_GT(midnight, 0);
}

TEST_F(PlanetPicture, HasNoHoles)
{
    Scene scene(kWgs84, mountains(60000.0, 23.0));
    std::size_t seen = 0;
    for (const double height_m : {250000.0, 900000.0})
        for (const double heading_deg : {20.0, 200.0}) {
            const Vector3 eye_m = normalized({0.9, 0.35 + 1e-4 * heading_deg, 0.85}) * (kRadius_m + height_m);
            const auto patches = patches_around(scene.planet, eye_m, 1.3, 4);
            const Pixels picture = scene.picture(scene.view_from(eye_m, heading_deg, -25.0), patches);
            for (std::size_t column = 0; column < picture.columns(); ++column) {
                std::size_t row = 0;
                while (row < picture.rows() && picture(row, column) == kBackground)
                    ++row;
                // Under the skyline there is ground, all the way down.
                for (; row < picture.rows(); ++row, ++seen)
                    ASSERT_NE(picture(row, column), kBackground) << height_m << ": " << row << ", " << column;
            }
        }
    EXPECT_GT(seen, 60000U);
}

// From 1 m above the ground the far border of a tile 19 m across, as one that creeps sees it and as doubles have it.
TEST_F(PlanetPicture, StandsStillWhileTheEyeCreeps)
{
    Scene scene(kWgs84, [](const Vector3&) { return 4000.3; });
    const TilePlace place = place_in_tile(direction_at(kWgs84, {-155.47_deg, 19.82_deg}), 19);
    const Vector3 first_m = point_m(kWgs84, sample_direction(place.tile, 50.0, 64.0), 4001.3);
    const LocalFrame here = local_frame(kWgs84, normalized(first_m));
    // The border ahead is the tile's upper row; look across it.
    const Vector3 left_m = point_m(kWgs84, sample_direction(place.tile, 128.0, 0.0), 4000.3);
    const Vector3 right_m = point_m(kWgs84, sample_direction(place.tile, 128.0, 128.0), 4000.3);
    const Vector3 ahead = (left_m + right_m) * 0.5 - first_m;
    const double heading_deg =
        Angle::from_radians(std::atan2(dot(ahead, here.east), dot(ahead, here.north))).degrees();
    constexpr double never = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 6; ++step) {
        const Vector3 eye_m = first_m + here.east * (0.01 * step) + here.up * (0.003 * step);
        PlanetView view = scene.view_from(eye_m, heading_deg, -4.0);
        view.vertical_view = 20_deg;
        const Pixels picture = scene.picture(view, {{place.tile, {never, never}}});
        const double per_radian = 150.0 / 2.0 / std::tan(10.0 * 3.14159265 / 180.0);
        const auto row_of = [&](const Vector3& point_m) {
            const Vector3 away = point_m - eye_m;
            return 75.0 - per_radian * dot(away, view.axes.up) / dot(away, view.axes.forward);
        };
        const auto column_of = [&](const Vector3& point_m) {
            const Vector3 away = point_m - eye_m;
            return 100.0 + per_radian * dot(away, view.axes.right) / dot(away, view.axes.forward);
        };
        double background = 0.0;
        double expected = 0.0;
        for (std::size_t column = 0; column < 200; ++column) {
            for (std::size_t row = 0; row < 150 && picture(row, column) == kBackground; ++row)
                background += 1.0;
            const double t = (static_cast<double>(column) + 0.5 - column_of(left_m))
                             / (column_of(right_m) - column_of(left_m));
            expected += row_of(left_m) + t * (row_of(right_m) - row_of(left_m));
        }
        ASSERT_GT(background, 200.0);
        EXPECT_NEAR(background / 200.0, expected / 200.0, 0.1) << step;
    }
}

TEST_F(PlanetPicture, FadesWithDistance)
{
    Scene scene(kWgs84, [](const Vector3&) { return 10.0; });
    scene.light.to_sun = normalized({1.0, 0.3, 0.2});
    const Vector3 eye_m = {6378137.0 + 1500.0, 0.0, 0.0};
    const Pixels picture =
        scene.picture(scene.view_from(eye_m, 40.0, -12.0), patches_around(scene.planet, eye_m, 1.2, 5));
    int before = 255;
    for (std::size_t row = 0; row < 150; ++row) {
        if (picture(row, 100) == kBackground)
            continue;
        const int blue = picture(row, 100)[2];
        EXPECT_LE(blue, before + 1) << row;
        before = std::min(before, blue);
    }
    EXPECT_LT(before, 150);
}

TEST_F(PlanetPicture, HasALimbThatGlows)
{
    Scene scene(kWgs84);
    scene.with_sky = true;
    scene.light.to_sun = {1.0, 0.0, 0.0};
    const Pixels picture =
        scene.picture(scene.view_from({6378137.0 + 4e5, 0.0, 0.0}, 0.0, -15.0), whole_level(2));
    // From the top: black space, then more and more air.
    EXPECT_LT(brightness(picture(2, 100)), 20);
    int brightest = 0;
    for (std::size_t row = 0; row < 150; ++row)
        brightest = std::max(brightest, brightness(picture(row, 100)));
    EXPECT_GT(brightest, 450);
}

using Shadow = std::shared_ptr<const TileShadow>;

// The same shadow height everywhere; of a disc the lower one, too.
Shadow shadow_at(float height_m, std::optional<float> dark_m = {})
{
    auto shadow = std::make_shared<TileShadow>();
    std::ranges::fill(shadow->heights_m.values(), height_m);
    if (dark_m)
        shadow->dark_m = Grid<float>(kTileSquares + 1, kTileSquares + 1, *dark_m);
    return shadow;
}

TEST_F(PlanetPicture, IsDarkUnderShadowHeights)
{
    Scene scene(kWgs84, [](const Vector3&) { return 500.0; });
    const Shadow below = shadow_at(400.0f);
    const Shadow above = shadow_at(600.0f);
    const Vector3 eye_m = {8e6, 0.0, 0.0};
    const PlanetView view = scene.view_from(eye_m, 0.0, -90.0);
    const auto patches = patches_around(scene.planet, eye_m, 1.5, 2);
    const auto middle = [&](const TileShadowsOf& shadows_of) {
        return scene.picture(view, patches, {shadows_of})(75, 100);
    };
    const Pixel lit = middle({});
    EXPECT_EQ(middle([&](const PlanetTile&) { return ShownShadow{below}; }), lit);
    const Pixel dark = middle([&](const PlanetTile&) { return ShownShadow{above}; });
    EXPECT_LT(brightness(dark), brightness(lit) - 100);
    EXPECT_EQ(middle([](const PlanetTile&) { return ShownShadow(); }), lit);
    // Where the finest are missing their parents' do.
    EXPECT_EQ(
        middle([&](const PlanetTile& tile) { return tile.level == 2 ? ShownShadow() : ShownShadow{above}; }),
        dark);
}

// The ground at 500 m; what the renderer says of the light in the middle of the picture.
class ProbedPlanet {
public:
    float light(const PlanetShadow& shadow)
    {
        const Framebuffer framebuffer({&places_}, &depth_);
        framebuffer.clear({0.0f, 0.0f, 0.0f, -2.0f});
        framebuffer.bind();
        scene_.light.to_sun = {1.0, 0.0, 0.0};
        scene_.renderer.probe_ground(view_, scene_.light, patches_, shadow);
        return read_back<std::array<float, 4>>(places_)(75, 100)[3];
    }

private:
    Scene scene_{kWgs84, [](const Vector3&) { return 500.0; }};
    PlanetView view_ = scene_.view_from({8e6, 0.0, 0.0}, 0.0, -90.0);
    std::vector<PlanetPatch> patches_ = patches_around(scene_.planet, {8e6, 0.0, 0.0}, 1.5, 2);
    Texture places_{TextureFormat::rgba32f, 200, 150};
    Texture depth_{TextureFormat::depth32f, 200, 150};
};

TEST_F(PlanetPicture, SeesAPartOfTheDiscBetweenItsTwoHeights)
{
    ProbedPlanet planet;
    const auto light = [&](float dark_m, float lit_m) {
        const Shadow shadow = shadow_at(lit_m, dark_m);
        return planet.light(
            {.shadows_of = [=](const PlanetTile&) { return ShownShadow{shadow}; }, .of_disc = true});
    };
    EXPECT_EQ(light(300.0f, 400.0f), 1.0f);
    EXPECT_EQ(light(600.0f, 900.0f), 0.0f);
    EXPECT_NEAR(light(400.0f, 600.0f), 0.5f, 1e-3f);
    // A quarter of the diameter: the segment of a circle, not a quarter of its area.
    EXPECT_NEAR(light(400.0f, 800.0f), 0.1955f, 1e-3f);
    EXPECT_NEAR(light(200.0f, 600.0f), 0.8045f, 1e-3f);
}

TEST_F(PlanetPicture, InterpolatesShadowHeightsBetweenTwoSunsAndKeepsThemWhenTheSecondBecomesTheFirst)
{
    ProbedPlanet planet;
    const auto light = [&](const Shadow& first, const Shadow& second, double share) {
        return planet.light({.shadows_of = [=](const PlanetTile&) {
            return ShownShadow{first, second, share};
        }});
    };
    const Shadow low = shadow_at(400.0f);
    const Shadow high = shadow_at(700.0f);
    const Shadow higher = shadow_at(800.0f);
    EXPECT_EQ(light(low, high, 0.0), 1.0f);
    EXPECT_EQ(light(low, high, 0.3), 1.0f);
    EXPECT_EQ(light(low, high, 0.4), 0.0f);
    EXPECT_EQ(light(low, nullptr, 0.0), 1.0f);
    // The edge is where the height is 500 m: half way from 700 m to 300 m, a quarter from 400 m to 800 m.
    const Shadow lower = shadow_at(300.0f);
    EXPECT_EQ(light(high, lower, 0.45), 0.0f);
    EXPECT_EQ(light(high, lower, 0.55), 1.0f);
    EXPECT_EQ(light(lower, higher, 0.35), 1.0f);
    EXPECT_EQ(light(lower, higher, 0.45), 0.0f);
    EXPECT_EQ(light(higher, nullptr, 0.0), 0.0f);
}

TEST_F(PlanetPicture, MarksWhatIsMadeUp)
{
    const auto middle = [](bool measured, bool marked) {
        Scene scene(kWgs84, [](const Vector3&) { return 500.0; });
        scene.planet.set_measured(measured);
        PlanetView view = scene.view_from({8e6, 0.0, 0.0}, 0.0, -90.0);
        view.show_made = marked;
        return scene.picture(view, whole_level(0))(75, 100);
    };
    EXPECT_EQ(middle(true, true), middle(true, false));
    EXPECT_EQ(middle(false, false), middle(true, false));
    EXPECT_GT(middle(false, true)[0], middle(false, false)[0] + 20);
}

// Tiles of all steps side by side, and squares of less than a pixel.
TEST_F(PlanetPicture, LooksTheSameAndHasNoHolesWithFewerCorners)
{
    Scene scene(kWgs84, mountains(20000.0, 23.0));
    const Vector3 eye_m = normalized({0.9, 0.35, 0.85}) * (kRadius_m + 3e6);
    const PlanetView view = scene.view_from(eye_m, 20.0, -90.0);
    const auto all = whole_level(3);
    auto fewer = all;
    for (std::size_t i = 0; i < fewer.size(); ++i)
        fewer[i].step = 1U << (i % 4);
    const Pixels with_all = scene.picture(view, all);
    const Pixels with_fewer = scene.picture(view, fewer);
    EXPECT_EQ(count(with_fewer, kBackground), 0U);
    double apart = 0.0;
    for (std::size_t i = 0; i < with_all.size(); ++i)
        apart += std::abs(brightness(with_all.values()[i]) - brightness(with_fewer.values()[i]));
    EXPECT_LT(apart / static_cast<double>(3 * with_all.size()), 3.0); // of 255
    EXPECT_FALSE(std::ranges::equal(with_all.values(), with_fewer.values()));
}

// What a light sees, from where the eye sees too: the same depth to a few units in the last place.
TEST_F(PlanetPicture, HasOneMeshForEyesAndLights)
{
    Scene scene(kWgs84, mountains(60000.0, 23.0));
    const Vector3 eye_m = normalized({0.9, 0.35, 0.85}) * (kRadius_m + 4e5);
    const PlanetView view = scene.view_from(eye_m, 20.0, -40.0);
    const auto patches = patches_around(scene.planet, eye_m, 1.5, 3);
    const Texture colour(TextureFormat::rgba8, view.width, view.height);
    const Texture seen(TextureFormat::depth32f, view.width, view.height);
    const Texture cast(TextureFormat::depth32f, view.width, view.height);
    const Framebuffer first({&colour}, &seen);
    first.bind();
    scene.renderer.draw_ground(view, scene.light, patches);
    const Framebuffer second({&colour}, &cast);
    second.bind();
    {
        const ReversedDepth depth;
        scene.renderer.draw_depth(
            eye_m, eye_to_reversed_clip(view.axes, view.vertical_view, 200.0 / 150.0, 0.1), patches);
    }
    const Grid<float> a = read_back<float>(seen);
    const Grid<float> b = read_back<float>(cast);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a.values()[i] == 0.0f || b.values()[i] == 0.0f)
            continue;
        ++compared;
        ASSERT_NEAR(a.values()[i] / b.values()[i], 1.0f, 1e-5f) << i;
    }
    EXPECT_GT(compared, a.size() / 2);
}

} // namespace
} // namespace duskline::gl
