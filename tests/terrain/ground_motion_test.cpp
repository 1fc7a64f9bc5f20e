#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/ground_motion.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duskline {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr auto kNaN = std::numeric_limits<float>::quiet_NaN();

Terrain ground_at_rest()
{
    Terrain terrain = make_mountains(
        {.grid = {.rows = 70, .columns = 110, .cell_size_m = {30.0, 40.0}}, .feature_m = 900.0});
    terrain.heights_m(34, 60) = kNaN;
    return terrain;
}

bool same_height(float a, float b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Whether two grids differ in a rectangle only.
testing::AssertionResult same_outside(const CellRectangle& inside, GridView<const float> a,
                                      GridView<const float> b)
{
    for (std::size_t row = 0; row < a.rows(); ++row)
        for (std::size_t column = 0; column < a.columns(); ++column)
            if (!(row - inside.first_row < inside.rows && column - inside.first_column < inside.columns)
                && !same_height(a(row, column), b(row, column)))
                return testing::AssertionFailure() << "(" << row << ", " << column << ")";
    return testing::AssertionSuccess();
}

Grid<float> moved_to(const GroundMotion& motion, const HeightField& at_rest, double seconds)
{
    Grid<float> heights_m(at_rest.rows(), at_rest.columns());
    for (std::size_t row = 0; row < at_rest.rows(); ++row)
        std::ranges::copy(at_rest.heights_m.row(row), heights_m.row(row).begin());
    move_ground(motion, at_rest, 0.0, seconds, heights_m.view());
    return heights_m;
}

TEST(GroundMotion, IsAtRestWhenAPeriodIsOverAndNotInBetween)
{
    const Terrain at_rest = ground_at_rest();
    for (const GroundMotionKind& kind : ground_motions()) {
        const auto motion = kind.make(at_rest, {});
        EXPECT_EQ(motion->reach(0.0).rows, 0U) << kind.name;
        EXPECT_TRUE(same_outside({}, moved_to(*motion, at_rest, 3.0 * kind.period_s).view(),
                                 at_rest.heights_m.view()))
            << kind.name;
        EXPECT_FALSE(same_outside({}, moved_to(*motion, at_rest, 0.4 * kind.period_s).view(),
                                  at_rest.heights_m.view()))
            << kind.name;
        EXPECT_TRUE(same_outside({}, moved_to(*motion, at_rest, 0.4 * kind.period_s - kind.period_s).view(),
                                 moved_to(*motion, at_rest, 0.4 * kind.period_s).view()))
            << kind.name;
    }
}

// From any time to any other it comes to the same heights, and says which cells may have changed on the way.
TEST(GroundMotion, DependsOnTheGroundAtRestAndOnTimeAlone)
{
    const Terrain at_rest = ground_at_rest();
    for (const GroundMotionKind& kind : ground_motions()) {
        const auto motion = kind.make(at_rest, {});
        Grid<float> heights_m = at_rest.heights_m.copy();
        double before_s = 0.0;
        for (const double share : {0.05, 0.3, 0.33, 0.7, 0.1, 0.95, 1.0, 1.2, -0.6}) {
            const double now_s = share * kind.period_s;
            const Grid<float> before_m = heights_m.copy();
            const CellRectangle changed = move_ground(*motion, at_rest, before_s, now_s, heights_m.view(),
                                                      {.threads = share > 0.5 ? std::size_t{1} : 0});
            EXPECT_TRUE(same_outside(changed, before_m.view(), heights_m.view())) << kind.name << share;
            EXPECT_TRUE(same_outside({}, moved_to(*motion, at_rest, now_s).view(), heights_m.view()))
                << kind.name << share;
            before_s = now_s;
        }
    }
}

TEST(GroundMotion, LeavesNoDataAlone)
{
    const Terrain at_rest = ground_at_rest();
    for (const GroundMotionKind& kind : ground_motions()) {
        const auto motion = kind.make(at_rest, {});
        for (const double share : {0.2, 0.5, 0.8}) {
            const Grid<float> heights_m = moved_to(*motion, at_rest, share * kind.period_s);
            EXPECT_EQ(std::ranges::count_if(heights_m.values(), [](float h) { return std::isnan(h); }), 1);
            EXPECT_TRUE(std::isnan(heights_m(34, 60)));
        }
    }
}

TEST(GroundMotion, OfACraterStaysAroundIt)
{
    const Terrain plane = make_plane({.grid = {.rows = 201, .columns = 301, .cell_size_m = {10.0, 10.0}}});
    const auto motion = ground_motion_named("crater").make(plane, {});
    const CellRectangle small = motion->reach(2.0);
    const CellRectangle large = motion->reach(12.0);
    EXPECT_LT(small.rows, large.rows);
    EXPECT_LT(large.rows, 201U);
    EXPECT_LT(large.columns, 301U);
    const Grid<float> heights_m = moved_to(*motion, plane, 12.0);
    // The shorter side is 2010 m, the radius 0.12 of it; the floor lies 0.32 of that below the ground, the rim 0.08 above.
    const double radius_m = 0.12 * 2010.0;
    EXPECT_NEAR(heights_m(100, 150), -0.32 * radius_m, 0.01);
    EXPECT_NEAR(std::ranges::max(heights_m.values()), 0.08 * radius_m, 0.03 * radius_m);
    EXPECT_EQ(heights_m(100, 150 + 75), 0.0f); // 750 m away, beyond three radii
}

TEST(GroundMotion, OfALandscapeIsOtherMountainsHalfway)
{
    const Terrain at_rest = ground_at_rest();
    const auto motion = ground_motion_named("landscape").make(at_rest, {});
    const Grid<float> heights_m = moved_to(*motion, at_rest, 10.0);
    double sum_m = 0.0;
    for (std::size_t i = 0; i < heights_m.size(); ++i)
        if (!std::isnan(heights_m.values()[i]))
            sum_m += std::abs(static_cast<double>(heights_m.values()[i] - at_rest.heights_m.values()[i]));
    EXPECT_GT(sum_m / static_cast<double>(heights_m.size()), 100.0);
}

TEST(GroundMotion, TakesAnyGround)
{
    for (const GroundMotionKind& kind : ground_motions())
        for (const auto& [rows, columns] : {std::pair{0, 0}, {1, 1}, {1, 40}, {2, 3}}) {
            Terrain terrain{
                Grid<float>(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), kNaN),
                {5.0, 9.0}};
            const auto motion = kind.make(terrain, {});
            const Terrain at_rest{terrain.heights_m.copy(), terrain.cell_size_m};
            EXPECT_NO_THROW(move_ground(*motion, at_rest, 0.0, 5.0, terrain.heights_m.view())) << kind.name;
        }
}

TEST(GroundMotion, RefusesWhatIsOutOfRange)
{
    const Terrain at_rest = ground_at_rest();
    const auto motion = ground_motions().front().make(at_rest, {});
    Grid<float> heights_m = at_rest.heights_m.copy();
    EXPECT_THROW(
        move_ground(*motion, at_rest, 0.0, std::numeric_limits<double>::infinity(), heights_m.view()),
        InvalidInput);
    Grid<float> smaller_m(70, 109);
    EXPECT_THROW(move_ground(*motion, at_rest, 0.0, 1.0, smaller_m.view()), InvalidInput);
    EXPECT_THAT([] { ground_motion_named("jelly"); },
                ThrowsMessage<InvalidInput>(HasSubstr("there are: crater, waves, landscape")));
}

} // namespace
} // namespace duskline
