#include "hilly_planet.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_flight.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(FlyDown, FallsFromSpaceToTheGroundAndLooksUpOnTheWay)
{
    const PlanetTerrain terrain = small_planet();
    const FlyDown flight = {.place = {30_deg, 20_deg},
                            .from_m = 1e5,
                            .to_m = 2.0,
                            .heading = 70_deg,
                            .last_pitch = Angle::from_degrees(-5.0)};
    double above_m = 2e5;
    double pitch = -90.0;
    for (int frame = 0; frame <= 100; ++frame) {
        const PlanetCamera camera = fly_down(terrain, flight, frame / 100.0);
        EXPECT_LT(clearance_m(camera, terrain), above_m + 1e-6);
        EXPECT_GE(camera.pitch.degrees(), pitch - 1e-9);
        EXPECT_EQ(camera.heading.degrees(), 70.0);
        above_m = clearance_m(camera, terrain);
        pitch = camera.pitch.degrees();
    }
    EXPECT_NEAR(clearance_m(fly_down(terrain, flight, 0.0), terrain), 1e5, 1e-6);
    EXPECT_NEAR(fly_down(terrain, flight, 0.0).pitch.degrees(), -90.0, 1e-9);
    EXPECT_NEAR(above_m, 2.0, 1e-6);
    EXPECT_NEAR(pitch, -5.0, 1e-9);
    // Half way in time is half way in scale.
    EXPECT_NEAR(clearance_m(fly_down(terrain, flight, 0.5), terrain), std::sqrt(1e5 * 2.0), 1e-6);
}

TEST(FlyDown, RefusesHeightsThatDoNotFall)
{
    const PlanetTerrain terrain = small_planet();
    EXPECT_THROW(fly_down(terrain, {.place = {}, .from_m = 1.0, .to_m = 2.0}, 0.0), InvalidInput);
    EXPECT_THROW(fly_down(terrain, {.place = {}, .from_m = 10.0, .to_m = 0.0}, 0.0), InvalidInput);
}

TEST(FlightBetween, BeginsAndEndsWithItsCamerasAndNeverTouchesGround)
{
    const PlanetTerrain terrain = small_planet();
    PlanetCamera from = camera_over(terrain.globe(), {-100_deg, 60_deg}, 40000.0);
    from.heading = 350_deg;
    from.pitch = Angle::from_degrees(-80.0);
    PlanetCamera to =
        kept_above_ground(camera_over(terrain.globe(), {80_deg, -30_deg}, -500.0), terrain, 5.0);
    to.heading = 20_deg;
    EXPECT_LT(length(between(terrain, from, to, 2.0, 0.0).eye_m - from.eye_m), 1e-6);
    EXPECT_LT(length(between(terrain, from, to, 2.0, 1.0).eye_m - to.eye_m), 1e-6);
    EXPECT_NEAR(between(terrain, from, to, 2.0, 1.0).heading.degrees(), 20.0, 1e-9);
    EXPECT_NEAR(between(terrain, from, to, 2.0, 0.5).heading.degrees(), 5.0, 1e-9);
    Vector3 before = from.eye_m;
    for (int frame = 1; frame <= 200; ++frame) {
        const PlanetCamera camera = between(terrain, from, to, 2.0, frame / 200.0);
        EXPECT_GT(clearance_m(camera, terrain), 2.0 - 1e-6);
        EXPECT_LT(length(camera.eye_m - before), 3000.0); // of 150 km and more
        before = camera.eye_m;
    }
}

TEST(FlightBetween, FindsAWayToTheOtherSideOfThePlanet)
{
    const PlanetTerrain terrain(sphere_of_radius(1000.0), {}, {.finest_spacing_m = 10.0});
    const PlanetCamera from = camera_over(terrain.globe(), {0_deg, 0_deg}, 50.0);
    const PlanetCamera to = camera_over(terrain.globe(), {180_deg, 0_deg}, 50.0);
    EXPECT_NEAR(height_m(terrain.globe(), between(terrain, from, to, 1.0, 0.3).eye_m), 50.0, 1e-6);
    EXPECT_LT(length(between(terrain, from, to, 1.0, 1.0).eye_m - to.eye_m), 1e-6);
}

} // namespace
} // namespace duskline
