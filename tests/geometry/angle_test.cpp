#include <duskline/geometry/angle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(Angle, DegreesAndRadiansAreTheSameAngle)
{
    EXPECT_EQ((180_deg).radians(), std::numbers::pi);
    EXPECT_DOUBLE_EQ(Angle::from_radians(std::numbers::pi / 2.0).degrees(), 90.0);
    EXPECT_EQ((12.5_deg).degrees(), 12.5);
    EXPECT_EQ((10_deg + 5_deg - 30_deg).degrees(), -15.0);
    EXPECT_LT(-(10_deg), 5_deg);
}

TEST(Angle, QuarterTurnsHaveExactSinesAndCosines)
{
    for (int turns = -3; turns <= 3; ++turns) {
        const double full = 360.0 * turns;
        const auto at = [full](double degrees) { return sine_cosine(Angle::from_degrees(full + degrees)); };
        EXPECT_EQ(at(0.0).sine, 0.0);
        EXPECT_EQ(at(0.0).cosine, 1.0);
        EXPECT_EQ(at(90.0).sine, 1.0);
        EXPECT_EQ(at(90.0).cosine, 0.0);
        EXPECT_EQ(at(180.0).sine, 0.0);
        EXPECT_EQ(at(180.0).cosine, -1.0);
        EXPECT_EQ(at(270.0).sine, -1.0);
        EXPECT_EQ(at(270.0).cosine, 0.0);
    }
}

TEST(Angle, DiagonalsHaveEqualSinesAndCosines)
{
    for (int i = 0; i < 16; ++i) {
        const auto [sine, cosine] = sine_cosine(Angle::from_degrees(-315.0 + 90.0 * i));
        EXPECT_EQ(std::abs(sine), std::abs(cosine)) << i;
        EXPECT_EQ(std::abs(sine), std::sqrt(0.5)) << i;
    }
    EXPECT_EQ(tangent(45_deg), 1.0);
    EXPECT_EQ(tangent(Angle::from_degrees(135.0)), -1.0);
}

TEST(Angle, AQuarterTurnMovesNoBitOfSineAndCosine)
{
    for (double degrees = 0.25; degrees < 360.0; degrees += 1.625) {
        const auto [sine, cosine] = sine_cosine(Angle::from_degrees(degrees));
        const auto turned = sine_cosine(Angle::from_degrees(degrees + 90.0));
        EXPECT_EQ(turned.sine, cosine) << degrees;
        EXPECT_EQ(turned.cosine, -sine) << degrees;
        const auto mirrored = sine_cosine(Angle::from_degrees(-degrees));
        EXPECT_EQ(mirrored.sine, -sine) << degrees;
        EXPECT_EQ(mirrored.cosine, cosine) << degrees;
    }
}

TEST(Angle, SinesAndCosinesAreThoseOfTheStandardLibrary)
{
    for (double degrees = -720.0; degrees < 720.0; degrees += 3.7) {
        const auto [sine, cosine] = sine_cosine(Angle::from_degrees(degrees));
        EXPECT_NEAR(sine, std::sin(degrees * std::numbers::pi / 180.0), 1e-14) << degrees;
        EXPECT_NEAR(cosine, std::cos(degrees * std::numbers::pi / 180.0), 1e-14) << degrees;
    }
    EXPECT_TRUE(std::isnan(sine_cosine(Angle::from_degrees(std::nan(""))).sine));
}

TEST(Angle, WrappingKeepsTheDirectionAndStaysOnTheCircle)
{
    EXPECT_EQ(wrapped_to_circle(725_deg), 5_deg);
    EXPECT_EQ(wrapped_to_circle(360_deg), 0_deg);
    EXPECT_EQ(wrapped_to_circle(-(45_deg)), 315_deg);
    EXPECT_EQ(wrapped_to_circle(Angle::from_degrees(-1e-20)), 0_deg) << "not 360";
    for (double degrees = -1000.0; degrees < 1000.0; degrees += 7.3) {
        const double wrapped = wrapped_to_circle(Angle::from_degrees(degrees)).degrees();
        EXPECT_GE(wrapped, 0.0);
        EXPECT_LT(wrapped, 360.0);
        EXPECT_NEAR(std::remainder(wrapped - degrees, 360.0), 0.0, 1e-10);
    }
}

} // namespace
} // namespace duskline
