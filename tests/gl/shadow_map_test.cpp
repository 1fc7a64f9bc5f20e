#include "gl/ask_shader.h"
#include "gl/gl_test.h"
#include "gl/triangle_casters.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_map.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace duskline::gl {
namespace {

using namespace angle_literals;

Vector3 towards(double azimuth_deg, double altitude_deg)
{
    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(altitude_deg));
    const auto [east, north] = sine_cosine(Angle::from_degrees(azimuth_deg));
    return {east * cosine, north * cosine, sine};
}

constexpr const char* kAsk = R"(#version 430 core
#include "shadow_map.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Places { vec4 places[]; }; // position, then normal and distance
layout(std430, binding = 5) writeonly buffer Answers { vec4 answers[]; };
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(answers.length()))
        return;
    vec4 place = places[2 * i];
    float lit = shadow_map_factor(place.xyz, places[2 * i + 1].xyz, place.w);
    vec4 overlay = shadow_map_overlay(place.xyz, place.w, lit);
    answers[i] = vec4(lit, overlay.a > 0.0 ? overlay.rgb : vec3(0.0));
}
)";

// A place on a surface, as seen from some distance.
struct Place {
    Vector3 position_m;
    Vector3 normal = {0.0, 0.0, 1.0};
    double eye_distance_m = 1.0;
};

using Answer = std::array<float, 4>; // lit, and the overlay's colour

// A rectangle, its front upwards.
std::vector<Triangle> plate(const Vector3& low, const Vector3& high)
{
    const Vector3 south_east = {high.x, low.y, low.z};
    const Vector3 north_west = {low.x, high.y, high.z};
    return {{low, south_east, high}, {low, high, north_west}};
}

// Things that cast shadows, and a map of them.
struct Scene {
    explicit Scene(const ShadowMapOptions& options) : map(sources, options)
    {
        ask_sources.add("ask.comp.glsl", kAsk);
        ask.emplace(ask_sources, ProgramDescription{{"ask.comp.glsl"}, map.defines()});
    }

    std::size_t update(const ShadowView& view)
    {
        eye_m = view.eye_m;
        return map.update(view, [&](const ShadowBox& box) {
            casters.draw(triangles, box_to_clip(box, box.centre_m), box.centre_m);
        });
    }

    std::vector<Answer> answers(const std::vector<Place>& places, const ShadowMapLook& look = {}) const
    {
        std::vector<std::array<float, 4>> asked;
        for (const Place& place : places) {
            const Vector3 p = place.position_m - eye_m;
            asked.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                             static_cast<float>(place.eye_distance_m)});
            asked.push_back({static_cast<float>(place.normal.x), static_cast<float>(place.normal.y),
                             static_cast<float>(place.normal.z), 0.0f});
        }
        Buffer block;
        map.bind(map.block(eye_m, look), block);
        return answers_of(*ask, asked, places.size());
    }

    std::vector<float> lit(const std::vector<Place>& places, const ShadowMapLook& look = {}) const
    {
        std::vector<float> all;
        for (const Answer& answer : answers(places, look))
            all.push_back(answer[0]);
        return all;
    }

    ShaderSources sources;
    ShaderSources ask_sources;
    ShadowMap map;
    TriangleCasters casters;
    std::optional<Program> ask;
    std::vector<Triangle> triangles;
    Vector3 eye_m;
};

// Distances that take each kernel, of 5 to 1 taps a side, at a clearance of 10 m (a radius of 120 m).
constexpr std::array<double, 5> kZones_m = {10.0, 20.0, 40.0, 80.0, 107.0};

// Light from straight above on level ground at 0, and a plate over all west of `edge_m`. The eye is in the middle.
struct HalfPlane {
    explicit HalfPlane(ShadowMapOptions options) : scene((options.size = 256, options))
    {
        scene.update(view);
        // Three tenths of a texel beyond a border between columns: what lies west of that border is covered.
        const ShadowBox& box = scene.map.box();
        const double from_west = std::floor(0.6 * 256.0);
        border_m = box.centre_m.x - 0.5 * box.side_m + from_west * box.texel_m;
        scene.triangles = plate({-1000.0, -1000.0, 5.0}, {border_m + 0.3 * box.texel_m, 1000.0, 5.0});
        for (const Triangle& triangle : plate({-1000.0, -1000.0, 0.0}, {1000.0, 1000.0, 0.0}))
            scene.triangles.push_back(triangle);
        scene.map.casters_changed();
        scene.update(view);
    }

