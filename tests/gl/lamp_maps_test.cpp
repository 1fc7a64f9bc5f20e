#include "gl/ask_shader.h"
#include "gl/gl_test.h"
#include "gl/triangle_casters.h"
#include "random_vectors.h"

#include <duskline/casting/exact.h>
#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/lamp_maps.h>
#include <duskline/gl/program.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace duskline::gl {
namespace {

using namespace angle_literals;

constexpr const char* kAsk = R"(#version 430 core
#include "lamp_maps.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Places { vec4 places[]; }; // position, normal
layout(std430, binding = 5) writeonly buffer Answers { vec4 answers[]; };
uniform int lamp;
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(answers.length()))
        return;
    vec3 place = places[2 * i].xyz;
    vec3 normal = places[2 * i + 1].xyz;
    answers[i] = vec4(lamp_light(place, normal), lamp_visible(lamp, place, normal));
}
)";

using Answer = std::array<float, 4>; // light, and how much of a lamp is visible

struct Place {
    Vector3 position_m;
    Vector3 normal = {0.0, 0.0, 1.0};
};

// Three axes at right angles.
struct Turn {
    std::array<Vector3, 3> axes = {Vector3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    Vector3 operator()(const Vector3& v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
};

Turn any_turn(RandomVectors& random)
{
    const Vector3 x = normalized(random.vector());
    const Vector3 y = normalized(cross(x, random.vector()));
    return {{x, y, cross(x, y)}};
}

// A parallelogram from a corner along two sides, in so many pieces a side.
std::vector<Triangle> plate(const Vector3& corner, const Vector3& a, const Vector3& b, int pieces = 1)
{
    std::vector<Triangle> triangles;
    const auto at = [&](int i, int j) { return corner + a * (1.0 * i / pieces) + b * (1.0 * j / pieces); };
    for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return triangles;
}

// Things that cast shadows, and maps of them.
struct Scene {
    explicit Scene(const LampMapOptions& options = {.size = 256})
        : maps(options), ask(program("ask.comp.glsl", kAsk))
    {}

    static Program program(const char* name, const char* text)
    {
        ShaderSources own;
        own.add(name, text);
        return {own, {{name}}};
    }

    void add(const std::vector<Triangle>& more)
    {
        triangles.insert(triangles.end(), more.begin(), more.end());
    }

    std::size_t update(const std::vector<SceneLamp>& lamps)
    {
        return maps.update(
            lamps, [&](const LampFace& face) { casters.draw(triangles, face_to_clip(face, eye_m), eye_m); });
    }

    std::vector<Answer> answers(const std::vector<Place>& places, int lamp = 0) const
    {
        std::vector<std::array<float, 4>> asked;
        for (const Place& place : places)
            for (const Vector3& v : {place.position_m - eye_m, normalized(place.normal)})
                asked.push_back(
                    {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f});
        Buffer block;
        maps.bind(maps.block(eye_m), block);
        ask.set("lamp", lamp);
        return answers_of(ask, asked, places.size());
    }

    std::vector<float> visible(const std::vector<Place>& places, int lamp = 0) const
    {
        std::vector<float> all;
        for (const Answer& answer : answers(places, lamp))
            all.push_back(answer[3]);
        return all;
    }

    LampMaps maps;
    TriangleCasters casters;
    Program ask;
    std::vector<Triangle> triangles;
    Vector3 eye_m = {};
};

// Of the middle of a face, as an angle; towards its corners texels are smaller.
double texel(const LampMaps& maps)
{
    return 2.0 / static_cast<double>(maps.options().size - 2 * kLampBorder);
}

using LampMapsTest = GlTest;

// Lamp at 10 over a floor at 0; between them at 5 a plate west of x = 1.
TEST_F(LampMapsTest, AShadowEndsWhereGeometrySays)
{
    RandomVectors random(1);
    for (int round = 0; round < 12; ++round) {
        const Turn turn = any_turn(random);
        Scene scene;
        for (const Triangle& t : plate({-30.0, -30.0, 5.0}, {31.0, 0.0, 0.0}, {0.0, 60.0, 0.0}))
            scene.triangles.push_back({turn(t[0]), turn(t[1]), turn(t[2])});
        for (const Triangle& t : plate({-60.0, -60.0, 0.0}, {120.0, 0.0, 0.0}, {0.0, 120.0, 0.0}))
            scene.triangles.push_back({turn(t[0]), turn(t[1]), turn(t[2])});
        const SceneLamp lamp = {.position_m = turn({0.0, 0.0, 10.0})};
        const SceneLamp beam = {
            .position_m = turn({0.0, 0.0, 10.0}), .direction = turn({0.3, 0.1, -1.0}), .half_angle = 45_deg};
        for (const SceneLamp& each : {lamp, beam}) {
            scene.maps.casters_changed();
            scene.update({each});
            std::vector<Place> places;
            std::vector<double> off; // east of the shadow's end, texels
            for (int i = -200; i <= 200; ++i) {
                const Vector3 place = {2.0 + 0.01 * i, 3.1 * random.number(), 0.0};
                const double distance = length(place - Vector3{0.0, 0.0, 10.0});
                places.push_back({turn(place), turn({0.0, 0.0, 1.0})});
                off.push_back(0.01 * i * 10.0 / (distance * distance) / texel(scene.maps));
            }
            const std::vector<float> lit = scene.visible(places);
            for (std::size_t i = 0; i < lit.size(); ++i) {
                if (std::abs(off[i]) > 3.0) {
                    EXPECT_EQ(lit[i], off[i] > 0.0 ? 1.0f : 0.0f) << round << ": " << off[i];
                } else if (std::abs(off[i]) > 2.0) {
                    EXPECT_NEAR(lit[i], off[i] > 0.0 ? 1.0 : 0.0, 0.5) << round << ": " << off[i];
                }
            }
        }
    }
}

TEST_F(LampMapsTest, AWallIsLitOnTheSideOfTheLampAndDarkensWhatLiesBehind)
{
    Scene scene;
    scene.add(plate({5.0, -3.0, 0.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 2.0}));
    scene.add(plate({-50.0, -50.0, 0.0}, {100.0, 0.0, 0.0}, {0.0, 100.0, 0.0}));
    scene.update({{.position_m = {0.0, 0.0, 4.0}}});
    const std::vector<Answer> answers = scene.answers({{{5.0, 0.5, 1.0}, {-1.0, 0.0, 0.0}},
                                                       {{5.0, 0.5, 1.0}, {1.0, 0.0, 0.0}},
                                                       {{4.0, 0.0, 0.0}},
                                                       {{7.0, 0.0, 0.0}},
                                                       {{9.5, 0.0, 0.0}},
                                                       {{10.5, 0.0, 0.0}},
                                                       {{7.0, 5.0, 0.0}}});
    EXPECT_GT(answers[0][0], 0.0f);
    EXPECT_EQ(answers[0][3], 1.0f);
    EXPECT_EQ(answers[1][0], 0.0f);
    EXPECT_EQ(answers[2][3], 1.0f);
    EXPECT_EQ(answers[3][3], 0.0f);
    EXPECT_EQ(answers[4][3], 0.0f); // the shadow is 5 m long
    EXPECT_EQ(answers[5][3], 1.0f);
    EXPECT_EQ(answers[6][3], 1.0f); // beside it
}

TEST_F(LampMapsTest, ALampLightsByTheFormulaAndNothingBeyondItsRange)
{
    RandomVectors random(2);
    Scene scene({.size = 64});
    const SceneLamp lamp = {
        .position_m = {1.0, 2.0, 3.0}, .colour = {1.0f, 0.5f, 0.25f}, .bright_m = 20.0, .range_m = 150.0};
    scene.update({lamp});
    std::vector<Place> places;
    for (int i = 0; i < 1000; ++i)
        places.push_back({lamp.position_m + random.vector() * 140.0, random.vector()});
    const std::vector<Answer> answers = scene.answers(places);
    int beyond = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vector3 to_lamp = lamp.position_m - places[i].position_m;
        const double distance_m = length(to_lamp);
        const double cosine = dot(normalized(places[i].normal), to_lamp) / distance_m;
        const double expected = light_at(lamp, distance_m) * std::max(0.0, cosine);
        for (std::size_t part = 0; part < 3; ++part)
            EXPECT_NEAR(answers[i].at(part), static_cast<double>(lamp.colour.at(part)) * expected,
                        1e-5 * (1.0 + expected));
        if (distance_m >= 150.0) {
            ++beyond;
            EXPECT_EQ(answers[i][0], 0.0f);
        }
    }
    EXPECT_GT(beyond, 100);
}

TEST_F(LampMapsTest, ASearchlightShinesInItsConeAndItsBorderIsAsSoftAsItSays)
{
    RandomVectors random(3);
    for (const double half_deg : {0.5, 10.0, 60.0, 110.0}) {
        Scene scene({.size = 64});
        const SceneLamp lamp = {.position_m = {1.0, 2.0, 3.0},
                                .direction = random.vector(),
                                .half_angle = Angle::from_degrees(half_deg),
                                .soft_edge = 0.25};
        scene.update({lamp});
        const Vector3 axis = normalized(lamp.direction);
        const Vector3 beside = normalized(cross(axis, random.vector()));
        std::vector<Place> places;
        for (int i = 0; i <= 600; ++i) {
            const auto [sine, cosine] = sine_cosine(Angle::from_degrees(half_deg * i / 400.0));
            const Vector3 direction = axis * cosine + beside * sine;
            places.push_back({lamp.position_m + direction * 50.0, direction * -1.0});
        }
        const std::vector<Answer> answers = scene.answers(places);
        const double full = light_at(lamp, 50.0);
        for (std::size_t i = 0; i <= 600; ++i) {
            if (i < 299) {
                EXPECT_NEAR(answers[i][0], full, 0.01 * full) << half_deg << ": " << i;
            } else if (i > 401) {
                EXPECT_LT(answers[i][0], 1e-3 * full) << half_deg << ": " << i;
            } else {
                EXPECT_LE(answers[i + 1][0], answers[i][0] + 0.01 * full) << half_deg << ": " << i;
            }
        }
        EXPECT_GT(answers[330][0], 0.3 * full);
        EXPECT_LT(answers[370][0], 0.7 * full);
    }
}

TEST_F(LampMapsTest, LightsOfLampsAddUp)
{
    RandomVectors random(4);
    Scene scene;
    for (int i = 0; i < 30; ++i)
        scene.add(plate(random.vector() * 20.0, random.vector() * 5.0, random.vector() * 5.0));
    std::vector<SceneLamp> lamps;
    for (int i = 0; i < 5; ++i)
        lamps.push_back({.position_m = random.vector() * 25.0,
                         .direction = random.vector(),
                         .half_angle = Angle::from_degrees(i % 2 == 0 ? 180.0 : 50.0),
                         .colour = {1.0f, 0.1f * static_cast<float>(i), 0.3f},
                         .bright_m = 15.0});
    std::vector<Place> places;
    for (int i = 0; i < 3000; ++i)
        places.push_back({random.vector() * 30.0, random.vector()});
    std::vector<std::array<double, 3>> sums(places.size());
    for (const SceneLamp& lamp : lamps) {
        scene.update({lamp});
        const std::vector<Answer> answers = scene.answers(places);
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t part = 0; part < 3; ++part)
                sums[i].at(part) += static_cast<double>(answers[i].at(part));
    }
    scene.update(lamps);
    const std::vector<Answer> answers = scene.answers(places);
    int lit = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t part = 0; part < 3; ++part) {
            EXPECT_NEAR(answers[i].at(part), sums[i].at(part), 1e-6 * (1.0 + sums[i].at(part)));
            lit += sums[i].at(part) > 0.0 ? 1 : 0;
        }
    EXPECT_GT(lit, 3000);
}

