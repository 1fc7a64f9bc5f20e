#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>
#include <duskline/view/camera.h>
#include <duskline/view/frustum.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

struct InPicture {
    double right;
    double up;
    double ahead;
};

// Where a place is seen: -1 to 1 over the picture.
InPicture projected(const Camera& camera, double aspect, const Vector3& place_m)
{
    const Matrix4 m = eye_to_clip(camera, aspect, {1.0, 1e6});
    const Vector3 r = place_m - camera.position_m;
    const auto row = [&](std::size_t i) {
        return m.at(i) * r.x + m.at(i + 4) * r.y + m.at(i + 8) * r.z + m.at(i + 12);
    };
    return {row(0) / row(3), row(1) / row(3), row(3)};
}

Terrain mountains(std::size_t rows, std::size_t columns, double cell_size_m)
{
    return make_mountains(
        {.grid = {.rows = rows, .columns = columns, .cell_size_m = {cell_size_m, cell_size_m}}});
}

TEST(Camera, LooksNorthWithTheEastToTheRight)
{
    const Camera camera{{100.0, -200.0, 50.0}, 0_deg, 0_deg, 90_deg};
    const InPicture east = projected(camera, 1.0, {110.0, -190.0, 50.0});
    EXPECT_NEAR(east.right, 1.0, 1e-6);
    EXPECT_NEAR(east.up, 0.0, 1e-6);
    EXPECT_NEAR(east.ahead, 10.0, 1e-6);
    EXPECT_NEAR(projected(camera, 1.0, {100.0, -180.0, 60.0}).up, 0.5, 1e-6);
    EXPECT_NEAR(projected(camera, 2.0, {110.0, -190.0, 50.0}).right, 0.5, 1e-6);
}

TEST(Camera, HeadingTurnsClockwiseAndPitchUpwards)
{
    const Vector3 east = axes_of({{}, 90_deg, 0_deg}).forward;
    EXPECT_DOUBLE_EQ(east.x, 1.0);
    EXPECT_DOUBLE_EQ(east.y, 0.0);
    EXPECT_DOUBLE_EQ(axes_of({{}, 30_deg, 90_deg}).forward.z, 1.0);
    EXPECT_DOUBLE_EQ(axes_of({{}, 0_deg, 90_deg}).up.y, -1.0);
}

TEST(Camera, OrbitKeepsThePivotWhereItIsInThePicture)
{
    const Camera camera{{1000.0, -5000.0, 900.0}, 20_deg, Angle::from_degrees(-25.0)};
    const Vector3 pivot = {2500.0, -2000.0, 100.0};
    const Camera other = orbited(camera, pivot, 70_deg, 10_deg);
    const InPicture before = projected(camera, 1.5, pivot);
    const InPicture after = projected(other, 1.5, pivot);
    EXPECT_NEAR(before.right, after.right, 1e-5);
    EXPECT_NEAR(before.up, after.up, 1e-5);
    EXPECT_NEAR(length(camera.position_m - pivot), length(other.position_m - pivot), 1e-6);
    EXPECT_DOUBLE_EQ(other.heading.degrees(), 90.0);
}

TEST(Camera, NeverTipsOver)
{
    EXPECT_LT(turned({}, 0_deg, 500_deg).pitch.degrees(), 90.0);
    EXPECT_GT(turned({}, 0_deg, Angle::from_degrees(-500.0)).pitch.degrees(), -90.0);
}

TEST(Camera, ApproachesAPlaceInAStraightLine)
{
    const Camera camera{{0.0, 0.0, 100.0}};
    EXPECT_DOUBLE_EQ(approached(camera, {0.0, 0.0, 20.0}, 0.5).position_m.z, 60.0);
}

TEST(Camera, StaysAboveTheGroundAndAboveItsBorderBeyondIt)
{
    const Terrain hill =
        make_gaussian_hill({.grid = {.rows = 65, .columns = 65}, .height_m = 50.0, .sigma_m = 10.0});
    const Camera inside = kept_above_ground({{32.0, -32.0, 10.0}}, hill, 2.0);
    EXPECT_NEAR(inside.position_m.z, 52.0, 1e-3);
    const double border_m = static_cast<double>(hill.heights_m(32, 64));
    EXPECT_NEAR(kept_above_ground({{500.0, -32.0, -10.0}}, hill, 2.0).position_m.z, border_m + 2.0, 1e-6);
    EXPECT_DOUBLE_EQ(kept_above_ground({{32.0, -32.0, 90.0}}, hill, 2.0).position_m.z, 90.0);
}

