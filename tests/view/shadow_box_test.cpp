#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/view/shadow_box.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr double kEarth_m = 6371000.0;

// Seeded numbers and directions.
class Random {
public:
    double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(numbers_()) / 4294967295.0;
    }
    Vector3 direction()
    {
        for (;;) {
            const Vector3 v = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
            if (length(v) > 0.1 && length(v) < 1.0)
                return normalized(v);
        }
    }

private:
    std::mt19937 numbers_{7};
};

Vector3 towards(double azimuth_deg, double altitude_deg)
{
    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(altitude_deg));
    const auto [east, north] = sine_cosine(Angle::from_degrees(azimuth_deg));
    return {east * cosine, north * cosine, sine};
}

// Somewhere on a globe, looking anywhere, under any light.
ShadowView any_view(Random& random)
{
    ShadowView view;
    view.up = random.direction();
    view.clearance_m = std::exp(random.between(0.0, 10.0));
    view.eye_m = view.up * (kEarth_m + view.clearance_m);
    view.forward = random.direction();
    view.half_view = Angle::from_degrees(random.between(10.0, 110.0));
    view.towards_light = random.direction();
    view.curvature_per_m = 1.0 / kEarth_m;
    view.highest_above_eye_m = 4000.0 - view.clearance_m;
    return view;
}

// 0 to 1 inside the box, in map and depth.
Vector3 in_box(const ShadowBox& box, const Vector3& position_m)
{
    const Vector3 from_centre_m = position_m - box.centre_m;
    return {0.5 + dot(from_centre_m, box.axes.right) / box.side_m,
            0.5 + dot(from_centre_m, box.axes.up) / box.side_m,
            0.5 - dot(from_centre_m, box.axes.towards_light) / box.side_m};
}

void expect_inside(const Vector3& place)
{
    for (const double part : {place.x, place.y, place.z}) {
        EXPECT_GE(part, 0.0);
        EXPECT_LE(part, 1.0);
    }
}

TEST(LightAxes, AreUnitVectorsAtRightAnglesWhateverTheLight)
{
    Random random;
    LightAxes turned = light_axes({0.0, 0.0, 1.0});
    for (int i = 0; i < 300; ++i) {
        const Vector3 light = i == 0 ? Vector3{0.0, 0.0, 1.0} : random.direction();
        turned = turned_to(turned, light);
        for (const LightAxes& axes : {light_axes(light), turned}) {
            EXPECT_NEAR(length(cross(axes.right, axes.up) - light), 0.0, 1e-12);
            EXPECT_NEAR(length(axes.right), 1.0, 1e-12);
            EXPECT_NEAR(length(axes.up), 1.0, 1e-12);
        }
    }
}

TEST(LightAxes, TurnNoFartherThanTheLightEvenThroughTheZenith)
{
    LightAxes axes = light_axes(towards(180.0, 89.95));
    for (double hour = 0.0; hour < 1.0; hour += 0.01) {
        const Vector3 light = towards(180.0 + 180.0 * hour, 89.95);
        const double light_turned = length(light - axes.towards_light);
        const LightAxes next = turned_to(axes, light);
        EXPECT_LE(length(next.right - axes.right), light_turned + 1e-12);
        EXPECT_LE(length(next.up - axes.up), light_turned + 1e-12);
        axes = next;
    }
}

TEST(ShadowBox, HoldsAllThatThePictureShowsUpToItsRadius)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        const ShadowView view = any_view(random);
        const ShadowBox box = ShadowBoxFollower().follow(view);
        EXPECT_DOUBLE_EQ(box.radius_m, 12.0 * std::max(2.0, view.clearance_m));
        const auto [sine, cosine] = sine_cosine(view.half_view);
        for (int j = 0; j < 50; ++j) {
            // On the cone, where it is farthest from the middle, or anywhere in it.
            const Vector3 aside = normalized(cross(view.forward, random.direction()));
            const double share = j % 2 == 0 ? 1.0 : random.between(0.0, 1.0);
            const Vector3 ray = normalized(view.forward * cosine + aside * (sine * share));
            const double away_m = box.radius_m * (j % 3 == 0 ? 1.0 : random.between(0.0, 1.0));
            expect_inside(in_box(box, view.eye_m + ray * away_m));
        }
    }
}