TEST_F(LampMapsTest, APlainDoesNotShadeItselfHoweverLowTheLampStands)
{
    RandomVectors random(5);
    for (const std::size_t taps : {1U, 3U, 5U})
        for (const double height_m : {0.5, 2.0, 30.0}) {
            const Turn turn = any_turn(random);
            Scene scene({.size = 256, .taps = taps});
            for (const int pieces : {1, 50}) {
                scene.triangles.clear();
                for (const Triangle& t :
                     plate({-3000.0, -3000.0, -height_m}, {6000.0, 0.0, 0.0}, {0.0, 6000.0, 0.0}, pieces))
                    scene.triangles.push_back({turn(t[0]), turn(t[1]), turn(t[2])});
                scene.maps.casters_changed();
                scene.update({{}});
                std::vector<Place> places;
                for (int i = 0; i < 4000; ++i) {
                    const double far_m = 0.01 * std::exp(12.0 * std::abs(random.number()));
                    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(180.0 * random.number()));
                    if (far_m < 2900.0)
                        places.push_back(
                            {turn({far_m * sine, far_m * cosine, -height_m}), turn({0.0, 0.0, 1.0})});
                }
                const std::vector<float> lit = scene.visible(places);
                for (std::size_t i = 0; i < places.size(); ++i)
                    ASSERT_EQ(lit[i], 1.0f) << taps << " taps, " << pieces << " pieces, " << height_m
                                            << " m high, " << length(places[i].position_m) << " m away";
            }
        }
}

