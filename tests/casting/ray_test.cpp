#include <duskline/casting/ray.h>

#include <gtest/gtest.h>

namespace duskline {
namespace {

using namespace angle_literals;

TEST(Ray, AWallShadesAsFarAsItsHeightOverTheTangentOfTheSun)
{
    Terrain terrain{Grid<float>(5, 64, 0.0f), {1.0, 1.0}};
    for (std::size_t y = 0; y < 5; ++y)
        terrain.heights_m(y, 40) = 10.0f;
    const ShadowMask mask = cast_by_ray(terrain, {.azimuth = 90_deg, .altitude = 45_deg});
    for (std::size_t x = 0; x < 64; ++x)
        EXPECT_EQ(mask(2, x), x > 30 && x < 40 ? Lit::no : Lit::yes) << "column " << x;
}

} // namespace
} // namespace duskline
