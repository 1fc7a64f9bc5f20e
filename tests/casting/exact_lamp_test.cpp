#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/ray.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace duskline {
namespace {

std::string described(const PointLight& lamp)
{
    return "lamp at row " + std::to_string(lamp.position.row) + ", column "
           + std::to_string(lamp.position.column) + ", " + std::to_string(lamp.position.height_m) + " m";
}

std::size_t differing(const ShadowMask& a, const ShadowMask& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a.values()[i] != b.values()[i];
    return count;
}

TEST(ExactLamp, GivesTheRaysOwnBytesOnSpikesTerracesPlateausAndHoles)
{
    // Not "up to ties": the same formula decides both. Only where two crossings lie on one straight line may the
    // front take one for the other.
    std::size_t cells = 0;
    std::size_t wrong = 0;
    for_seeds(1500, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.rough = true, .holes = true});
        const PointLight lamp = random_lamp(dice, terrain);
        const ShadowMask truth = cast_by_ray(terrain, lamp, {.threads = 1});
        const std::size_t differ = differing(cast_by_exact(terrain, lamp, {.threads = 1}), truth);
        EXPECT_LE(differ, truth.size() / 1000) << described(lamp);
        cells += truth.size();
        wrong += differ;
    });
    RecordProperty("cells", std::to_string(cells));
    RecordProperty("differing", std::to_string(wrong));
    EXPECT_LE(wrong, cells / 100'000);
}

} // namespace
} // namespace duskline