// Whether a straight line from a to b meets a triangle.
bool meets(const Vector3& a, const Vector3& b, const Triangle& triangle)
{
    const Vector3 along = b - a;
    const Vector3 first = triangle[1] - triangle[0];
    const Vector3 second = triangle[2] - triangle[0];
    const Vector3 p = cross(along, second);
    const double determinant = dot(first, p);
    const Vector3 from = a - triangle[0];
    const double u = dot(from, p) / determinant;
    const Vector3 q = cross(from, first);
    const double v = dot(along, q) / determinant;
    const double t = dot(second, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-9 && t < 1.0 - 1e-9;
}

bool is_lit(const std::vector<Triangle>& triangles, const Vector3& lamp_m, const Vector3& place_m)
{
    return std::ranges::none_of(triangles, [&](const Triangle& t) { return meets(lamp_m, place_m, t); });
}

// Whether truth is the same at all places up to so many texels aside, across the light, as at a place itself.
bool is_far_from_edges(const std::vector<Triangle>& triangles, const Vector3& place_m, double apart)
{
    const bool lit = is_lit(triangles, {}, place_m);
    const Vector3 right = normalized(cross(place_m, {0.3, 0.5, 0.8})) * (apart * length(place_m));
    const Vector3 up = cross(normalized(place_m), right);
    for (const double share : {0.25, 0.5, 0.75, 1.0})
        for (int i = 0; i < 16; ++i) {
            const auto [sine, cosine] = sine_cosine(Angle::from_degrees(22.5 * i));
            if (is_lit(triangles, {}, place_m + (right * sine + up * cosine) * share) != lit)
                return false;
        }
    return true;
}

// Plates all round a lamp in a ball; places along the twelve seams of the six faces, and anywhere.
TEST_F(LampMapsTest, SeamsOfFacesAreNotToBeSeen)
{
    RandomVectors random(6);
    Scene scene({.size = 128});
    for (int i = 0; i < 60; ++i) {
        const Vector3 middle = normalized(random.vector()) * (20.0 + 10.0 * random.number());
        scene.add(plate(middle, random.vector() * 8.0, random.vector() * 8.0));
    }
    scene.update({{}});
    std::vector<Place> places;
    for (int i = 0; i < 6000; ++i) {
        Vector3 direction = random.vector();
        const double aside = 1.0 + 3.0 * texel(scene.maps) * random.number();
        if (i % 3 == 0)
            direction = {direction.x > 0.0 ? 1.0 : -1.0, direction.y > 0.0 ? aside : -aside, direction.z};
        if (i % 3 == 1)
            direction = {direction.x, direction.y > 0.0 ? 1.0 : -1.0, direction.z > 0.0 ? aside : -aside};
        places.push_back({normalized(direction) * 50.0, direction * -1.0});
    }
    const std::vector<float> visible = scene.visible(places);
    int lit = 0;
    int dark = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!is_far_from_edges(scene.triangles, places[i].position_m, 2.5 * texel(scene.maps)))
            continue;
        const bool truth = is_lit(scene.triangles, {}, places[i].position_m);
        (truth ? lit : dark) += 1;
        EXPECT_EQ(visible[i], truth ? 1.0f : 0.0f)
            << places[i].position_m.x << ", " << places[i].position_m.y << ", " << places[i].position_m.z;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 500);
}