TEST(Camera, PicksTheGroundUnderThePointer)
{
    const Terrain terrain = mountains(200, 300, 20.0);
    const Camera camera = overview(terrain, 1.5);
    for (const double right : {-0.3, 0.0, 0.25}) {
        const Vector3 place = picked_m(camera, 1.5, right, 0.1, terrain);
        const GridPoint at = grid_point(place, terrain.cell_size_m);
        const auto ground = ground_height_m(terrain, at.row, at.column);
        ASSERT_TRUE(ground.has_value());
        EXPECT_NEAR(place.z, *ground, 40.0);
        EXPECT_NEAR(projected(camera, 1.5, place).right, right, 1e-4);
        EXPECT_NEAR(projected(camera, 1.5, place).up, 0.1, 1e-4);
    }
}

TEST(Camera, OverviewSeesTheWholeTerrain)
{
    for (const auto& [rows, columns] : {std::pair{64, 64}, {40, 400}, {400, 40}})
        for (const double aspect : {0.6, 1.0, 1.78}) {
            const Terrain terrain =
                mountains(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), 30.0);
            const Camera camera = overview(terrain, aspect);
            for (const int row : {0, rows - 1})
                for (const int column : {0, columns - 1}) {
                    const float height_m =
                        terrain.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
                    const GridPoint corner = {static_cast<double>(row), static_cast<double>(column),
                                              static_cast<double>(height_m)};
                    const InPicture seen = projected(camera, aspect, position_m(corner, terrain.cell_size_m));
                    EXPECT_GT(seen.ahead, 0.0);
                    EXPECT_LT(std::abs(seen.right), 1.0) << rows << " x " << columns << ", " << aspect;
                    EXPECT_LT(std::abs(seen.up), 1.0) << rows << " x " << columns << ", " << aspect;
                }
        }
}

TEST(Camera, NothingOfTheTerrainIsBeforeOrBehindItsDepths)
{
    const Terrain terrain = mountains(120, 120, 25.0);
    const HeightRange heights = height_range(terrain);
    for (const double z : {4000.0, 2600.0}) {
        const Camera camera{{1500.0, -1500.0, z}, 40_deg, Angle::from_degrees(-30.0)};
        const DepthRange depth = depth_range(camera, terrain, heights);
        for (std::size_t row = 0; row < 120; ++row)
            for (std::size_t column = 0; column < 120; ++column) {
                const GridPoint at = {static_cast<double>(row), static_cast<double>(column),
                                      static_cast<double>(terrain.heights_m(row, column))};
                const double away_m = length(position_m(at, terrain.cell_size_m) - camera.position_m);
                ASSERT_GT(away_m, depth.nearest_m);
                ASSERT_LT(away_m, depth.farthest_m);
            }
    }
}

TEST(Frustum, SeesWhatIsAheadAndNothingBehindOrBeside)
{
    const Frustum frustum({{0.0, 0.0, 0.0}, 0_deg, 0_deg, 60_deg}, 1.0, 1.0);
    EXPECT_TRUE(frustum.may_see({{-1.0, 10.0, -1.0}, {1.0, 12.0, 1.0}}));
    EXPECT_TRUE(frustum.may_see({{-100.0, -100.0, -100.0}, {100.0, 100.0, 100.0}}));
    EXPECT_FALSE(frustum.may_see({{-1.0, -12.0, -1.0}, {1.0, -10.0, 1.0}}));
    EXPECT_FALSE(frustum.may_see({{20.0, 10.0, -1.0}, {22.0, 12.0, 1.0}}));
    EXPECT_FALSE(frustum.may_see({{-22.0, 10.0, -1.0}, {-20.0, 12.0, 1.0}}));
    EXPECT_FALSE(frustum.may_see({{-1.0, 10.0, 20.0}, {1.0, 12.0, 22.0}}));
    EXPECT_FALSE(frustum.may_see({{-1.0, 10.0, -22.0}, {1.0, 12.0, -20.0}}));
}

TEST(Frustum, BoxesAreAsFarAsTheirNearestPoint)
{
    const Box box{{0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}};
    EXPECT_DOUBLE_EQ(distance_m({1.0, 1.0, 1.0}, box), 0.0);
    EXPECT_DOUBLE_EQ(distance_m({1.0, 1.0, 7.0}, box), 5.0);
    EXPECT_DOUBLE_EQ(distance_m({-3.0, 6.0, 1.0}, box), 5.0);
}

} // namespace
} // namespace duskline
