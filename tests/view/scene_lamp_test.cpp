#include <duskline/geometry/invalid_input.h>
#include <duskline/view/scene_lamp.h>

#include <gtest/gtest.h>

#include <limits>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(SceneLamp, IsAsBrightAsTheSunWhereItSaysAndDarkBeyondItsRange)
{
    const SceneLamp lamp = {.bright_m = 50.0, .range_m = 2000.0};
    EXPECT_NEAR(light_at(lamp, 50.0), 1.0, 1e-6);
    EXPECT_NEAR(light_at(lamp, 100.0), 0.25, 1e-5);
    EXPECT_EQ(light_at(lamp, 2000.0), 0.0);
    EXPECT_EQ(light_at(lamp, 3000.0), 0.0);
    for (double d = 1.0; d < 2000.0; d *= 1.1)
        EXPECT_LT(light_at(lamp, 1.1 * d), light_at(lamp, d));
}

TEST(SceneLamp, IsRefusedWithTheValueThatIsWrong)
{
    const auto refused = [](const SceneLamp& lamp, const std::string& value) {
        try {
            require_valid(lamp);
        } catch (const InvalidInput& error) {
            return std::string(error.what()).find(value) != std::string::npos;
        }
        return false;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NO_THROW(require_valid(SceneLamp{}));
    EXPECT_TRUE(refused({.position_m = {1.0, nan, 0.0}}, "nan"));
    EXPECT_TRUE(refused({.direction = {0.0, 0.0, 0.0}, .half_angle = 20_deg}, "0.000000, 0.000000"));
    EXPECT_NO_THROW(require_valid({.direction = {0.0, 0.0, 0.0}}));
    EXPECT_TRUE(refused({.half_angle = 0.3_deg}, "0.3"));
    EXPECT_TRUE(refused({.half_angle = 181_deg}, "181"));
    EXPECT_TRUE(refused({.soft_edge = 1.5}, "1.5"));
    EXPECT_TRUE(refused({.colour = {1.0f, -2.0f, 0.0f}}, "-2"));
    EXPECT_TRUE(refused({.bright_m = 0.0}, "0.0"));
    EXPECT_TRUE(refused({.bright_m = nan}, "nan"));
    EXPECT_TRUE(refused({.range_m = 0.5}, "0.5"));
    EXPECT_TRUE(refused({.range_m = std::numeric_limits<double>::infinity()}, "inf"));
}

TEST(SceneLamp, IsASearchlightBelowAHalfAngleOf180Degrees)
{
    EXPECT_FALSE(is_searchlight({}));
    EXPECT_TRUE(is_searchlight({.half_angle = 179.5_deg}));
}

TEST(SceneLamp, DiffersInWhateverItIsToldToBe)
{
    const SceneLamp lamp;
    SceneLamp other = lamp;
    EXPECT_EQ(lamp, other);
    other.position_m.z = 1.0;
    EXPECT_FALSE(lamp == other);
    other = lamp;
    other.colour[2] = 0.5f;
    EXPECT_FALSE(lamp == other);
}

} // namespace
} // namespace duskline