TEST_F(LampMapsTest, AnswersTheSameWhereverOnAPlanetTheSceneIs)
{
    std::vector<std::vector<float>> all;
    for (const Vector3& offset_m : {Vector3{}, Vector3{4.1e6, -3.3e6, 3.6e6}}) {
        RandomVectors random(8);
        Scene scene;
        scene.eye_m = offset_m + Vector3{30.0, 40.0, 10.0};
        for (int i = 0; i < 40; ++i)
            scene.add(plate(offset_m + random.vector() * 30.0, random.vector() * 8.0, random.vector() * 8.0));
        scene.update({{.position_m = offset_m + Vector3{1.0, 2.0, 3.0}}});
        std::vector<Place> places;
        for (int i = 0; i < 2000; ++i)
            places.push_back({offset_m + random.vector() * 40.0, random.vector()});
        all.push_back(scene.visible(places));
    }
    // A float's last bit decides a place that lies on an edge.
    std::size_t other = 0;
    for (std::size_t i = 0; i < all[0].size(); ++i)
        other += std::abs(all[0][i] - all[1][i]) > 0.01f ? 1U : 0U;
    EXPECT_LE(other, 2U);
    EXPECT_GT(std::ranges::count(all[0], 0.0f), 100);
    EXPECT_GT(std::ranges::count(all[0], 1.0f), 300);
}

