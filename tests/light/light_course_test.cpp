#include <duskline/geometry/invalid_input.h>
#include <duskline/light/light_course.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

LightCourse compass(std::size_t lights, Angle altitude)
{
    LightCourse course = {.closed = true};
    for (std::size_t i = 0; i < lights; ++i)
        course.lights.push_back(
            {.azimuth = Angle::from_degrees(360.0 * static_cast<double>(i) / static_cast<double>(lights)),
             .altitude = altitude});
    return course;
}

TEST(LightCourse, HasItsLightsAtThemselves)
{
    const LightCourse course = compass(7, 20_deg);
    for (std::size_t i = 0; i < 7; ++i) {
        const PlaceOnCourse place = nearest_place(course, course.lights[i]);
        EXPECT_NEAR(place.share, 0.0, 1e-9) << i;
        EXPECT_EQ(place.before, i);
    }
}

TEST(LightCourse, HasALightBetweenTwoAtItsShareOfTheWay)
{
    const LightCourse course = compass(12, 20_deg);
    const PlaceOnCourse middle = nearest_place(course, {.azimuth = 75_deg, .altitude = 20_deg});
    EXPECT_EQ(middle.before, 2U);
    EXPECT_EQ(middle.after, 3U);
    EXPECT_NEAR(middle.share, 0.5, 1e-9);
    const PlaceOnCourse early = nearest_place(course, {.azimuth = 66_deg, .altitude = 20_deg});
    EXPECT_EQ(early.before, 2U);
    EXPECT_NEAR(early.share, 0.2, 0.01);
}

TEST(LightCourse, GoesOnFromItsLastLightOnlyWhenItIsClosed)
{
    LightCourse course = compass(12, 20_deg);
    const DirectionalLight late = {.azimuth = 340_deg, .altitude = 20_deg};
    EXPECT_EQ(nearest_place(course, late).before, 11U);
    EXPECT_EQ(nearest_place(course, late).after, 0U);
    course.closed = false;
    const PlaceOnCourse end = nearest_place(course, late);
    EXPECT_EQ(end.before, 11U);
    EXPECT_EQ(end.after, 11U);
    EXPECT_EQ(end.share, 0.0);
}

TEST(LightCourse, TakesLightsBesideItToTheNearestPlace)
{
    const LightCourse morning = {
        {{.azimuth = 90_deg, .altitude = 0_deg}, {.azimuth = 120_deg, .altitude = 30_deg}}};
    const PlaceOnCourse night = nearest_place(morning, {.azimuth = 60_deg, .altitude = -30_deg});
    EXPECT_EQ(night.before, 0U);
    EXPECT_EQ(night.after, 0U);
    const PlaceOnCourse beside = nearest_place(morning, {.azimuth = 95_deg, .altitude = 20_deg});
    EXPECT_EQ(beside.before, 0U);
    EXPECT_EQ(beside.after, 1U);
    EXPECT_GT(beside.share, 0.2);
    EXPECT_LT(beside.share, 0.8);
}

TEST(LightCourse, MayBeOneLightButNotNone)
{
    const PlaceOnCourse place = nearest_place({{{.azimuth = 10_deg}}}, {.azimuth = 200_deg});
    EXPECT_EQ(place.before, 0U);
    EXPECT_EQ(place.after, 0U);
    EXPECT_THROW(nearest_place({}, {}), InvalidInput);
}

} // namespace
} // namespace duskline
