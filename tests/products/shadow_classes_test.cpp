#include <duskline/casting/ray.h>
#include <duskline/products/shadow_classes.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(ShadowClasses, AConeShadesItselfInASectorAndCastsTheRestOnThePlain)
{
    // Side 45 degrees, sun 30: the cone's own shadow is the sector within 54.7356 degrees of the far side.
    const Terrain cone =
        make_cone({.grid = {.rows = 201, .columns = 201}, .height_m = 50.0, .slope = 45_deg});
    const DirectionalLight light{.azimuth = 200_deg, .altitude = 30_deg};
    const ShadowClasses classes = shadow_classes(cone, cast_by_ray(cone, light), light);
    std::size_t seen[3] = {};
    for (std::size_t row = 0; row < 201; ++row)
        for (std::size_t column = 0; column < 201; ++column) {
            const double x = static_cast<double>(column) - 100.0;
            const double y = 100.0 - static_cast<double>(row);
            const double distance = std::hypot(x, y);
            const double from_far_side =
                std::abs(std::remainder(std::atan2(x, y) * 180.0 / std::numbers::pi - 20.0, 360.0));
            const ShadowClass got = classes(row, column);
            ++seen[static_cast<std::size_t>(got)];
            const bool on_side = distance > 8.0 && distance < 48.0 && std::abs(from_far_side - 54.7356) > 6.0;
            if (on_side) {
                EXPECT_EQ(got, from_far_side < 54.7356 ? ShadowClass::self_shaded : ShadowClass::lit)
                    << row << ' ' << column;
            }
            if (distance > 52.0) {
                EXPECT_NE(got, ShadowClass::self_shaded) << row << ' ' << column;
            }
            if (distance > 52.0 && distance < 78.0 && from_far_side < 2.0) {
                EXPECT_EQ(got, ShadowClass::cast) << row << ' ' << column;
            }
        }
    EXPECT_GT(seen[1], 1000U);
    EXPECT_GT(seen[2], 1000U);
}

TEST(ShadowClasses, NoDataStaysUnknown)
{
    Terrain terrain = make_plane({.grid = {.rows = 5, .columns = 5}});
    terrain.heights_m(2, 2) = std::numeric_limits<float>::quiet_NaN();
    const DirectionalLight light{.azimuth = 10_deg, .altitude = 30_deg};
    const ShadowClasses classes = shadow_classes(terrain, cast_by_ray(terrain, light), light);
    EXPECT_EQ(classes(2, 2), ShadowClass::unknown);
    EXPECT_EQ(classes(2, 3), ShadowClass::lit);
}

TEST(ShadowClasses, AtNightLevelGroundShadesItselfAndACliffTowardsTheLightDoesNot)
{
    const Terrain slope = make_plane({.grid = {.rows = 9, .columns = 9}, .slope = 60_deg, .aspect = 90_deg});
    const Terrain level = make_plane({.grid = {.rows = 9, .columns = 9}});
    for (const Angle altitude : {0_deg, Angle::from_degrees(-20.0)}) {
        const DirectionalLight light{.azimuth = 90_deg, .altitude = altitude};
        EXPECT_EQ(shadow_classes(level, cast_by_ray(level, light), light)(4, 4), ShadowClass::self_shaded);
        EXPECT_EQ(shadow_classes(slope, cast_by_ray(slope, light), light)(4, 4), ShadowClass::cast);
    }
}

TEST(ShadowClasses, AMaskOfAnotherSizeIsRefused)
{
    const Terrain level = make_plane({.grid = {.rows = 9, .columns = 9}});
    EXPECT_THROW(shadow_classes(level, ShadowMask(9, 8, Lit::yes), {}), InvalidInput);
}

} // namespace
} // namespace duskline
