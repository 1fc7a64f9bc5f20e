#include <duskline/planet/sun_motion.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

// Over the equator, towards the east.
Vector3 sun_at(double degrees)
{
    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(degrees));
    return {cosine, sine, 0.0};
}

double degrees_of(const Vector3& sun)
{
    return Angle::from_radians(std::atan2(sun.y, sun.x)).degrees();
}

TEST(SunMotion, GoesOnAsFastAsItHasWhenItIsSteady)
{
    SunMotion motion(sun_at(10.0));
    EXPECT_EQ(degrees_of(motion.ahead(10.0)), degrees_of(sun_at(10.0)));
    for (const double degrees : {10.1, 10.2, 10.3})
        motion.follow(sun_at(degrees));
    EXPECT_TRUE(motion.is_steady());
    EXPECT_FALSE(motion.stands());
    EXPECT_NEAR(degrees_of(motion.ahead(10.0)), 11.3, 1e-9);
    EXPECT_NEAR(degrees_of(motion.ahead(1000.0)), 15.3, 1e-9) << "no more than 5 degrees";
}

TEST(SunMotion, IsSteadyInFramesOfDifferentLengths)
{
    SunMotion motion(sun_at(0.0));
    double degrees = 0.0;
    for (int frame = 0; frame < 40; ++frame)
        motion.follow(sun_at(degrees += frame % 4 == 0 ? 0.4 : 0.1));
    EXPECT_TRUE(motion.is_steady());
    EXPECT_NEAR(degrees_of(motion.ahead(8.0)) - degrees, 8.0 * 0.175, 0.5);
}

TEST(SunMotion, IsNotSteadyAfterALeapARestOrATurn)
{
    SunMotion motion(sun_at(0.0));
    motion.follow(sun_at(0.0));
    EXPECT_TRUE(motion.stands());
    motion.follow(sun_at(40.0));
    EXPECT_FALSE(motion.is_steady());
    motion.follow(sun_at(39.9));
    EXPECT_FALSE(motion.is_steady());
    motion.follow(sun_at(39.8));
    EXPECT_TRUE(motion.is_steady());
    motion.follow(sun_at(39.8));
    EXPECT_TRUE(motion.stands());
    EXPECT_FALSE(motion.is_steady());
    EXPECT_EQ(degrees_of(motion.ahead(5.0)), degrees_of(sun_at(39.8)));
}

} // namespace
} // namespace duskline
