#include <duskline/light/disc_slices.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace duskline {
namespace {

using namespace angle_literals;

double tangent_of_degrees(double degrees)
{
    return std::tan(degrees * std::numbers::pi / 180.0);
}

// Above a horizon that is level all along.
double above(const DiscSlices& slices, double horizon_tangent)
{
    double sum = 0.0;
    for (const DiscGroup& group : slices.groups)
        sum += group.all.above(horizon_tangent);
    return sum;
}

// Of a flat disc of radius 1, above a straight line at height t: the circular segment.
double segment(double t)
{
    return 0.5 - (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
}

TEST(DiscSlices, AreTheCircularSegmentOverALevelHorizon)
{
    for (const double altitude : {1.0, 20.0, 45.0}) {
        const DiscSlices slices =
            disc_slices({.azimuth = 203_deg, .altitude = Angle::from_degrees(altitude)});
        for (const double t : {-0.999, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 0.999}) {
            const double horizon = tangent_of_degrees(altitude + t * 0.2665);
            EXPECT_NEAR(above(slices, horizon), segment(t), 2e-3) << altitude << ", " << t;
        }
        EXPECT_NEAR(above(slices, 0.0), 1.0, 1e-12);
        EXPECT_EQ(above(slices, tangent_of_degrees(altitude + 0.3)), 0.0);
    }
}

// The fractions that tables print.
TEST(DiscSlices, AreTheTabledFractions)
{
    const DiscSlices slices = disc_slices({.altitude = 10_deg});
    struct Fraction {
        double t; // centre over horizon, in radii
        double seen;
    };
    for (const Fraction& known : {Fraction{0.75, 0.927853}, Fraction{0.5, 0.804499}, Fraction{0.25, 0.657481},
                                  Fraction{0.0, 0.5}, Fraction{-0.5, 0.195501}, Fraction{-0.75, 0.072147}})
        EXPECT_NEAR(above(slices, tangent_of_degrees(10.0 - known.t * 0.2665)), known.seen, 2e-3) << known.t;
}

// Of a disc as small as 0.0001 degrees at the zenith, where sines are nearly 1.
constexpr double kRounding = 1e-4;

TEST(DiscSlices, SharesAddUpAndFallWithTheHorizon)
{
    for (const double diameter : {1e-4, 0.533, 10.0, 90.0, 180.0})
        for (const double altitude : {0.0, 0.1, 5.0, 60.0, 89.9, 90.0}) {
            const DiscSlices slices = disc_slices({.azimuth = 31_deg,
                                                   .altitude = Angle::from_degrees(altitude),
                                                   .angular_diameter = Angle::from_degrees(diameter)});
            double whole = 0.0;
            for (const DiscGroup& group : slices.groups) {
                double parts = 0.0;
                double before = group.all.whole();
                for (int i = 0; i <= 200; ++i) {
                    const double horizon =
                        group.all.lowest_tangent()
                        + (group.all.highest_tangent() - group.all.lowest_tangent()) * i / 200.0;
                    EXPECT_LE(group.all.above(horizon), before + kRounding);
                    before = group.all.above(horizon);
                }
                EXPECT_NEAR(before, 0.0, 1e-12);
                for (const DiscSlice& part : group.parts)
                    parts += part.whole();
                EXPECT_NEAR(parts, group.all.whole(), 1e-12);
                whole += group.all.whole();
            }
            EXPECT_NEAR(whole, slices.above_horizontal, 1e-9);
            EXPECT_LE(slices.above_horizontal, 1.0);
            EXPECT_EQ(slices.above_horizontal == 1.0, altitude >= diameter / 2.0) << altitude;
        }
}

TEST(DiscSlices, AreAlikeOnBothSides)
{
    const DiscSlices slices = disc_slices({.azimuth = 90_deg, .altitude = 30_deg});
    ASSERT_EQ(slices.groups.size() % 2, 1U);
    const std::size_t last = slices.groups.size() - 1;
    EXPECT_EQ(slices.groups[last / 2].all.azimuth(), 90_deg);
    for (std::size_t i = 0; i <= last; ++i) {
        const DiscSlice& a = slices.groups[i].all;
        const DiscSlice& b = slices.groups[last - i].all;
        EXPECT_NEAR(a.azimuth().degrees() + b.azimuth().degrees(), 180.0, 1e-12);
        EXPECT_NEAR(a.whole(), b.whole(), 1e-12);
        EXPECT_NEAR(a.whole(), 1.0 / static_cast<double>(last + 1), 0.01);
    }
}

// Azimuths lie closer together in a high sun's disc: it is as wide as the circle of altitude is small.
TEST(DiscSlices, SpreadOverMoreAzimuthTheHigherTheSun)
{
    for (const double altitude : {0.0, 30.0, 60.0, 80.0}) {
        const DiscSlices slices = disc_slices({.azimuth = 0_deg, .altitude = Angle::from_degrees(altitude)});
        const double outermost = slices.groups.back().parts.back().azimuth().degrees();
        const double half_width = 0.2665 / std::cos(altitude * std::numbers::pi / 180.0);
        EXPECT_LT(outermost, half_width);
        EXPECT_GT(outermost, 0.8 * half_width);
    }
}

TEST(DiscSlices, OfASunHalfUpAreHalfOfIt)
{
    const DiscSlices half = disc_slices({.altitude = 0_deg});
    EXPECT_NEAR(half.above_horizontal, 0.5, 1e-4);
    EXPECT_NEAR(disc_slices({.altitude = Angle::from_degrees(-0.2665 / 2)}).above_horizontal, 0.195501, 1e-3);
    EXPECT_TRUE(disc_slices({.altitude = Angle::from_degrees(-0.2665)}).groups.empty());
    EXPECT_TRUE(disc_slices({.altitude = Angle::from_degrees(-80.0)}).groups.empty());
}

// A disc that is the whole sky, above a horizon of the same altitude all around: the solid angle over it.
TEST(DiscSlices, OfTheWholeSkyGoAllAround)
{
    const DiscSlices sky = disc_slices({.altitude = 90_deg, .angular_diameter = 180_deg});
    EXPECT_TRUE(sky.all_around);
    for (const double horizon : {0.0, 10.0, 45.0, 80.0})
        EXPECT_NEAR(above(sky, tangent_of_degrees(horizon)),
                    1.0 - std::sin(horizon * std::numbers::pi / 180.0), 2e-3);
    EXPECT_TRUE(disc_slices({.altitude = 85_deg, .angular_diameter = 10_deg}).all_around);
    EXPECT_FALSE(disc_slices({.altitude = 84.9_deg, .angular_diameter = 10_deg}).all_around);
}

} // namespace
} // namespace duskline
