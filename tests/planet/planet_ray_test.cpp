#include "planet/mountains_on_a_ball.h"

#include <duskline/casting/ray.h>
#include <duskline/planet/planet_ray.h>
#include <duskline/products/mask_difference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace duskline {
namespace {

constexpr double kRadius_m = 6371000.0;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
const Globe kBall = sphere_of_radius(kRadius_m);

Vector3 at_longitude(double degrees)
{
    return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0.0};
}

double spacing_of(std::uint32_t level)
{
    return spacing_m(kBall, level);
}

// How far a straight line between samples sinks under the sphere.
double sag_m(std::uint32_t level)
{
    return spacing_of(level) * spacing_of(level) / (8.0 * kRadius_m);
}

TEST(PlanetRay, OfASmoothBallEndsTheDayAtTheTerminator)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const Vector3 sun = normalized({0.3, -0.5, 0.8});
    const LightAxis axis = light_axis(sun);
    const PlanetRays rays(ground.at_level(4), sun);
    for (int turn = 0; turn < 16; ++turn) {
        const Vector3 outward = outward_at(axis, turn / 16.0 + 0.01);
        const auto at = [&](double degrees) {
            return sun * std::cos(degrees * kDegree) + outward * std::sin(degrees * kDegree);
        };
        for (const double degrees : {0.5, 20.0, 60.0, 85.0, 89.5})
            EXPECT_TRUE(rays.is_lit(at(degrees), 0.0)) << degrees << " degrees from the sun, turn " << turn;
        for (const double degrees : {90.5, 91.0, 100.0, 140.0, 179.5}) {
            EXPECT_FALSE(rays.is_lit(at(degrees), -sag_m(4))) << degrees << " degrees, turn " << turn;
            const double shadow_m = kRadius_m / std::sin(degrees * kDegree) - kRadius_m;
            EXPECT_NEAR(rays.shadow_height_m(at(degrees)), shadow_m,
                        3.0 * sag_m(4) / std::sin(degrees * kDegree));
        }
    }
}

TEST(PlanetRay, OnTheAxisIsLitUnderTheSunAndDarkOppositeAtAnyHeight)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    for (const Vector3& sun : {Vector3{1.0, 0.0, 0.0}, Vector3{0.0, 0.0, -1.0}, normalized({1.0, 1.0, 1.0}),
                               normalized({0.3, -0.9, 0.1})}) {
        const PlanetRays rays(ground.at_level(3), sun);
        EXPECT_EQ(rays.shadow_height_m(sun), -kInfinity);
        EXPECT_TRUE(rays.is_lit(sun, 0.0));
        EXPECT_EQ(rays.shadow_height_m(sun * -1.0), kInfinity);
        EXPECT_FALSE(rays.is_lit(sun * -1.0, 1e6));
    }
}

// A wall one sample thick along a meridian, and the sun over the equator: along it light stays on a row of samples.
TEST(PlanetRay, ShadowOfAWallEndsWhereSphericalTrigonometrySays)
{
    constexpr std::uint32_t level = 8;
    const double step = 2.0 / static_cast<double>(kTileSquares << level);
    const double wall_u = 1600.0 * step; // the tangent of its longitude
    const double wall = std::atan(wall_u);
    for (const double top_m : {300.0, 2000.0, 8000.0})
        for (const double sun_degrees : {-50.0, -70.0, -78.0}) {
            const MadeGround ground(kBall, {0.0F, static_cast<float>(top_m)}, [&](const Vector3& direction) {
                return std::abs(direction.y / direction.x - wall_u) < step / 2.0 ? top_m : 0.0;
            });
            const PlanetRays rays(ground.at_level(level), at_longitude(sun_degrees));
            const double sun = sun_degrees * kDegree;
            const double top_rho_m = (kRadius_m + top_m) * std::sin(wall - sun);
            ASSERT_LT(top_rho_m, kRadius_m);
            const double end = std::asin(top_rho_m / kRadius_m) + sun;
            const double slack = 1.0 / kRadius_m + 8.0 * sag_m(level) / top_m * (end - wall);
            EXPECT_TRUE(rays.is_lit(at_longitude((end + slack) / kDegree), 0.0))
                << top_m << ' ' << sun_degrees;
            EXPECT_FALSE(rays.is_lit(at_longitude((end - slack) / kDegree), 0.0))
                << top_m << ' ' << sun_degrees;
            const double halfway = (wall + end) / 2.0;
            EXPECT_NEAR(rays.shadow_height_m(at_longitude(halfway / kDegree)),
                        top_rho_m / std::sin(halfway - sun) - kRadius_m, 1e-6);
        }
}

TEST(PlanetRay, LightsAPeakAtNightAsFarAsItsHorizonDips)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const Vector3 sun = at_longitude(-60.0);
    const PlanetRays rays(ground.at_level(8), sun);
    const double height_m = 4200.0;
    const double dip = std::acos(kRadius_m / (kRadius_m + height_m)); // 2.08 degrees
    const double sunset = 30.0 + dip / kDegree;
    EXPECT_NEAR(dip / kDegree, 2.08, 0.005);
    EXPECT_TRUE(rays.is_lit(at_longitude(sunset - 0.01), height_m));
    EXPECT_FALSE(rays.is_lit(at_longitude(sunset + 0.01), height_m));
    EXPECT_TRUE(rays.is_lit(at_longitude(sunset), height_m + 10.0));
    EXPECT_FALSE(rays.is_lit(at_longitude(sunset), height_m - 10.0));
}