TEST_F(LampMapsTest, DrawsOnlyFacesThatHaveChanged)
{
    Scene scene({.size = 64});
    scene.add(plate({-5.0, -5.0, 2.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0}));
    SceneLamp lamp = {.position_m = {0.0, 0.0, 5.0}};
    SceneLamp beam = {.position_m = {0.0, 0.0, 8.0}, .half_angle = 30_deg};
    const std::vector<Place> place = {{{0.0, 0.0, 0.0}}};
    EXPECT_EQ(scene.update({}), 0U);
    EXPECT_EQ(scene.answers(place)[0][0], 0.0f);
    EXPECT_EQ(scene.update({beam, lamp}), 7U);
    EXPECT_EQ(scene.update({beam, lamp}), 0U);
    EXPECT_EQ(scene.update({lamp, beam}), 0U);
    EXPECT_EQ(scene.visible(place, 0)[0], 0.0f);
    EXPECT_EQ(scene.visible(place, 1)[0], 0.0f);
    lamp.bright_m = 7.0;
    EXPECT_EQ(scene.update({lamp, beam}), 0U);
    beam.direction = {0.1, 0.0, -1.0};
    EXPECT_EQ(scene.update({lamp, beam}), 1U);
    EXPECT_EQ(scene.update({beam}), 0U);
    EXPECT_EQ(scene.update({lamp, beam}), 0U); // switched off and on
    lamp.position_m.z = 1.0;
    EXPECT_EQ(scene.update({lamp, beam}), 6U);
    EXPECT_EQ(scene.visible(place, 0)[0], 1.0f); // under the plate now
    EXPECT_EQ(scene.visible(place, 1)[0], 0.0f);
    scene.triangles.clear();
    scene.maps.casters_changed();
    EXPECT_EQ(scene.update({lamp, beam}), 7U);
    EXPECT_EQ(scene.visible(place, 1)[0], 1.0f);
}

TEST_F(LampMapsTest, RefusesWhatIsOutOfRangeAndShinesOn)
{
    EXPECT_THROW(LampMaps({.size = 32}), InvalidInput);
    EXPECT_THROW(LampMaps({.taps = 0}), InvalidInput);
    EXPECT_THROW(LampMaps({.taps = 6}), InvalidInput);
    EXPECT_THROW(LampMaps({.slope_offset = -1.0}), InvalidInput);
    Scene scene({.size = 64});
    scene.update({{.position_m = {0.0, 0.0, 5.0}}});
    EXPECT_THROW(scene.update(std::vector<SceneLamp>(kMostLamps + 1)), InvalidInput);
    EXPECT_THROW(scene.update({{.bright_m = -1.0}}), InvalidInput);
    EXPECT_EQ(scene.maps.lamps().size(), 1U);
    EXPECT_GT(scene.answers({{{0.0, 0.0, 0.0}}})[0][0], 0.0f);
    EXPECT_EQ(scene.update(std::vector<SceneLamp>(kMostLamps)), 6U); // all the same
}

// Where a place lies in a face's map, texels; and how far ahead.
std::array<double, 3> in_map(const LampFace& face, const Vector3& place_m)
{
    const Vector3 p = place_m - face.lamp_m;
    const double ahead_m = dot(p, face.axes.forward);
    const double half = 0.5 * static_cast<double>(face.texels) / (face.half_width * ahead_m);
    return {half * dot(p, face.axes.right), half * dot(p, face.axes.up), ahead_m};
}

// Of two places, in the map of the face that the first lies in.
double texels_between(const SceneLamp& lamp, std::size_t size, const Vector3& first_m,
                      const Vector3& second_m)
{
    double most_ahead_m = 0.0;
    double apart = 0.0;
    for (const LampFace& face : lamp_faces(lamp, size)) {
        const auto first = in_map(face, first_m);
        const auto second = in_map(face, second_m);
        if (first[2] <= most_ahead_m)
            continue;
        most_ahead_m = first[2];
        apart = second[2] > 0.0 ? std::hypot(first[0] - second[0], first[1] - second[1]) : 1e9;
    }
    return apart;
}