    // Places across the edge, so many texels east of the border.
    std::vector<Place> places(double eye_distance_m) const
    {
        std::vector<Place> all;
        for (int i = -60; i <= 60; ++i)
            all.push_back({.position_m = {border_m + at(i) * scene.map.box().texel_m, 3.7 + 0.1 * i, 0.0},
                           .eye_distance_m = eye_distance_m});
        return all;
    }
    static double at(int i) { return 0.1 * i + 0.013; }

    ShadowView view = {.eye_m = {0.0, 0.0, 10.0}, .clearance_m = 10.0, .towards_light = {0.0, 0.0, 1.0}};
    Scene scene;
    double border_m = 0.0;
};

using ShadowMapTest = GlTest;

TEST_F(ShadowMapTest, KernelsOverAStraightEdgeAreRampsAsWideAsThey)
{
    const HalfPlane edge({});
    for (std::size_t zone = 0; zone < kZones_m.size(); ++zone) {
        const double taps = 5.0 - static_cast<double>(zone);
        const std::vector<float> lit = edge.scene.lit(edge.places(kZones_m.at(zone)));
        for (int i = -60; i <= 60; ++i) {
            const double expected = std::clamp(0.5 + HalfPlane::at(i) / taps, 0.0, 1.0);
            // Texture units weigh in 256 parts of a texel.
            EXPECT_NEAR(lit.at(static_cast<std::size_t>(i + 60)), expected, 0.008) << taps << " taps, " << i;
        }
    }
}

TEST_F(ShadowMapTest, KernelsOfSinglePointsAreStairsOfAsManySteps)
{
    const HalfPlane edge({.linear_compare = false});
    for (std::size_t zone = 0; zone < kZones_m.size(); ++zone) {
        const int taps = 5 - static_cast<int>(zone);
        const std::vector<float> lit = edge.scene.lit(edge.places(kZones_m.at(zone)));
        for (int i = -60; i <= 60; ++i) {
            int beyond = 0;
            for (int tap = 0; tap < taps; ++tap)
                beyond += HalfPlane::at(i) + tap - 0.5 * (taps - 1) >= 0.0 ? 1 : 0;
            EXPECT_NEAR(lit.at(static_cast<std::size_t>(i + 60)), static_cast<double>(beyond) / taps, 1e-5);
        }
    }
}

TEST_F(ShadowMapTest, WithoutFilterAPlaceIsLitOrNot)
{
    const HalfPlane edge({.filter = ShadowMapFilter::none, .linear_compare = false});
    const std::vector<float> lit = edge.scene.lit(edge.places(1.0));
    for (int i = -60; i <= 60; ++i)
        EXPECT_EQ(lit.at(static_cast<std::size_t>(i + 60)), HalfPlane::at(i) >= 0.0 ? 1.0f : 0.0f) << i;
}

TEST_F(ShadowMapTest, FilteredInRowsAndColumnsIsTheKernelOfFiveByFiveUnderAPlate)
{
    const HalfPlane kernels({});
    const HalfPlane moments({.filter = ShadowMapFilter::moments});
    const std::vector<float> expected = kernels.scene.lit(kernels.places(1.0));
    const std::vector<float> lit = moments.scene.lit(moments.places(1.0));
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(lit[i], expected[i], 0.02) << i;
}

TEST_F(ShadowMapTest, FourTapsFirstGiveTheSameAtAStraightEdge)
{
    const HalfPlane all({});
    const HalfPlane some({.penumbra_only = true});
    for (const double distance_m : kZones_m) {
        const std::vector<float> expected = all.scene.lit(all.places(distance_m));
        const std::vector<float> lit = some.scene.lit(some.places(distance_m));
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(lit[i], expected[i], 1e-6);
    }
}

TEST_F(ShadowMapTest, ADiscIsOnAverageAsWideAsItsKernel)
{
    for (const bool penumbra_only : {false, true}) {
        const HalfPlane edge(
            {.filter = ShadowMapFilter::disc, .penumbra_only = penumbra_only, .samples = 16});
        const double texel_m = edge.scene.map.box().texel_m;
        for (const double texels : {-4.0, -1.0, 0.0, 1.0, 4.0}) {
            std::vector<Place> places;
            for (int i = 0; i < 2000; ++i)
                places.push_back({.position_m = {edge.border_m + texels * texel_m, 0.011 * i, 0.0}});
            double sum = 0.0;
            for (const float lit : edge.scene.lit(places))
                sum += static_cast<double>(lit);
            EXPECT_NEAR(sum / 2000.0, std::clamp(0.5 + texels / 5.0, 0.0, 1.0), 0.06) << texels;
        }
    }
}