TEST(ShadowBox, SideIsInProportionToTheClearance)
{
    for (const double clearance_m : {15.0, 50.0, 100.0, 200.0, 5000.0}) {
        const ShadowBox box = ShadowBoxFollower({.texels = 512}).follow({.clearance_m = clearance_m});
        // The ball's diameter for a half view of 45 degrees, 1/32 for the steps, and up to the root of 2 for sizes.
        const double least_m = 12.0 * clearance_m * std::sqrt(2.0) * 32.0 / 31.0;
        EXPECT_GE(box.side_m, least_m * (1.0 - 1e-12));
        EXPECT_LT(box.side_m, least_m * std::sqrt(2.0));
        EXPECT_DOUBLE_EQ(box.texel_m, box.side_m / 512.0);
    }
}

TEST(ShadowBox, IsNoLargerThanTheGroundIsFar)
{
    const ShadowBox box = ShadowBoxFollower().follow(
        {.clearance_m = 1e5, .farthest_ground_m = 2e5, .towards_light = {0.0, 0.0, 1.0}});
    EXPECT_LT(box.side_m, 2e5 * 2.1);
    EXPECT_DOUBLE_EQ(box.radius_m, 1.2e6);
    EXPECT_THROW(ShadowBoxFollower().follow({.farthest_ground_m = 0.0}), InvalidInput);
}

TEST(ShadowBox, KeepsItsSideWhileTheEyeGoesUpAndDownALittle)
{
    for (double clearance_m = 10.0; clearance_m < 20.0; clearance_m *= 1.01) {
        ShadowBoxFollower follower;
        follower.follow({.clearance_m = clearance_m});
        const double side_m = follower.follow({.clearance_m = clearance_m * 1.05}).side_m;
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(follower.follow({.clearance_m = clearance_m * (1.0 + 0.05 * std::cos(i))}).side_m,
                      side_m);
    }
}

TEST(ShadowBox, GrowsAtOnceAndShrinksInTheEnd)
{
    ShadowBoxFollower follower;
    const double low_m = follower.follow({.clearance_m = 20.0}).side_m;
    EXPECT_GT(follower.follow({.clearance_m = 100.0}).side_m, 3.0 * low_m);
    EXPECT_EQ(follower.follow({.clearance_m = 20.0}).side_m, low_m);
}

TEST(ShadowBox, MovesByWholeStepsOfTexelsOnAPlaneAndOnAGlobe)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        ShadowView view = any_view(random);
        ShadowBoxFollower follower({.texels = 1000});
        const ShadowBox first = follower.follow(view);
        for (int j = 0; j < 20; ++j) {
            view.eye_m = view.eye_m + random.direction() * (random.between(0.0, 0.2) * first.side_m);
            const ShadowBox box = follower.follow(view);
            const Vector3 moved_m = box.centre_m - first.centre_m;
            for (const Vector3& axis : {box.axes.right, box.axes.up, box.axes.towards_light}) {
                const double steps = dot(moved_m, axis) / (31.0 * box.texel_m); // 1000 / 32
                EXPECT_NEAR(steps, std::round(steps), 1e-4);
            }
        }
    }
}

TEST(ShadowBox, StaysWhereItIsForMostSmallMoves)
{
    ShadowBoxFollower follower;
    ShadowView view = {
        .eye_m = {1000.0, -2000.0, 300.0}, .clearance_m = 50.0, .towards_light = towards(100.0, 20.0)};
    ShadowBox box = follower.follow(view);
    int moves = 0;
    for (int i = 0; i < 1000; ++i) {
        view.eye_m.x += box.side_m / 1000.0;
        const ShadowBox next = follower.follow(view);
        moves += same_map(box, next) ? 0 : 1;
        box = next;
    }
    EXPECT_GE(moves, 20);
    EXPECT_LE(moves, 96); // 32 a side along each of the three axes
}

TEST(ShadowBox, TurnsRoundItsMiddleWithTheLight)
{
    ShadowBoxFollower follower;
    ShadowView view = {
        .eye_m = {5e5, -3e5, 300.0}, .clearance_m = 50.0, .towards_light = towards(100.0, 20.0)};
    const ShadowBox before = follower.follow(view);
    view.towards_light = towards(100.01, 20.01);
    const ShadowBox after = follower.follow(view);
    // The middle stays on a corner of steps: it has not moved, or by whole ones.
    const double step_m = 128.0 * after.texel_m;
    const double steps = dot(after.centre_m - before.centre_m, after.axes.right) / step_m;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    EXPECT_FALSE(same_map(before, after));
}

