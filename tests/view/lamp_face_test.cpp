#include "random_vectors.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/view/lamp_face.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

// Column and row of the map, -1 to 1, depth, and the distance ahead.
struct Seen {
    double column;
    double row;
    double depth;
    double ahead;
};

Seen seen(const LampFace& face, const Vector3& place_m, const Vector3& origin_m)
{
    const Matrix4 m = face_to_clip(face, origin_m);
    const Vector3 p = place_m - origin_m;
    const auto part = [&](std::size_t i) {
        return static_cast<double>(m.at(i)) * p.x + static_cast<double>(m.at(i + 4)) * p.y
               + static_cast<double>(m.at(i + 8)) * p.z + static_cast<double>(m.at(i + 12));
    };
    return {part(0) / part(3), part(1) / part(3), part(2) / part(3), part(3)};
}

bool holds(const Seen& seen, double share = 1.0)
{
    return seen.ahead > 0.0 && std::max(std::abs(seen.column), std::abs(seen.row)) <= share;
}

TEST(LampFace, SixSeeAllRoundAndEachAsMuchMoreThanItsShareAsItSays)
{
    RandomVectors random(7);
    const Vector3 lamp_m = {100.0, -2000.0, 30.0};
    const std::vector<LampFace> faces = lamp_faces({.position_m = lamp_m}, 512);
    ASSERT_EQ(faces.size(), 6U);
    constexpr double share = 504.0 / 512.0;
    for (int i = 0; i < 2000; ++i) {
        const Vector3 direction = random.vector();
        const auto holders = std::ranges::count_if(faces, [&](const LampFace& face) {
            return holds(seen(face, lamp_m + direction * 40.0, {99.0, -1990.0, 0.0}), share + 1e-6);
        });
        EXPECT_EQ(holders, 1) << direction.x << ", " << direction.y << ", " << direction.z;
    }
    for (const LampFace& face : faces) {
        const auto& [forward, right, up] = face.axes;
        EXPECT_NEAR(dot(cross(right, up), forward), -1.0, 1e-12);
        EXPECT_NEAR(seen(face, lamp_m + (forward + right) * 9.0, lamp_m).column, share, 1e-6);
        EXPECT_NEAR(seen(face, lamp_m + (forward - up) * 9.0, lamp_m).row, -share, 1e-6);
    }
}

TEST(LampFace, OneHoldsTheBeamOfASearchlight)
{
    RandomVectors random(7);
    for (const double half_deg : {3.0, 25.0, 60.0}) {
        const Vector3 axis = random.vector();
        const SceneLamp lamp = {.position_m = {5.0, 6.0, 7.0},
                                .direction = axis * 12.0,
                                .half_angle = Angle::from_degrees(half_deg)};
        const std::vector<LampFace> faces = lamp_faces(lamp, 256);
        ASSERT_EQ(faces.size(), 1U);
        const double cosine = sine_cosine(lamp.half_angle).cosine;
        for (int i = 0; i < 3000; ++i) {
            const Vector3 direction = normalized(random.vector());
            if (dot(direction, normalized(axis)) >= cosine) {
                EXPECT_TRUE(holds(seen(faces[0], lamp.position_m + direction * 70.0, {0.0, 0.0, 0.0}),
                                  248.0 / 256.0 + 1e-6));
            }
        }
    }
    EXPECT_EQ(lamp_faces({.half_angle = 61_deg}, 256).size(), 6U);
}

TEST(LampFace, DepthIsMetresOverTheDistanceAheadWhereverTheOriginIs)
{
    const LampFace face = lamp_faces({.position_m = {1e6, 2e6, 3e6}}, 256)[0];
    for (const double ahead_m : {0.5, 20.0, 30000.0})
        for (const double beside_m : {0.0, 1000.0}) {
            const Vector3 place_m = {1e6 + ahead_m, 2e6, 3e6};
            EXPECT_NEAR(seen(face, place_m, {1e6 + beside_m, 2e6, 3e6 - beside_m}).depth * ahead_m,
                        kNearestToLamp_m, 1e-4 * kNearestToLamp_m);
        }
}

TEST(LampFace, LeavesOutOnlyBoxesItCannotSee)
{
    RandomVectors random(7);
    int left_out = 0;
    int taken = 0;
    for (int i = 0; i < 3000; ++i) {
        const SceneLamp lamp = {.position_m = random.vector() * 10.0, .range_m = 60.0};
        const LampFace face = lamp_faces(lamp, 64).at(static_cast<std::size_t>(i) % 6);
        const Vector3 middle_m = random.vector() * 100.0;
        const Vector3 half_m = Vector3{1.1, 1.1, 1.1} * (10.0 * (1.0 + random.number()));
        const Box box = {middle_m - half_m, middle_m + half_m};
        if (may_cast_into(face, box)) {
            ++taken;
            continue;
        }
        ++left_out;
        for (int k = 0; k < 60; ++k) {
            const Vector3 n = random.vector();
            const Vector3 p = middle_m + Vector3{half_m.x * n.x, half_m.y * n.y, half_m.z * n.z};
            EXPECT_FALSE(length(p - lamp.position_m) < 60.0 && holds(seen(face, p, lamp.position_m)));
        }
    }
    EXPECT_GT(left_out, 1500);
    EXPECT_GT(taken, 200);
}

TEST(LampFace, HasTheSameMapWhileNothingButItsLightChanges)
{
    const SceneLamp lamp = {.position_m = {1.0, 2.0, 3.0}, .half_angle = 30_deg};
    SceneLamp brighter = lamp;
    brighter.bright_m = 900.0;
    brighter.colour = {1.0f, 0.0f, 0.0f};
    EXPECT_TRUE(same_map(lamp_faces(lamp, 128)[0], lamp_faces(brighter, 128)[0]));
    SceneLamp moved = lamp;
    moved.position_m.y += 0.01;
    EXPECT_FALSE(same_map(lamp_faces(lamp, 128)[0], lamp_faces(moved, 128)[0]));
    EXPECT_FALSE(same_map(lamp_faces(lamp, 128)[0], lamp_faces(lamp, 256)[0]));
    SceneLamp turned = lamp;
    turned.direction = {0.1, 0.0, -1.0};
    EXPECT_FALSE(same_map(lamp_faces(lamp, 128)[0], lamp_faces(turned, 128)[0]));
}

} // namespace
} // namespace duskline
