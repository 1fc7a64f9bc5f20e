#include <duskline/products/daylight.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(Daylight, IsWhiteUnderASunHalfWayUp)
{
    for (const double ambient : {0.0, 0.2, 0.4}) {
        const Daylight light = clear_daylight(45_deg, ambient);
        const auto share = static_cast<float>(ambient);
        const Colour both = light.sky * share + light.sun * (1.0f - share);
        EXPECT_NEAR(both.red, 1.0f, 1e-5f);
        EXPECT_NEAR(both.green, 1.0f, 1e-5f);
        EXPECT_NEAR(both.blue, 1.0f, 1e-5f);
    }
}

TEST(Daylight, ReddensAsTheSunSinksAndKeepsItsLuminance)
{
    float ratio = 0.0f;
    for (const double altitude : {80.0, 45.0, 20.0, 10.0, 5.0, 3.0}) {
        const Daylight light = clear_daylight(Angle::from_degrees(altitude), 0.28);
        EXPECT_NEAR(luminance(light.sun), 1.0f, 1e-5f);
        EXPECT_NEAR(luminance(light.sky), 1.0f, 1e-5f);
        EXPECT_GT(light.sun.red / light.sun.blue, ratio) << altitude;
        ratio = light.sun.red / light.sun.blue;
    }
}

TEST(Daylight, TheSkyIsBlueAndTheSunWarmer)
{
    const Daylight light = clear_daylight(30_deg, 0.28);
    EXPECT_GT(light.sky.blue, light.sky.red);
    EXPECT_GT(light.sun.red, light.sun.blue);
}

TEST(Daylight, StaysFiniteBelowTheHorizonAndWithAlmostNoSun)
{
    for (const double altitude : {-90.0, -6.5, -0.5, 0.0, 90.0})
        for (const double ambient : {0.0, 0.5, 0.99}) {
            const Daylight light = clear_daylight(Angle::from_degrees(altitude), ambient);
            for (const float value : {light.sun.red, light.sun.green, light.sun.blue}) {
                EXPECT_TRUE(std::isfinite(value)) << altitude << ", " << ambient;
                EXPECT_GE(value, 0.0f);
            }
        }
}

} // namespace
} // namespace duskline
