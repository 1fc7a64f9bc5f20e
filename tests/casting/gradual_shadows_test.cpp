#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/gradual_shadows.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;
using namespace std::chrono_literals;

constexpr std::size_t kAllLines = std::numeric_limits<std::size_t>::max();

Terrain hills(std::size_t rows = 90, std::size_t columns = 70)
{
    return make_mountains({.grid = {rows, columns, {30.0, 30.0}}, .seed = 6});
}

const DirectionalLight kMorning{100.3_deg, 9_deg};
const DirectionalLight kEvening{255_deg, 12_deg};

TEST(GradualShadows, AreThoseOfOneGoWhateverTheBudget)
{
    const Terrain terrain = hills();
    for (const DirectionalLight& light :
         {kMorning, kEvening, DirectionalLight{180_deg, 20_deg}, DirectionalLight{3_deg, 7_deg}})
        for (const std::size_t lines : {1U, 7U, 64U, 1000U}) {
            GradualShadows shadows(terrain);
            shadows.begin(light);
            std::size_t calls = 1;
            while (!shadows.advance(lines, {.threads = 1}))
                ++calls;
            EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, light, {.threads = 1})));
            const std::size_t all = light_frame(light, terrain.cell_size_m).lines_are_rows ? 90 : 70;
            EXPECT_EQ(calls, (all + lines - 1) / lines);
        }
}

TEST(GradualShadows, KeepTheFinishedMaskWhileTheNextIsMade)
{
    const Terrain terrain = hills();
    GradualShadows shadows(terrain);
    EXPECT_FALSE(shadows.light());
    EXPECT_TRUE(same_mask(shadows.mask(), ShadowMask(90, 70, Lit::unknown)));
    shadows.begin(kMorning);
    EXPECT_TRUE(shadows.advance(kAllLines));
    const ShadowMask morning = shadows.mask().copy();
    shadows.begin(kEvening);
    while (!shadows.advance(5)) {
        EXPECT_TRUE(same_mask(shadows.mask(), morning));
        EXPECT_EQ(shadows.light()->azimuth, kMorning.azimuth);
    }
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kEvening)));
    EXPECT_EQ(shadows.light()->azimuth, kEvening.azimuth);
}

TEST(GradualShadows, BeginAnewWithAnotherLight)
{
    const Terrain terrain = hills();
    GradualShadows shadows(terrain);
    shadows.begin(kMorning);
    shadows.advance(50);
    shadows.begin(kEvening);
    EXPECT_EQ(shadows.lines_left(), 70U);
    EXPECT_TRUE(shadows.advance(kAllLines));
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kEvening)));
}

TEST(GradualShadows, BeginAnewWhenTheTerrainChanges)
{
    Terrain terrain = hills();
    GradualShadows shadows(terrain);
    shadows.restart(); // of no light
    EXPECT_FALSE(shadows.is_busy());
    shadows.begin(kMorning);
    shadows.advance(40);
    terrain.heights_m(45, 69) += 3000.0f; // among the lines that are done
    shadows.restart();
    EXPECT_TRUE(shadows.advance(kAllLines));
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kMorning)));

    const ShadowMask before = shadows.mask().copy();
    terrain.heights_m(20, 60) += 3000.0f; // with no mask under way
    shadows.restart();
    EXPECT_TRUE(shadows.is_busy());
    EXPECT_TRUE(same_mask(shadows.mask(), before));
    EXPECT_TRUE(shadows.advance(kAllLines));
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kMorning)));
    EXPECT_FALSE(same_mask(shadows.mask(), before));
}

TEST(GradualShadows, CanBeGivenUp)
{
    const Terrain terrain = hills();
    GradualShadows shadows(terrain);
    shadows.begin(kMorning);
    shadows.advance(kAllLines);
    shadows.begin(kEvening);
    shadows.advance(30);
    shadows.cancel();
    EXPECT_FALSE(shadows.is_busy());
    EXPECT_FALSE(shadows.advance(kAllLines));
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kMorning)));
}

TEST(GradualShadows, StopWhenTheyAreToldTo)
{
    const Terrain terrain = hills();
    GradualShadows shadows(terrain);
    shadows.begin(kMorning);
    std::vector<double> done;
    const auto twice = [&](double share) {
        done.push_back(share);
        return done.size() < 2;
    };
    EXPECT_FALSE(shadows.advance(7, {.progress = twice}));
    EXPECT_THROW(shadows.advance(28, {.progress = twice}), Cancelled);
    EXPECT_NEAR(done[0], 0.1, 1e-12);
    EXPECT_NEAR(done[1], 0.5, 1e-12);
    EXPECT_FALSE(shadows.is_busy());
    EXPECT_TRUE(same_mask(shadows.mask(), ShadowMask(90, 70, Lit::unknown)));
}

TEST(GradualShadows, StopWhenTheirTimeIsSpent)
{
    const Terrain terrain = hills(2000, 70); // some 900 lines at a time
    GradualShadows shadows(terrain);
    GradualShadows::Clock::time_point time;
    const auto slow_clock = [&] { return time += 1ms; };
    const DirectionalLight south{180_deg, 12_deg};
    shadows.begin(south);
    EXPECT_FALSE(shadows.advance_for(0ms, {}, slow_clock)) << "one piece at least";
    const std::size_t one_piece = 2000 - shadows.lines_left();
    EXPECT_GT(one_piece, 0U);
    EXPECT_LT(one_piece, 1000U);
    shadows.begin(south);
    EXPECT_FALSE(shadows.advance_for(2ms, {}, slow_clock));
    EXPECT_EQ(2000 - shadows.lines_left(), 2 * one_piece);
    EXPECT_TRUE(shadows.advance_for(1h, {}, slow_clock));
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, south)));
    EXPECT_FALSE(shadows.advance_for(1h, {}, slow_clock)) << "nothing is left to do";
}

TEST(GradualShadows, KnowNightAndNoonAndNoData)
{
    Terrain terrain = hills();
    terrain.heights_m(3, 4) = std::nanf("");
    for (const DirectionalLight& light :
         {DirectionalLight{10_deg, -3_deg}, DirectionalLight{10_deg, 90_deg}, kMorning}) {
        GradualShadows shadows(terrain);
        shadows.begin(light);
        EXPECT_FALSE(shadows.advance(30));
        EXPECT_TRUE(shadows.advance(kAllLines));
        EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, light, {.threads = 1})));
    }
}

TEST(GradualShadows, HaveNothingToDoWithoutTerrain)
{
    GradualShadows shadows(HeightField{});
    shadows.begin(kMorning);
    EXPECT_FALSE(shadows.is_busy());
    EXPECT_FALSE(shadows.advance_for(1ms));
    EXPECT_TRUE(shadows.mask().empty());
}

TEST(GradualShadows, RefuseValuesOutOfRange)
{
    const Terrain terrain = hills(9, 9);
    EXPECT_THROW(GradualShadows({terrain.heights_m.view(), {0.0, 1.0}}), InvalidInput);
    GradualShadows shadows(terrain);
    shadows.begin(kMorning);
    EXPECT_THROW(shadows.begin({.azimuth = Angle::from_degrees(std::nan(""))}), InvalidInput);
    EXPECT_TRUE(shadows.advance(kAllLines)) << "what was under way still is";
    EXPECT_TRUE(same_mask(shadows.mask(), cast_by_strider(terrain, kMorning)));
}

} // namespace
} // namespace duskline
