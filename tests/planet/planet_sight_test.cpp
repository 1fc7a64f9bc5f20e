#include "planet/mountains_on_a_ball.h"

#include <duskline/casting/ray.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_ray.h>
#include <duskline/planet/planet_sight.h>
#include <duskline/products/mask_difference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace duskline {
namespace {

constexpr double kRadius_m = 6371000.0;
constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
const Globe kBall = sphere_of_radius(kRadius_m);

// All over the globe, for i = 0, 1, ...
Vector3 scattered(int i)
{
    return normalized({std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1.0)});
}

// A unit vector at right angles to a direction.
Vector3 aside(const Vector3& direction, int i)
{
    const Vector3 any = scattered(7 * i + 3);
    return normalized(any - direction * dot(any, direction));
}

Vector3 turned_by(const Vector3& direction, const Vector3& towards, double radians)
{
    return direction * std::cos(radians) + towards * std::sin(radians);
}

double hills_m(const Vector3& d)
{
    return 3000.0 * (std::sin(11.0 * d.x) * std::cos(13.0 * d.y) + std::sin(17.0 * d.z + d.x));
}
constexpr HeightRange kHills = {-6000.0F, 6000.0F};

TEST(PlanetSight, ReachesAsFarAsTheHorizonsOfBothEndsOfASmoothBall)
{
    constexpr std::uint32_t level = 9;
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const PlanetSight sight(ground.at_level(level));
    const auto horizon = [](double height_m) { return std::acos(kRadius_m / (kRadius_m + height_m)); };
    const double low_m = 100.0;
    const double high_m = 1000.0;
    const double farthest = horizon(low_m) + horizon(high_m); // 35.7 and 112.9 km
    // A straight line between samples sinks under the ball.
    const double spacing = spacing_m(kBall, level);
    const double slack = spacing * spacing / (4.0 * kRadius_m) / kRadius_m / horizon(low_m);
    EXPECT_LT(slack, farthest / 500.0);
    for (int i = 0; i < 12; ++i) {
        const Vector3 here = i == 0   ? normalized({1.0, 1.0, 1.0}) // a corner of the cube
                             : i == 1 ? normalized({1.0, -1.0, 0.1})
                                      : scattered(i);
        const Vector3 from_m = point_m(kBall, here, low_m);
        const auto seen_at = [&](double away) {
            return sight.sees(from_m, point_m(kBall, turned_by(here, aside(here, i), away), high_m));
        };
        EXPECT_TRUE(seen_at(0.5 * farthest)) << i;
        EXPECT_TRUE(seen_at(farthest - slack)) << i;
        EXPECT_FALSE(seen_at(farthest + slack)) << i;
        EXPECT_FALSE(seen_at(2.0 * farthest)) << i;
        EXPECT_FALSE(sight.sees(from_m, point_m(kBall, here * -1.0, 1e9))) << i;
    }
}

// A wall one sample thick along a meridian, seen across along the equator, where the line stays on a row of samples.
TEST(PlanetSight, PassesAWallWherePlaneTrigonometrySays)
{
    constexpr std::uint32_t level = 9;
    const double step = 2.0 / static_cast<double>(kTileSquares << level);
    const double wall_u = 1600.0 * step; // the tangent of its longitude
    const double wall = std::atan(wall_u);
    const double top_m = 400.0;
    const MadeGround ground(kBall, {0.0F, 400.0F}, [&](const Vector3& direction) {
        return std::abs(direction.y / direction.x - wall_u) < step / 2.0 ? top_m : 0.0;
    });
    const PlanetSight sight(ground.at_level(level));
    const auto at = [](double longitude, double radius_m) {
        return Vector3{std::cos(longitude), std::sin(longitude), 0.0} * radius_m;
    };
    int passed = 0;
    for (const double lamp_m : {500.0, 800.0, 3000.0})
        for (const double lamp_km : {1.3, 20.0})
            for (const double point_km : {0.7, 11.0}) {
                const double before = 1000.0 * lamp_km / kRadius_m;
                const double behind = 1000.0 * point_km / kRadius_m;
                // The line over the wall's top: 1 / r is a sum of a sine and a cosine of the angle at the centre.
                const double point_radius_m = std::sin(before)
                                              / (std::sin(before + behind) / (kRadius_m + top_m)
                                                 - std::sin(behind) / (kRadius_m + lamp_m));
                if (point_radius_m < kRadius_m + 5.0) // under the ground
                    continue;
                const Vector3 lamp = at(wall - before, kRadius_m + lamp_m);
                EXPECT_TRUE(sight.sees(at(wall + behind, point_radius_m + 0.001), lamp))
                    << lamp_m << ' ' << lamp_km << ' ' << point_km;
                EXPECT_FALSE(sight.sees(at(wall + behind, point_radius_m - 0.001), lamp))
                    << lamp_m << ' ' << lamp_km << ' ' << point_km;
                ++passed;
                // On the same side of the wall it is not in the way.
                EXPECT_TRUE(sight.sees(at(wall - before - behind, kRadius_m + 20.0), lamp));
            }
    EXPECT_GE(passed, 6);
}

