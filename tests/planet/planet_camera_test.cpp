#include "hilly_planet.h"
#include "vectors_near.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/planet/planet_camera.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(PlanetCamera, LooksByTheCompassOfThePlaceBelow)
{
    PlanetCamera camera = camera_over(kWgs84, {0_deg, 0_deg}, 1000.0);
    expect_near(axes_of(kWgs84, camera).forward, {0.0, 0.0, 1.0}, 1e-15); // north
    expect_near(axes_of(kWgs84, camera).right, {0.0, 1.0, 0.0}, 1e-15);   // east
    camera.heading = 90_deg;
    expect_near(axes_of(kWgs84, camera).forward, {0.0, 1.0, 0.0}, 1e-15);
    camera.pitch = Angle::from_degrees(-90.0);
    expect_near(axes_of(kWgs84, camera).forward, {-1.0, 0.0, 0.0}, 1e-15); // down
    expect_near(axes_of(kWgs84, camera).up, {0.0, 1.0, 0.0}, 1e-15);       // the heading
}

TEST(PlanetCamera, FliesAlongGreatCirclesAndComesBackRound)
{
    const Globe globe = sphere_of_radius(1000.0);
    PlanetCamera camera = camera_over(globe, {20_deg, 30_deg}, 10.0);
    camera.heading = 50_deg;
    const PlanetCamera start = camera;
    const Vector3 axis = normalized(cross(camera.eye_m, axes_of(globe, camera).forward));
    constexpr int steps = 360;
    const double step_m = 2.0 * M_PI * 1010.0 / steps;
    for (int i = 0; i < steps; ++i) {
        camera = flown(globe, camera, 0.0, step_m, 0.0);
        EXPECT_NEAR(dot(normalized(camera.eye_m), axis), 0.0, 1e-9);
        EXPECT_NEAR(height_m(globe, camera.eye_m), 10.0, 1e-6);
        EXPECT_NEAR(dot(axes_of(globe, camera).forward, axis), 0.0, 1e-9);
    }
    expect_near(camera.eye_m, start.eye_m, 1e-6);
    EXPECT_NEAR(camera.heading.degrees(), start.heading.degrees(), 1e-6);
}

TEST(PlanetCamera, FliesUpAndSidewaysAndTurns)
{
    const PlanetCamera camera = camera_over(kWgs84, {20_deg, 30_deg}, 10.0);
    EXPECT_NEAR(height_m(kWgs84, flown(kWgs84, camera, 0.0, 0.0, 90.0).eye_m), 100.0, 1e-7);
    const PlanetCamera aside = flown(kWgs84, camera, 5.0, 0.0, 0.0);
    EXPECT_NEAR(dot(aside.eye_m - camera.eye_m, axes_of(kWgs84, camera).right), 5.0, 1e-4);
    const PlanetCamera looking = turned(camera, -30_deg, Angle::from_degrees(-120.0));
    EXPECT_DOUBLE_EQ(looking.heading.degrees(), 330.0);
    EXPECT_DOUBLE_EQ(looking.pitch.degrees(), -90.0);
}

TEST(PlanetCamera, StaysAboveGround)
{
    const PlanetTerrain terrain = small_planet();
    for (double longitude = 0.0; longitude < 360.0; longitude += 17.0) {
        const PlanetCamera camera =
            camera_over(terrain.globe(), {Angle::from_degrees(longitude), 10_deg}, -30.0);
        const PlanetCamera lifted = kept_above_ground(camera, terrain, 2.0);
        EXPECT_NEAR(clearance_m(lifted, terrain), 2.0, 1e-6);
        const PlanetCamera high = flown(terrain.globe(), lifted, 0.0, 0.0, 100.0);
        EXPECT_EQ(length(kept_above_ground(high, terrain, 2.0).eye_m - high.eye_m), 0.0);
    }
}

TEST(PlanetFrustum, SeesWhatProjectsIntoThePicture)
{
    PlanetCamera camera = camera_over(kWgs84, {10_deg, 40_deg}, 3e6);
    camera.pitch = Angle::from_degrees(-70.0);
    camera.heading = 30_deg;
    const PlanetFrustum frustum(kWgs84, camera, 2.0);
    const auto [forward, right, up] = axes_of(kWgs84, camera);
    const double half_height = std::tan(camera.vertical_view.radians() / 2.0);
    for (double across = -2.0; across <= 2.0; across += 0.25)
        for (double along = -2.0; along <= 2.0; along += 0.25) {
            const Vector3 ray = forward + right * (across * 2.0 * half_height) + up * (along * half_height);
            const OrientedBox point = {
                camera.eye_m + ray * 1e6, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}, {}};
            const OrientedBox behind = {camera.eye_m - ray * 1e6, point.axes, {}};
            if (std::abs(across) != 1.0 && std::abs(along) != 1.0) {
                EXPECT_EQ(frustum.may_see(point), std::abs(across) < 1.0 && std::abs(along) < 1.0);
            }
            EXPECT_FALSE(frustum.may_see(behind));
        }
}

} // namespace
} // namespace duskline
