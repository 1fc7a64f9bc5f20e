#include <duskline/casting/shadow_mask.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace duskline {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(ShadowMask, AShadowHeightIsNeverRoundedDown)
{
    EXPECT_EQ(shadow_height_as_float(100.0), 100.0f);
    EXPECT_EQ(shadow_height_as_float(std::nextafter(100.0, 101.0)), std::nextafter(100.0f, 101.0f));
    EXPECT_EQ(shadow_height_as_float(std::nextafter(100.0, 99.0)), 100.0f);
    EXPECT_EQ(shadow_height_as_float(std::nextafter(-100.0, 0.0)), std::nextafter(-100.0f, 0.0f));
    EXPECT_EQ(shadow_height_as_float(1e-300), std::numeric_limits<float>::denorm_min());
    EXPECT_EQ(shadow_height_as_float(-1e300), std::numeric_limits<float>::lowest());
    EXPECT_EQ(shadow_height_as_float(1e300), kInfinity);
    EXPECT_EQ(shadow_height_as_float(std::numeric_limits<double>::infinity()), kInfinity);
    EXPECT_EQ(shadow_height_as_float(-std::numeric_limits<double>::infinity()), -kInfinity);
}

TEST(ShadowMask, GroundAtTheShadowHeightIsLitAndNoDataIsUnknown)
{
    Terrain terrain{Grid<float>(1, 4, 5.0f), {1.0, 1.0}};
    terrain.heights_m(0, 3) = std::numeric_limits<float>::quiet_NaN();
    ShadowField shadows(1, 4, 5.0f);
    shadows(0, 1) = std::nextafter(5.0f, 6.0f);
    shadows(0, 2) = -kInfinity;
    const ShadowMask mask = mask_of(terrain, shadows);
    EXPECT_EQ(mask(0, 0), Lit::yes);
    EXPECT_EQ(mask(0, 1), Lit::no);
    EXPECT_EQ(mask(0, 2), Lit::yes);
    EXPECT_EQ(mask(0, 3), Lit::unknown);
}

} // namespace
} // namespace duskline