// How a mask by maps differs from `exact`.
struct Difference {
    std::size_t cells = 0;
    std::size_t dark = 0;
    std::size_t wrong = 0;
    std::size_t far =
        0; ///< of those, farther than two texels from where they would be right, in the lamp's map
    double farthest_texels = 0.0;
};

Vector3 normal_at(const Terrain& terrain, std::size_t row, std::size_t column)
{
    const auto height_m = [&](std::size_t r, std::size_t c) {
        return static_cast<double>(terrain.heights_m(r, c));
    };
    const double across_m = 2.0 * terrain.cell_size_m.x;
    return {(height_m(row, column - 1) - height_m(row, column + 1)) / across_m,
            (height_m(row + 1, column) - height_m(row - 1, column)) / across_m, 1.0};
}

Difference difference(const Scene& scene, const Terrain& terrain, const SceneLamp& lamp)
{
    const GridPoint point = grid_point(lamp.position_m, terrain.cell_size_m);
    const ShadowMask truth = cast_by_exact(terrain, PointLight{point});
    const ShadowField shadow = shadow_heights_by_exact(terrain, PointLight{point});
    std::vector<Place> places;
    for (std::size_t row = 1; row + 1 < terrain.heights_m.rows(); ++row)
        for (std::size_t column = 1; column + 1 < terrain.heights_m.columns(); ++column)
            places.push_back({position_m({static_cast<double>(row), static_cast<double>(column),
                                          static_cast<double>(terrain.heights_m(row, column))},
                                         terrain.cell_size_m),
                              normal_at(terrain, row, column)});
    const std::vector<float> visible = scene.visible(places);
    Difference result;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t row = 1 + i / (terrain.heights_m.columns() - 2);
        const std::size_t column = 1 + i % (terrain.heights_m.columns() - 2);
        const bool lit = truth(row, column) == Lit::yes;
        ++result.cells;
        result.dark += lit ? 0U : 1U;
        if ((visible[i] >= 0.5f) == lit)
            continue;
        ++result.wrong;
        Vector3 raised_m = places[i].position_m;
        raised_m.z = static_cast<double>(shadow(row, column));
        const double texels = texels_between(lamp, scene.maps.options().size, places[i].position_m, raised_m);
        result.far += texels > 2.0 ? 1U : 0U;
        result.farthest_texels = std::max(result.farthest_texels, texels);
    }
    return result;
}

std::vector<Triangle> mesh_of(const Terrain& terrain)
{
    const auto at = [&](std::size_t row, std::size_t column) {
        return position_m({static_cast<double>(row), static_cast<double>(column),
                           static_cast<double>(terrain.heights_m(row, column))},
                          terrain.cell_size_m);
    };
    std::vector<Triangle> triangles;
    for (std::size_t row = 0; row + 1 < terrain.heights_m.rows(); ++row)
        for (std::size_t column = 0; column + 1 < terrain.heights_m.columns(); ++column) {
            triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
            triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
        }
    return triangles;
}

TEST_F(LampMapsTest, HillsUnderALampAreRightButForTwoTexelsAtEdges)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 200, .columns = 200, .cell_size_m = {10.0, 10.0}},
                        .height_m = 300.0,
                        .feature_m = 700.0,
                        .roughness = 0.35});
    for (const std::size_t size : {256U, 512U}) {
        Scene scene({.size = size});
        scene.add(mesh_of(terrain));
        for (const auto& [row, column, over_m] :
             {std::tuple{100.0, 100.0, 2.0}, {60.0, 150.0, 30.0}, {140.0, 40.0, 200.0}}) {
            const double ground_m = static_cast<double>(
                terrain.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
            const SceneLamp lamp = {
                .position_m = position_m({row + 0.3, column - 0.2, ground_m + over_m}, terrain.cell_size_m)};
            scene.update({lamp});
            const Difference found = difference(scene, terrain, lamp);
            // Shadows and gaps narrower than a kernel may be lost.
            EXPECT_LE(found.far, found.cells / 2000) << size << ", " << over_m << " m over the ground";
            EXPECT_LE(found.farthest_texels, 15.0);
            EXPECT_LE(found.wrong, found.cells / 15);
            EXPECT_GT(found.dark, found.cells / 2);
            EXPECT_GT(found.cells - found.dark, found.cells / 20);
        }
    }
}

} // namespace
} // namespace duskline::gl