TEST(PlanetSight, OfALampFarAwayIsTheLightOfASun)
{
    const MadeGround ground(kBall, kHills, hills_m);
    for (int i = 0; i < 6; ++i) {
        const Vector3 sun = scattered(100 + i);
        const PlanetRays rays(ground.at_level(3), sun);
        const PlanetSight sight(ground.at_level(3));
        int lit = 0;
        for (int j = 0; j < 200; ++j) {
            const Vector3 place = scattered(200 * i + j);
            const double height_m = hills_m(place) + 20.0 * j;
            const bool seen = sight.sees(point_m(kBall, place, height_m), sun * 1e16);
            EXPECT_EQ(seen, rays.is_lit(place, height_m)) << i << ' ' << j;
            lit += seen ? 1 : 0;
        }
        EXPECT_GT(lit, 40);
        EXPECT_LT(lit, 160);
    }
}

TEST(PlanetSight, IsTheSameFromBothEndsOnRoughGround)
{
    const MadeGround ground(kBall, kMountains, mountains_m);
    const PlanetSight sight(ground.at_level(5));
    const Vector3 corner = normalized({1.0, -1.0, 1.0});
    int seen = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vector3 here = turned_by(corner, aside(corner, i), 0.0003 * (i % 311));
        const Vector3 there = turned_by(here, aside(here, i), 0.0002 * (1 + i % 200));
        const Vector3 from_m = point_m(kBall, here, mountains_m(here) + 2.0 * (i % 100));
        const Vector3 to_m = point_m(kBall, there, mountains_m(there) + 300.0);
        EXPECT_EQ(sight.sees(from_m, to_m), sight.sees(to_m, from_m)) << i;
        seen += sight.sees(from_m, to_m) ? 1 : 0;
    }
    EXPECT_GT(seen, 200);
    EXPECT_LT(seen, 800);
}

TEST(PlanetSight, AgreesWithASightThatGoesOnOverTheEdgesAndCornersOfTheCube)
{
    // The same ground in frames that differ by turns of the cube: the grids coincide, the faces do not.
    const auto turned = [](const Vector3& d) { return Vector3{d.y, d.z, d.x}; };
    const MadeGround ground(kBall, kHills, hills_m);
    const MadeGround other(kBall, kHills, [&](const Vector3& d) { return hills_m(turned(d)); });
    const PlanetSight sight(ground.at_level(3));
    const PlanetSight other_sight(other.at_level(3));
    int seen = 0;
    for (int i = 0; i < 600; ++i) {
        // Many across an edge, some round a corner.
        const Vector3 here = i % 3 == 0   ? normalized({1.0, 1.0, 1.0 + 0.01 * i / 600.0})
                             : i % 3 == 1 ? normalized({1.0, -1.02, std::sin(i * 0.7)})
                                          : scattered(i);
        const Vector3 there = turned_by(here, aside(here, i), 0.001 * (1 + i % 90));
        const Vector3 from_m = point_m(kBall, here, hills_m(turned(here)) + 400.0);
        const Vector3 to_m = point_m(kBall, there, hills_m(turned(there)) + 200.0 * (i % 7));
        const bool sees = other_sight.sees(from_m, to_m);
        EXPECT_EQ(sight.sees(turned(from_m), turned(to_m)), sees) << i;
        seen += sees ? 1 : 0;
    }
    EXPECT_GT(seen, 100);
    EXPECT_LT(seen, 500);
}