TEST(PlanetRay, SeesTheEdgesOfTheSunsDiscBeyondAndBeforeTheTerminator)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const Vector3 sun = at_longitude(-60.0);
    for (const double raised : {0.2666, -0.2666, 0.0}) {
        const PlanetRays rays(ground.at_level(9), sun, Angle::from_degrees(raised));
        for (const double south : {0.0, 0.01}) { // on the equator and beside
            const auto at = [&](double degrees) { return at_longitude(degrees) - Vector3{0.0, 0.0, south}; };
            EXPECT_TRUE(rays.is_lit(at(30.0 + raised - 0.01), 0.0)) << raised;
            EXPECT_FALSE(rays.is_lit(at(30.0 + raised + 0.01), 0.0)) << raised;
        }
        EXPECT_TRUE(rays.is_lit(at_longitude(-60.1), 0.0));
        EXPECT_FALSE(rays.is_lit(at_longitude(120.1), 1e6));
    }
    EXPECT_THROW(PlanetRays(ground.at_level(0), sun, Angle::from_degrees(7.0)), InvalidInput);
    EXPECT_THROW(PlanetRays(ground.at_level(0), {0.0, 0.0, 0.0}), InvalidInput);
}

TEST(PlanetRay, OnAnEllipsoidEndsTheDayWhereItsNormalIsAcrossTheLight)
{
    const MadeGround ground(kWgs84, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    const Vector3 sun = normalized({0.5, 0.2, 0.6});
    const LightAxis axis = light_axis(sun);
    const PlanetRays rays(ground.at_level(8), sun);
    for (int turn = 0; turn < 12; ++turn) {
        const Vector3 outward = outward_at(axis, turn / 12.0 + 0.03);
        // Within the half-plane the section is widest where its tangent is along the light.
        const auto height_over_tangent = [&](double theta) {
            const Vector3 direction = sun * std::cos(theta) + outward * std::sin(theta);
            return base_radius_m(kWgs84, direction) * std::sin(theta);
        };
        double widest = 1.5;
        for (double theta = 1.5; theta < 1.64; theta += 1e-5)
            widest = height_over_tangent(theta) > height_over_tangent(widest) ? theta : widest;
        const auto at = [&](double theta) { return sun * std::cos(theta) + outward * std::sin(theta); };
        EXPECT_TRUE(rays.is_lit(at(widest - 2e-3), 0.0));
        EXPECT_FALSE(rays.is_lit(at(widest + 2e-3), 0.0));
    }
}

TEST(PlanetRay, AgreesWithARayThatGoesOnOverTheEdgesAndCornersOfTheCube)
{
    // Hills all over, and every quantity asked in frames that differ by turns of the cube: the grids coincide, the faces do not.
    const auto hills = [](const Vector3& d) {
        return 3000.0 * (std::sin(11.0 * d.x) * std::cos(13.0 * d.y) + std::sin(17.0 * d.z + d.x));
    };
    const auto turned = [](const Vector3& d) { return Vector3{d.y, d.z, d.x}; };
    const HeightRange range = {-6000.0F, 6000.0F};
    const MadeGround ground(kBall, range, hills);
    const MadeGround other(kBall, range, [&](const Vector3& d) { return hills(turned(d)); });
    // other's height in d is that of ground in turned(d).
    const Vector3 sun = normalized({0.9, -0.3, 0.7});
    const PlanetRays rays(ground.at_level(2), turned(sun));
    const PlanetRays other_rays(other.at_level(2), sun);
    for (int i = 0; i < 500; ++i) {
        const Vector3 place = normalized({std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1.0)});
        const double shadow_m = other_rays.shadow_height_m(place);
        EXPECT_NEAR(rays.shadow_height_m(turned(place)), shadow_m, 1e-6 + 1e-9 * std::abs(shadow_m));
    }
}

TEST(PlanetRay, IsRayOnACurvedRasterButForCellsBesideShadowEdges)
{
    const MountainsOnABall scene(kRadius_m);
    const Terrain curved = scene.curved_raster();
    for (const double altitude : {2.0, 20.0}) {
        const DirectionalLight light{Angle::from_degrees(203.0), Angle::from_degrees(altitude)};
        const Vector3 local = direction_towards(light); // east, north, up
        const PlanetRays rays(scene.ground().at_level(MountainsOnABall::kLevel), {local.z, local.x, local.y});
        const ShadowMask expected = cast_by_ray(curved, light);
        const ShadowMask mask = scene.mask_by(
            [&](const Vector3& place, double height_m) { return rays.is_lit(place, height_m); });
        const MaskDifference difference = mask_difference(expected, mask);
        EXPECT_LT(difference.differing, difference.cells / 2000) << altitude; // 2 and 29 of 65025
        EXPECT_LE(difference.farthest_from_edge.value_or(kNowhere), 1U) << altitude;
    }
}

} // namespace
} // namespace duskline
