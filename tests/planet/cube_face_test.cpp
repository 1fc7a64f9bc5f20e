#include <duskline/geometry/cross_product.h>
#include <duskline/planet/cube_face.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace duskline {
namespace {

bool same(const Vector3& a, const Vector3& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

TEST(CubeFace, HasRightHandedAxesThatPointOutwards)
{
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        const CubeFaceAxes axes = axes_of_face(face);
        EXPECT_TRUE(same(cross(axes.right, axes.up), axes.axis)) << face;
        EXPECT_EQ(face_of(axes.axis), face);
    }
}

TEST(CubeFace, FindsTheDirectionOfAPlaceAndThePlaceOfADirection)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> side(-0.999, 0.999);
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (int i = 0; i < 100; ++i) {
            const FacePlace place = {side(random), side(random)};
            const Vector3 direction = direction_of(face, place);
            EXPECT_NEAR(length(direction), 1.0, 1e-15);
            EXPECT_EQ(face_of(direction), face);
            const FacePlace found = place_on_face(face, direction);
            EXPECT_NEAR(found.u, place.u, 1e-15);
            EXPECT_NEAR(found.v, place.v, 1e-15);
        }
}

TEST(CubeFace, SeesGreatCirclesAsStraightLines)
{
    std::mt19937 random(6);
    std::uniform_real_distribution<double> side(-1.0, 1.0);
    for (int i = 0; i < 100; ++i) {
        const FacePlace a = {side(random), side(random)};
        const FacePlace b = {side(random), side(random)};
        const FacePlace middle =
            place_on_face(2, direction_of(2, a) + direction_of(2, b)); // of the great circle's arc
        EXPECT_NEAR((middle.u - a.u) * (b.v - a.v), (middle.v - a.v) * (b.u - a.u), 1e-14);
    }
}

} // namespace
} // namespace duskline