TEST(ShadowBox, WhatMayShadeItIsNotLeftOut)
{
    Random random;
    int over_the_front = 0;
    for (int i = 0; i < 2000; ++i) {
        ShadowView view = any_view(random);
        const bool plane = i % 2 == 0;
        if (plane) {
            view.up = {0.0, 0.0, 1.0};
            view.eye_m = {10.0, 20.0, view.clearance_m};
            view.curvature_per_m = 0.0;
            view.towards_light = towards(random.between(0.0, 360.0), random.between(1.0, 90.0));
        }
        const ShadowBox box = ShadowBoxFollower({.farthest_caster_m = 1e7}).follow(view);
        const auto height_over_eye_m = [&](const Vector3& p) {
            return plane ? p.z - view.eye_m.z : length(p) - length(view.eye_m);
        };
        // A place in the ball, and one towards the light that is no higher than the highest ground.
        const Vector3 place_m =
            box.centre_m + random.direction() * (0.5 * box.side_m * random.between(0.0, 0.95));
        const Vector3 caster_m = place_m + view.towards_light * std::exp(random.between(0.0, 13.0));
        // Over a globe the reach takes the up of the ball's centre for that of all of it: small boxes only.
        if (height_over_eye_m(caster_m) > view.highest_above_eye_m || (!plane && box.side_m > 2e4))
            continue;
        over_the_front += in_box(box, caster_m).z < 0.0 ? 1 : 0;
        EXPECT_TRUE(may_cast_into(box, {caster_m, caster_m})) << i;
    }
    EXPECT_GT(over_the_front, 20);
}

TEST(ShadowBox, WhatLiesBesideBehindOrFarBeforeItIsLeftOut)
{
    const ShadowView view = {
        .clearance_m = 100.0, .highest_above_eye_m = 500.0, .towards_light = towards(90.0, 30.0)};
    const ShadowBox box = ShadowBoxFollower().follow(view);
    const auto at = [&](double right, double up, double towards_light) {
        const Vector3 place =
            box.centre_m
            + (box.axes.right * right + box.axes.up * up + box.axes.towards_light * towards_light)
                  * (0.5 * box.side_m);
        return Box{place - Vector3{1.0, 1.0, 1.0}, place + Vector3{1.0, 1.0, 1.0}};
    };
    EXPECT_TRUE(may_cast_into(box, at(0.99, -0.99, 0.99)));
    EXPECT_FALSE(may_cast_into(box, at(1.1, 0.0, 0.0)));
    EXPECT_FALSE(may_cast_into(box, at(0.0, -1.1, 0.0)));
    EXPECT_FALSE(may_cast_into(box, at(0.0, 0.0, -1.1)));
    EXPECT_TRUE(may_cast_into(box, at(0.0, 0.0, 1.1)));
    EXPECT_FALSE(may_cast_into(box, at(0.0, 0.0, 1.1 + 2.0 * box.caster_reach_m / box.side_m)));
    EXPECT_TRUE(
        may_cast_into(box, {box.centre_m - Vector3{1e5, 1e5, 1e5}, box.centre_m + Vector3{1e5, 1e5, 1e5}}));
}

TEST(ShadowBox, RowsSayWhereAPlaceIsRelativeToAnyOrigin)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        const ShadowView view = any_view(random);
        const ShadowBox box = ShadowBoxFollower().follow(view);
        const Vector3 place_m = view.eye_m + random.direction() * (0.3 * box.side_m);
        const Vector3 p = place_m - view.eye_m;
        const auto rows = box_rows(box, view.eye_m);
        const Matrix4 clip = box_to_clip(box, view.eye_m);
        const Vector3 expected = in_box(box, place_m);
        const std::array<double, 3> parts = {expected.x, expected.y, expected.z};
        for (std::size_t row = 0; row < 3; ++row) {
            const auto& r = rows.at(row);
            const double in_map = r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
            EXPECT_NEAR(in_map, parts.at(row), 1e-6);
            const double in_clip =
                clip.at(row) * p.x + clip.at(4 + row) * p.y + clip.at(8 + row) * p.z + clip.at(12 + row);
            EXPECT_NEAR(in_clip, 2.0 * parts.at(row) - 1.0, 2e-6);
        }
    }
}

TEST(ShadowBox, RefusesWhatCannotBe)
{
    EXPECT_THROW(ShadowBoxFollower({.texels = 63}), InvalidInput);
    EXPECT_THROW(ShadowBoxFollower({.reach = 0.0}), InvalidInput);
    EXPECT_THROW(ShadowBoxFollower({.least_clearance_m = -1.0}), InvalidInput);
    EXPECT_THROW(ShadowBoxFollower({.farthest_caster_m = 0.0}), InvalidInput);
    EXPECT_THROW(ShadowBoxFollower().follow({.clearance_m = std::numeric_limits<double>::quiet_NaN()}),
                 InvalidInput);
    EXPECT_THROW(ShadowBoxFollower().follow({.half_view = 0_deg}), InvalidInput);
}

} // namespace
} // namespace duskline
