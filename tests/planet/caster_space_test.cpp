#include "random_vectors.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/planet/caster_space.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

bool holds(const LampFace& face, const Vector3& place_m)
{
    const Vector3 p = place_m - face.lamp_m;
    const double ahead_m = dot(p, face.axes.forward);
    return length(p) < face.range_m
           && std::max(std::abs(dot(p, face.axes.right)), std::abs(dot(p, face.axes.up)))
                  <= face.half_width * ahead_m;
}

bool holds(const OrientedBox& box, const Vector3& place_m)
{
    return distance_m(place_m, box) < 1e-9;
}

TEST(CasterSpace, HoldsAllThatAFaceMaySee)
{
    RandomVectors random(9);
    for (const double half_deg : {20.0, 180.0}) {
        const SceneLamp lamp = {.position_m = random.vector() * 50.0,
                                .direction = random.vector(),
                                .half_angle = Angle::from_degrees(half_deg),
                                .range_m = 100.0};
        for (const LampFace& face : lamp_faces(lamp, 64)) {
            int seen = 0;
            for (int i = 0; i < 3000; ++i) {
                const Vector3 place_m = lamp.position_m + random.vector() * 100.0;
                if (!holds(face, place_m))
                    continue;
                ++seen;
                EXPECT_TRUE(holds(space_of(face), place_m));
            }
            EXPECT_GT(seen, 20);
        }
    }
}

TEST(CasterSpace, IsAShadowBoxAndWhatCastsIntoItFromTheLight)
{
    RandomVectors random(10);
    for (int i = 0; i < 200; ++i) {
        const ShadowBox box = {.axes = light_axes(normalized(random.vector())),
                               .centre_m = random.vector() * 100.0,
                               .side_m = 20.0,
                               .caster_reach_m = 50.0};
        const auto at = [&](double right, double up, double towards_light) {
            return box.centre_m + box.axes.right * right + box.axes.up * up
                   + box.axes.towards_light * towards_light;
        };
        const double x = 10.0 * random.number();
        const double y = 10.0 * random.number();
        EXPECT_TRUE(holds(space_of(box), at(x, y, -9.9)));
        EXPECT_TRUE(holds(space_of(box), at(x, y, 59.9)));
        EXPECT_FALSE(holds(space_of(box), at(x, y, -10.1)));
        EXPECT_FALSE(holds(space_of(box), at(x, y, 60.1)));
        EXPECT_FALSE(holds(space_of(box), at(10.1, y, 0.0)));
        EXPECT_FALSE(holds(space_of(box), at(x, -10.1, 0.0)));
    }
}

TEST(CasterSpace, LeavesOutOnlyBoxesThatAFaceCannotSee)
{
    RandomVectors random(9);
    int left_out = 0;
    int taken = 0;
    for (int i = 0; i < 3000; ++i) {
        const SceneLamp lamp = {.position_m = random.vector() * 10.0, .range_m = 60.0};
        const LampFace face = lamp_faces(lamp, 64).at(static_cast<std::size_t>(i) % 6);
        const Vector3 x = normalized(random.vector());
        const Vector3 y = normalized(cross(x, random.vector()));
        const double half_m = 10.0 * (1.0 + random.number());
        const OrientedBox box = {
            random.vector() * 100.0, {x, y, cross(x, y)}, {half_m, 0.5 * half_m, half_m}};
        if (may_cast_into(face, box)) {
            ++taken;
            continue;
        }
        ++left_out;
        for (int k = 0; k < 60; ++k)
            EXPECT_FALSE(holds(face, box.centre_m + x * (half_m * random.number())
                                         + y * (0.5 * half_m * random.number())
                                         + box.axes[2] * (half_m * random.number())));
    }
    EXPECT_GT(left_out, 1500);
    EXPECT_GT(taken, 100);
}

} // namespace
} // namespace duskline