TEST(PlanetSight, IsNotEndedByTheGroundUnderEitherEnd)
{
    const MadeGround ground(kBall, {0.0F, 8848.0F}, [](const Vector3&) { return 8848.0; });
    const PlanetSight sight(ground.at_level(6));
    for (int i = 0; i < 20; ++i) {
        const TilePlace square = place_in_tile(scattered(i), 6);
        const double row = std::floor(square.row);
        const double column = std::floor(square.column);
        // On a sample, straight up and down, and along a side of a square.
        const Vector3 sample = sample_direction(square.tile, row, column);
        const Vector3 next = sample_direction(square.tile, row, column + 1.0);
        const Vector3 on_ground_m = point_m(kBall, sample, 8848.0);
        EXPECT_TRUE(sight.sees(on_ground_m, on_ground_m));
        EXPECT_TRUE(sight.sees(on_ground_m, point_m(kBall, sample, 9000.0)));
        EXPECT_TRUE(sight.sees(point_m(kBall, sample, 9000.0), on_ground_m));
        EXPECT_TRUE(sight.sees(on_ground_m, point_m(kBall, next, 8848.0)));
        EXPECT_TRUE(sight.sees(point_m(kBall, next, 8848.0), on_ground_m));
        EXPECT_FALSE(sight.sees(on_ground_m, on_ground_m * -1.0));
    }
}

TEST(PlanetSight, IsThatOfLampsOnACurvedRasterButForCellsBesideShadowEdges)
{
    const MountainsOnABall scene(kRadius_m);
    const Terrain curved = scene.curved_raster();
    const PlanetSight sight(scene.ground().at_level(MountainsOnABall::kLevel));
    struct Lamp {
        double row;
        double column;
        double above_m;
    };
    for (const Lamp& lamp : {Lamp{60.0, 180.0, 100.0}, Lamp{200.3, 40.6, 700.0}}) {
        const auto ground_m = static_cast<double>(scene.mountains().heights_m(
            static_cast<std::size_t>(lamp.row), static_cast<std::size_t>(lamp.column)));
        const double lamp_m = ground_m + lamp.above_m;
        const ShadowMask expected = cast_by_ray(
            curved, PointLight{{lamp.row, lamp.column, scene.lowered_m(lamp.row, lamp.column, lamp_m)}});
        const Vector3 lamp_at_m = point_m(kBall, scene.direction(lamp.row, lamp.column), lamp_m);
        const ShadowMask mask = scene.mask_by([&](const Vector3& place, double height_m) {
            return sight.sees(point_m(kBall, place, height_m), lamp_at_m);
        });
        const MaskDifference difference = mask_difference(expected, mask);
        EXPECT_LT(difference.differing, difference.cells / 1000) << lamp.row;
        EXPECT_LE(difference.farthest_from_edge.value_or(kNowhere), 1U) << lamp.row;
    }
}

TEST(PlanetSight, RefusesTheCentreAndWhatIsNoPoint)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const PlanetSight sight(ground.at_level(0));
    const Vector3 there = {7e6, 0.0, 0.0};
    EXPECT_THROW(sight.sees({0.0, 0.0, 0.0}, there), InvalidInput);
    EXPECT_THROW(sight.sees(there, {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}), InvalidInput);
    PlanetLevel empty = ground.at_level(0);
    empty.range = {1.0F, 0.0F};
    EXPECT_THROW(PlanetSight{empty}, InvalidInput);
    EXPECT_THROW(PlanetSight(ground.at_level(kDeepestTileLevel + 1)), InvalidInput);
}

} // namespace
} // namespace duskline
