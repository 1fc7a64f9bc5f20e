#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/synthetic_terrain.h>
#include <duskline/view/camera_path.h>

#include <gtest/gtest.h>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(CameraPath, GoesThroughItsPoses)
{
    CameraPath path;
    for (const double x : {0.0, 10.0, 50.0, 20.0, 5.0})
        path.poses.push_back({{x, 2.0 * x, 3.0}, Angle::from_degrees(x), Angle::from_degrees(-x)});
    for (std::size_t i = 0; i < path.poses.size(); ++i) {
        const Camera camera = pose_at(path, static_cast<double>(i) / 4.0);
        EXPECT_NEAR(camera.position_m.x, path.poses[i].position_m.x, 1e-12);
        EXPECT_NEAR(camera.heading.degrees(), path.poses[i].heading.degrees(), 1e-12);
        EXPECT_NEAR(camera.pitch.degrees(), path.poses[i].pitch.degrees(), 1e-12);
    }
}

TEST(CameraPath, MovesEvenlyBetweenEvenPoses)
{
    CameraPath path;
    for (const double x : {0.0, 10.0, 20.0, 30.0})
        path.poses.push_back({{x, 0.0, 0.0}});
    EXPECT_NEAR(pose_at(path, 0.5).position_m.x, 15.0, 1e-12);
    EXPECT_NEAR(pose_at(path, 0.4).position_m.x, 12.0, 1e-12);
}

TEST(CameraPath, TurnsTheShortWayRound)
{
    const CameraPath path{{{{}, 350_deg}, {{}, 10_deg}}};
    const double heading_deg = pose_at(path, 0.5).heading.degrees();
    EXPECT_NEAR(std::remainder(heading_deg, 360.0), 0.0, 1e-9);
}

TEST(CameraPath, OfOnePoseStandsStillAndOfNoneIsRefused)
{
    EXPECT_EQ(pose_at({{{{1.0, 2.0, 3.0}}}}, 0.7).position_m.y, 2.0);
    EXPECT_THROW(pose_at({}, 0.0), InvalidInput);
}

TEST(CameraPath, UsualFlightEndsWhereItBeganAndComesDownToTheGround)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 300, .columns = 400, .cell_size_m = {30.0, 30.0}}});
    const CameraPath path = usual_flight(terrain, 1.33);
    EXPECT_NEAR(pose_at(path, 0.0).position_m.x, pose_at(path, 1.0).position_m.x, 1e-6);
    double lowest_m = 1e9;
    for (int i = 0; i <= 960; ++i)
        lowest_m = std::min(lowest_m, clearance_m(pose_at(path, i / 960.0).position_m, terrain));
    EXPECT_LT(lowest_m, 400.0);
    EXPECT_GT(lowest_m, 20.0);
}

} // namespace
} // namespace duskline
