#include "vectors_near.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/globe.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace duskline {
namespace {

using namespace angle_literals;

// The point of an ellipsoid with that normal, from its textbook parametrisation.
Vector3 geodetic_point_m(const Globe& globe, const LonLat& place)
{
    const double a = globe.equatorial_radius_m;
    const double b = globe.polar_radius_m;
    const double phi = place.latitude.radians();
    const double lambda = place.longitude.radians();
    const double prime_vertical = a * a / std::hypot(a * std::cos(phi), b * std::sin(phi));
    return {prime_vertical * std::cos(phi) * std::cos(lambda),
            prime_vertical * std::cos(phi) * std::sin(lambda),
            b * b / (a * a) * prime_vertical * std::sin(phi)};
}

TEST(Globe, PutsPlacesWhereTheEllipsoidHasThatNormal)
{
    for (double latitude = -90.0; latitude <= 90.0; latitude += 7.5)
        for (double longitude = -180.0; longitude < 180.0; longitude += 22.5) {
            const LonLat place = {Angle::from_degrees(longitude), Angle::from_degrees(latitude)};
            expect_near(point_m(kWgs84, place, 0.0), geodetic_point_m(kWgs84, place), 1e-8);
        }
}

TEST(Globe, FindsThePlaceOfADirectionAgain)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> latitude(-90.0, 90.0);
    std::uniform_real_distribution<double> longitude(-180.0, 180.0);
    for (int i = 0; i < 1000; ++i) {
        const LonLat place = {Angle::from_degrees(longitude(random)), Angle::from_degrees(latitude(random))};
        const LonLat found = lon_lat_of(kWgs84, direction_at(kWgs84, place));
        EXPECT_NEAR(found.longitude.degrees(), place.longitude.degrees(), 1e-12);
        EXPECT_NEAR(found.latitude.degrees(), place.latitude.degrees(), 1e-12);
    }
}

TEST(Globe, HasGeodeticLatitudesThatDifferFromPlanetocentricOnesByTheFlattening)
{
    const Vector3 d = direction_at(kWgs84, {0_deg, 45_deg});
    EXPECT_NEAR(45.0 - Angle::from_radians(std::asin(d.z)).degrees(), 0.19242, 1e-5);
    EXPECT_NEAR(direction_at(sphere_of_radius(kMoonRadius_m), {0_deg, 30_deg}).z, 0.5, 1e-15);
}

TEST(Globe, MeasuresTheHeightThatAPointWasMadeWith)
{
    for (const double height : {-400.0, 0.0, 1.0, 8848.0, 2e7}) {
        const Vector3 point = point_m(kWgs84, {155_deg, -33_deg}, height);
        EXPECT_NEAR(height_m(kWgs84, point), height, 1e-8);
    }
    EXPECT_EQ(height_m(sphere_of_radius(2.0), Vector3{0.0, 0.0, 2.0}), 0.0);
}

TEST(Globe, FrameLooksEastNorthAndUp)
{
    const LocalFrame equator = local_frame(kWgs84, {0.0, 1.0, 0.0});
    expect_near(equator.east, {-1.0, 0.0, 0.0}, 1e-15);
    expect_near(equator.north, {0.0, 0.0, 1.0}, 1e-15);
    expect_near(equator.up, {0.0, 1.0, 0.0}, 1e-15);

    const LonLat place = {20_deg, 50_deg};
    const LocalFrame frame = local_frame(kWgs84, direction_at(kWgs84, place));
    expect_near(cross(frame.east, frame.north), frame.up, 1e-15);
    EXPECT_NEAR(std::asin(frame.up.z), place.latitude.radians(), 1e-15);
    const Vector3 northwards =
        point_m(kWgs84, {20_deg, Angle::from_degrees(50.00001)}, 0.0) - point_m(kWgs84, place, 0.0);
    expect_near(normalized(northwards), frame.north, 1e-6);
}

TEST(Globe, FrameOfThePolesIsThatOfLongitudeZero)
{
    const LocalFrame north = local_frame(kWgs84, {0.0, 0.0, 1.0});
    expect_near(north.east, {0.0, 1.0, 0.0}, 1e-15);
    expect_near(north.north, {-1.0, 0.0, 0.0}, 1e-15);
    const LocalFrame south = local_frame(kWgs84, {0.0, 0.0, -1.0});
    expect_near(south.north, {1.0, 0.0, 0.0}, 1e-15);
}

TEST(Globe, RefusesRadiiThatAreNone)
{
    EXPECT_NO_THROW(require_valid(kWgs84));
    for (const Globe& wrong :
         {Globe{0.0, 0.0}, Globe{-1.0, 1.0}, Globe{1.0, NAN}, Globe{INFINITY, INFINITY}, Globe{5.0, 1.0}})
        EXPECT_THROW(require_valid(wrong), InvalidInput);
}

} // namespace
} // namespace duskline