std::vector<Place> ground(double half_side_m, double height_m, const Vector3& normal = {0.0, 0.0, 1.0})
{
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<double>(random()) / 4294967295.0 * 2.0 - 1.0; };
    std::vector<Place> places;
    for (int i = 0; i < 3000; ++i) {
        const double x = half_side_m * number();
        const double y = half_side_m * number();
        const double z = height_m - (normal.x * x + normal.y * y) / normal.z;
        places.push_back({{x, y, z}, normal, std::hypot(x, y)});
    }
    return places;
}

TEST_F(ShadowMapTest, GroundDoesNotShadeItself)
{
    const std::vector<ShadowMapOptions> ways = {{.filter = ShadowMapFilter::none, .linear_compare = false},
                                                {.filter = ShadowMapFilter::none},
                                                {.linear_compare = false},
                                                {},
                                                {.penumbra_only = true},
                                                {.filter = ShadowMapFilter::disc},
                                                {.faces = CasterFaces::away_from_light}};
    for (ShadowMapOptions options : ways) {
        options.size = 256;
        Scene scene(options);
        for (const Vector3& slope : {Vector3{0.0, 0.0, 1.0}, Vector3{0.3, -0.1, 1.0}}) {
            const double tilt_m = 4000.0;
            scene.triangles = plate({-tilt_m, -tilt_m, 0.0}, {tilt_m, tilt_m, 0.0});
            for (Triangle& triangle : scene.triangles)
                for (Vector3& corner : triangle)
                    corner.z = -slope.x * corner.x - slope.y * corner.y;
            for (const double altitude_deg : {2.0, 5.0, 10.0, 30.0, 60.0, 80.0})
                for (const double azimuth_deg : {0.0, 33.0, 200.0}) {
                    const Vector3 light = towards(azimuth_deg, altitude_deg);
                    if (dot(light, slope) < 0.03)
                        continue; // from behind
                    scene.map.casters_changed();
                    scene.update({.eye_m = {0.0, 0.0, 15.0}, .clearance_m = 15.0, .towards_light = light});
                    for (const float lit : scene.lit(ground(150.0, 0.0, slope)))
                        ASSERT_EQ(lit, 1.0f) << altitude_deg << ", " << azimuth_deg;
                }
        }
    }
}

TEST_F(ShadowMapTest, NothingBeyondTheBoxIsDark)
{
    for (const auto filter :
         {ShadowMapFilter::none, ShadowMapFilter::kernels, ShadowMapFilter::disc, ShadowMapFilter::moments}) {
        Scene scene({.size = 256, .filter = filter});
        scene.triangles = plate({-1e5, -1e5, 20.0}, {1e5, 1e5, 20.0});
        scene.update({.eye_m = {0.0, 0.0, 10.0}, .clearance_m = 10.0, .towards_light = towards(120.0, 50.0)});
        const ShadowBox& box = scene.map.box();
        std::vector<Place> places = ground(2.0 * box.side_m, 0.0);
        for (Place& place : places)
            place.eye_distance_m = 1.0; // not to fade
        const std::vector<float> lit = scene.lit(places);
        int dark = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Vector3 from_centre_m = places[i].position_m - box.centre_m;
            const double out = std::max({std::abs(dot(from_centre_m, box.axes.right)),
                                         std::abs(dot(from_centre_m, box.axes.up)),
                                         std::abs(dot(from_centre_m, box.axes.towards_light))})
                               / (0.5 * box.side_m);
            if (out > 1.0) {
                EXPECT_EQ(lit[i], 1.0f) << out;
            } else if (out < 0.9) {
                EXPECT_LT(lit[i], 0.01f) << out;
            }
            dark += lit[i] < 0.5f ? 1 : 0;
        }
        EXPECT_GT(dark, 100);
    }
}

