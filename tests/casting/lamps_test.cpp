// Casters of the table under lamps, one and several.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/lamps.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace duskline {
namespace {

class LampCasters : public testing::TestWithParam<Caster> {};
INSTANTIATE_TEST_SUITE_P(All, LampCasters, testing::ValuesIn(kCasters), test_name);

std::size_t wrong_beyond_edges(const Caster& caster, const HeightField& field, const PointLight& lamp,
                               const ShadowMask& mask, const ShadowMask& truth)
{
    const Grid<char> excused = excuses(caster, field, lamp);
    std::size_t count = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
        count += mask.values()[i] != truth.values()[i] && excused.values()[i] == 0;
    return count;
}

TEST_P(LampCasters, AgreeWithTheTruthOrRefuse)
{
    const Caster& caster = GetParam();
    if (takes_slopes_for_stairs(caster))
        GTEST_SKIP() << "casts shadows on slopes; line_march_test.cpp has its definition";
    Dice dice(7);
    for (int i = 0; i < 40; ++i) {
        const Terrain terrain = random_terrain(dice, {.rough = caster.exact, .holes = caster.exact});
        const PointLight lamp = random_lamp(dice, terrain);
        if (caster.cast_lamp == nullptr) {
            EXPECT_EQ(caster.lamp_shadow_heights, nullptr);
            EXPECT_THROW(cast_lamp(caster, terrain, lamp), InvalidInput);
            continue;
        }
        const ShadowMask truth = cast_by_ray(terrain, lamp);
        const ShadowMask mask = cast_lamp(caster, terrain, lamp);
        if (caster.exact)
            EXPECT_TRUE(same_mask(mask, truth)) << i;
        else // a lamp's shadow widens: what moves its edge by a cell near the lamp moves it farther off
            EXPECT_LE(wrong_beyond_edges(caster, terrain, lamp, mask, truth), mask.size() / 50) << i;
        EXPECT_TRUE(same_mask(mask_of(terrain, caster.lamp_shadow_heights(terrain, lamp, {})), mask)) << i;
    }
}

TEST_P(LampCasters, HaveAnAnswerForAnyGrid)
{
    const Caster& caster = GetParam();
    if (caster.cast_lamp == nullptr)
        GTEST_SKIP() << "takes no lamps";
    EXPECT_TRUE(cast_lamp(caster, HeightField{}, PointLight{}).empty());
    for (const auto& [rows, columns] :
         {std::pair{1U, 1U}, std::pair{1U, 9U}, std::pair{9U, 1U}, std::pair{2U, 2U}}) {
        Terrain terrain{Grid<float>(rows, columns, 1.0f), {}};
        terrain.heights_m(rows / 2, columns / 2) = 4.0f;
        for (const GridPoint place :
             {GridPoint{0.0, 0.0, 3.0}, GridPoint{0.0, 4.0, 9.0}, GridPoint{-2.0, 0.5, 2.0},
              GridPoint{0.5, 100.0, 3.0}, GridPoint{4.0, 0.0, 3.5}, GridPoint{4e15, -3e15, 3e15},
              GridPoint{-4503599627370496.0, 0.0, 1.0}}) {
            const ShadowMask mask = cast_lamp(caster, terrain, PointLight{place});
            if (caster.exact) {
                EXPECT_TRUE(same_mask(mask, cast_by_ray(terrain, PointLight{place})))
                    << rows << " x " << columns << ", lamp at " << place.row << ", " << place.column;
            }
            EXPECT_EQ(std::ranges::count(mask.values(), Lit::unknown), 0);
        }
        const Terrain nothing{Grid<float>(rows, columns, std::numeric_limits<float>::quiet_NaN()), {}};
        const ShadowMask mask = cast_lamp(caster, nothing, PointLight{{0.25, 0.0, 1.0}});
        EXPECT_EQ(std::ranges::count(mask.values(), Lit::unknown), static_cast<int>(rows * columns));
    }
}

TEST_P(LampCasters, StopWhenTheyAreToldTo)
{
    const Caster& caster = GetParam();
    if (caster.cast_lamp == nullptr)
        GTEST_SKIP() << "takes no lamps";
    const Terrain terrain = make_mountains({.grid = {.rows = 64, .columns = 64}});
    EXPECT_THROW(
        cast_lamp(caster, terrain, PointLight{{30.0, 30.0, 1e4}}, {.progress = [](double) { return false; }}),
        Cancelled);
}

TEST(Lamps, ACasterThatTakesNoneNamesThoseThatDo)
{
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    try {
        cast_lamp(caster_named("sweep"), flat, PointLight{});
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()), "the caster 'sweep' takes no point lights; these do: ray, "
                                             "fast-ray, exact, line-march, line-march-bilinear");
    }
    const std::array lamps{PointLight{}};
    EXPECT_THROW(lit_by_any(caster_named("sweep"), flat, lamps), InvalidInput);
    EXPECT_THROW(count_lamps(caster_named("sweep"), flat, lamps), InvalidInput);
    EXPECT_THROW(shadow_heights_of_any(caster_named("sweep"), flat, lamps), InvalidInput);
}

TEST(Lamps, SeveralAreTheSumOfEach)
{
    const Caster& caster = caster_named("exact");
    for_seeds(20, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 5});
        std::vector<PointLight> lamps;
        for (int i = 0; i < 4; ++i)
            lamps.push_back(random_lamp(dice, terrain));
        const auto each = cast_each_lamp(caster, terrain, lamps);
        const ShadowMask any = lit_by_any(caster, terrain, lamps);
        const Grid<std::uint16_t> counts = count_lamps(caster, terrain, lamps);
        EXPECT_TRUE(same_mask(mask_of(terrain, shadow_heights_of_any(caster, terrain, lamps)), any));
        ASSERT_EQ(each.size(), 4U);
        for (std::size_t cell = 0; cell < any.size(); ++cell) {
            const auto lit = std::ranges::count_if(
                each, [cell](const ShadowMask& mask) { return mask.values()[cell] == Lit::yes; });
            const bool known = each[0].values()[cell] != Lit::unknown;
            EXPECT_EQ(any.values()[cell], !known ? Lit::unknown : lit > 0 ? Lit::yes : Lit::no);
            EXPECT_EQ(counts.values()[cell], known ? lit : kNoLampCount);
        }
    });
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    EXPECT_EQ(std::ranges::count(lit_by_any(caster, flat, {}).values(), Lit::no), 16) << "no lamp, no light";
    EXPECT_THROW(count_lamps(caster, flat, std::vector<PointLight>(65535)), InvalidInput);
}

TEST(Lamps, ReportTheProgressOfAllAsOne)
{
    const Terrain terrain = make_mountains({.grid = {.rows = 64, .columns = 64}});
    const std::array lamps{PointLight{{3.0, 4.0, 5e3}}, PointLight{{30.0, 40.0, 5e3}},
                           PointLight{{60.0, 4.0, 5e3}}};
    std::vector<double> reports;
    lit_by_any(caster_named("exact"), terrain, lamps, {.threads = 1, .progress = [&](double done) {
                                                           reports.push_back(done);
                                                           return true;
                                                       }});
    EXPECT_TRUE(std::ranges::is_sorted(reports));
    ASSERT_FALSE(reports.empty());
    EXPECT_DOUBLE_EQ(reports.back(), 1.0);
    EXPECT_LT(reports.front(), 0.34);
}

} // namespace
} // namespace duskline