TEST_F(ShadowMapTest, CastersFarBeforeTheBoxCast)
{
    Scene scene({.size = 256});
    scene.triangles = plate({-200.0, -200.0, 9000.0}, {0.0, 200.0, 9000.0});
    scene.update({.eye_m = {0.0, 0.0, 10.0}, .clearance_m = 10.0, .highest_above_eye_m = 9000.0});
    const std::vector<float> lit = scene.lit({{{-20.0, 0.0, 0.0}}, {{20.0, 0.0, 0.0}}});
    EXPECT_EQ(lit[0], 0.0f);
    EXPECT_EQ(lit[1], 1.0f);
}

// Hills without a pattern.
std::vector<Triangle> hills()
{
    const auto height_m = [](int x, int y) {
        return 6.0 * std::sin(0.31 * x) * std::cos(0.43 * y) + 3.0 * std::sin(0.7 * x + 1.1 * y);
    };
    std::vector<Triangle> triangles;
    for (int x = -40; x < 40; ++x)
        for (int y = -40; y < 40; ++y) {
            const auto corner = [&](int i, int j) { return Vector3{7.0 * i, 7.0 * j, height_m(i, j)}; };
            triangles.push_back({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
            triangles.push_back({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
        }
    return triangles;
}

TEST_F(ShadowMapTest, DoesNotChangeWhileTheEyeMovesAFractionOfATexel)
{
    Scene scene({.size = 256});
    scene.triangles = hills();
    ShadowView view = {.eye_m = {1.3, -2.7, 20.0}, .clearance_m = 15.0, .towards_light = towards(75.0, 20.0)};
    scene.update(view);
    const Grid<float> before = read_back<float>(scene.map.depth());
    const ShadowBox box = scene.map.box();
    for (const double share : {0.1, 0.37, 0.9}) {
        view.eye_m.x = 1.3 + share * box.texel_m;
        scene.map.casters_changed();
        EXPECT_EQ(scene.update(view), 1U);
        EXPECT_TRUE(std::ranges::equal(read_back<float>(scene.map.depth()).values(), before.values()));
    }
}

TEST_F(ShadowMapTest, MovesByWholeTexelsAndKeepsWhatItHolds)
{
    Scene scene({.size = 256});
    scene.triangles = hills();
    ShadowView view = {.eye_m = {1.3, -2.7, 20.0}, .clearance_m = 15.0, .towards_light = towards(75.0, 20.0)};
    scene.update(view);
    const Grid<float> before = read_back<float>(scene.map.depth());
    const ShadowBox first = scene.map.box();
    view.eye_m =
        view.eye_m + first.axes.right * (3.0 * 8.0 * first.texel_m) + first.axes.up * (8.0 * first.texel_m);
    EXPECT_EQ(scene.update(view), 1U);
    const Grid<float> after = read_back<float>(scene.map.depth());
    std::size_t differing = 0;
    for (std::size_t row = 0; row < 248; ++row)
        for (std::size_t column = 0; column < 232; ++column)
            differing += std::abs(after(row, column) - before(row + 8, column + 24)) > 1e-5f ? 1U : 0U;
    EXPECT_LE(differing, 3U); // corners that lie on the middle of a texel, but for roundings
}

TEST_F(ShadowMapTest, IsDrawnAgainOnlyWhereItHasChanged)
{
    Scene scene({.size = 256, .wide_reach = 96.0});
    scene.triangles = hills();
    ShadowView view = {.eye_m = {0.0, 0.0, 20.0}, .clearance_m = 15.0, .towards_light = towards(75.0, 20.0)};
    EXPECT_EQ(scene.update(view), 2U);
    EXPECT_EQ(scene.update(view), 0U);
    view.eye_m.x += 12.0; // a step of the near map, far less than one of the wide
    EXPECT_EQ(scene.update(view), 1U);
    view.towards_light = towards(75.0, 20.1);
    EXPECT_EQ(scene.update(view), 2U);
    scene.map.casters_changed();
    EXPECT_EQ(scene.update(view), 2U);
}

TEST_F(ShadowMapTest, FadesOverTheLastTenthOfTheRadius)
{
    Scene scene({.size = 256});
    scene.triangles = plate({-1e4, -1e4, 5.0}, {1e4, 1e4, 5.0});
    scene.update({.eye_m = {0.0, 0.0, 10.0}, .forward = {1.0, 0.0, 0.0}, .clearance_m = 10.0});
    for (const auto& [distance_m, expected] :
         {std::pair{100.0, 0.0}, {107.9, 0.0}, {114.0, 0.5}, {119.9, 0.99}, {130.0, 1.0}})
        EXPECT_NEAR(scene.lit({{.position_m = {100.0, 0.0, 0.0}, .eye_distance_m = distance_m}})[0], expected,
                    0.01);
}

TEST_F(ShadowMapTest, TheWideMapGoesOnWhereTheNearOneFades)
{
    Scene scene({.size = 256, .wide_reach = 96.0});
    scene.triangles = plate({-1e5, -1e5, 5.0}, {1e5, 1e5, 5.0});
    scene.update({.eye_m = {0.0, 0.0, 10.0}, .forward = {1.0, 0.0, 0.0}, .clearance_m = 10.0});
    for (const double x : {20.0, 110.0, 115.0, 130.0, 300.0, 860.0}) {
        EXPECT_LT(scene.lit({{.position_m = {x, 0.0, 0.0}, .eye_distance_m = x}})[0], 1e-6f) << x;
        EXPECT_EQ(scene.lit({{.position_m = {x, 0.0, 6.0}, .eye_distance_m = x}})[0], 1.0f) << x;
    }
    EXPECT_NEAR(scene.lit({{.position_m = {912.0, 0.0, 0.0}, .eye_distance_m = 912.0}})[0], 0.5, 0.01);
    EXPECT_EQ(scene.lit({{.position_m = {970.0, 0.0, 0.0}, .eye_distance_m = 970.0}})[0], 1.0f);
}

TEST_F(ShadowMapTest, HighUpThereAreNoShadowsAndNothingIsDrawn)
{
    Scene scene({.size = 256, .fade_from_m = 1000.0, .fade_to_m = 2000.0});
    scene.triangles = plate({-1e5, -1e5, 500.0}, {1e5, 1e5, 500.0});
    const Place below = {.position_m = {0.0, 0.0, 0.0}};
    const auto from = [&](double height_m) {
        return scene.update(
            {.eye_m = {0.0, 0.0, height_m}, .forward = {0.0, 0.0, -1.0}, .clearance_m = height_m});
    };
    EXPECT_EQ(from(900.0), 1U);
    EXPECT_EQ(scene.lit({below})[0], 0.0f);
    from(1500.0);
    EXPECT_NEAR(scene.lit({below})[0], 0.5, 1e-5);
    EXPECT_EQ(from(2500.0), 0U);
    EXPECT_EQ(scene.lit({below})[0], 1.0f);
}

TEST_F(ShadowMapTest, AnOvercastSkyWidensEdgesAndLightensShadows)
{
    const HalfPlane edge({});
    const double texel_m = edge.scene.map.box().texel_m;
    const auto at = [&](double texels, double overcast) {
        return edge.scene.lit({{.position_m = {edge.border_m + texels * texel_m, 0.0, 0.0}}},
                              {.overcast = overcast})[0];
    };
    EXPECT_EQ(at(-3.0, 0.0), 0.0f);
    EXPECT_EQ(at(3.0, 0.0), 1.0f);
    EXPECT_NEAR(at(-20.0, 0.5), 0.45, 1e-5);
    EXPECT_NEAR(at(-20.0, 1.0), 0.9, 1e-5);
    EXPECT_GT(at(-3.0, 1.0), 0.901f);
    EXPECT_LT(at(3.0, 1.0), 0.999f);
    EXPECT_EQ(at(8.0, 1.0), 1.0f);
}

TEST_F(ShadowMapTest, OverlaysTellKernelsFadePenumbraAndBox)
{
    const HalfPlane edge({});
    const auto colour = [&](ShadowMapOverlay overlay, double texels, double distance_m) {
        const Place place = {.position_m = {edge.border_m + texels * edge.scene.map.box().texel_m, 0.0, 0.0},
                             .eye_distance_m = distance_m};
        const Answer answer = edge.scene.answers({place}, {.overlay = overlay})[0];
        return std::array<float, 3>{answer[1], answer[2], answer[3]};
    };
    using Rgb = std::array<float, 3>;
    const Rgb none = {0.0f, 0.0f, 0.0f};
    const Rgb red = {0.9f, 0.1f, 0.05f};
    const Rgb green = {0.1f, 0.7f, 0.15f};
    const Rgb yellow = {1.0f, 0.9f, 0.1f};
    const std::array<Rgb, 5> zones = {green, yellow, Rgb{1.0f, 0.5f, 0.0f}, red, Rgb{0.1f, 0.25f, 0.9f}};
    for (std::size_t i = 0; i < zones.size(); ++i)
        EXPECT_EQ(colour(ShadowMapOverlay::kernels, 0.0, kZones_m.at(i)), zones.at(i)) << i;
    EXPECT_EQ(colour(ShadowMapOverlay::fade, 0.0, 100.0), none);
    EXPECT_EQ(colour(ShadowMapOverlay::fade, 0.0, 110.0), red);
    EXPECT_EQ(colour(ShadowMapOverlay::penumbra, -20.0, 1.0), green);
    EXPECT_EQ(colour(ShadowMapOverlay::penumbra, 0.0, 1.0), red);
    EXPECT_EQ(colour(ShadowMapOverlay::penumbra, 20.0, 1.0), none);
    EXPECT_EQ(colour(ShadowMapOverlay::box, 0.0, 1.0), yellow);
    EXPECT_EQ(colour(ShadowMapOverlay::box, 1000.0, 1.0), none);
    EXPECT_EQ(colour(ShadowMapOverlay::none, 0.0, 1.0), none);
}

TEST_F(ShadowMapTest, ReversedWindingLeavesLitFacesOutAndStillCasts)
{
    // A block: only its underside and the sides away from the light are drawn.
    Scene scene({.size = 256, .slope_offset = 0.0, .faces = CasterFaces::away_from_light});
    scene.triangles = plate({-20.0, -20.0, 8.0}, {20.0, 20.0, 8.0});
    for (Triangle triangle : plate({-20.0, -20.0, 2.0}, {20.0, 20.0, 2.0}))
        scene.triangles.push_back({triangle[0], triangle[2], triangle[1]});
    scene.update({.eye_m = {0.0, 0.0, 10.0}, .clearance_m = 10.0, .towards_light = towards(90.0, 85.0)});
    EXPECT_EQ(scene.lit({{{0.0, 0.0, 0.0}}})[0], 0.0f);
    EXPECT_EQ(scene.lit({{{0.0, 0.0, 8.0}}})[0], 1.0f);
    EXPECT_EQ(scene.lit({{{60.0, 0.0, 0.0}}})[0], 1.0f);
}

TEST_F(ShadowMapTest, LeavesFramebufferProgramAndViewportAsTheyWere)
{
    Scene scene({.size = 256, .filter = ShadowMapFilter::moments});
    scene.triangles = hills();
    const Texture picture(TextureFormat::rgba8, 20, 10);
    const Framebuffer framebuffer({&picture});
    framebuffer.clear({1.0f, 0.0f, 0.0f, 1.0f});
    framebuffer.bind();
    scene.update({.clearance_m = 10.0, .towards_light = towards(75.0, 20.0)});
    EXPECT_EQ(read_back_picture(20, 10)(5, 5), (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
}

TEST_F(ShadowMapTest, RefusesOptionsOutOfRange)
{
    const ShaderSources sources;
    EXPECT_THROW(ShadowMap(sources, {.size = 32}), InvalidInput);
    EXPECT_THROW(ShadowMap(sources, {.size = 256, .samples = 3}), InvalidInput);
    EXPECT_THROW(ShadowMap(sources, {.size = 256, .spread = 0.0}), InvalidInput);
    EXPECT_THROW(ShadowMap(sources, {.size = 256, .slope_offset = -1.0}), InvalidInput);
    EXPECT_THROW(ShadowMap(sources, {.size = 256, .wide_reach = 6.0}), InvalidInput);
    EXPECT_THROW(ShadowMap(sources, {.size = 256, .fade_from_m = 10.0, .fade_to_m = 10.0}), InvalidInput);
}

TEST(PoissonDisc, KeepsItsPointsApartAndTheFirstFewTheMost)
{
    const auto points = poisson_disc(16);
    ASSERT_EQ(points.size(), 16U);
    float least_of_four = 2.0f;
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(std::hypot(points[i][0], points[i][1]), 1.0f);
        for (std::size_t j = 0; j < i; ++j) {
            const float apart = std::hypot(points[i][0] - points[j][0], points[i][1] - points[j][1]);
            EXPECT_GT(apart, 0.3f); // 16 random points: mostly below 0.1
            least_of_four = i < 4 ? std::min(least_of_four, apart) : least_of_four;
        }
    }
    EXPECT_GT(least_of_four, 0.8f);
    EXPECT_EQ(poisson_disc(16), points);
}

} // namespace
} // namespace duskline::gl
