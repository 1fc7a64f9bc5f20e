#include "gl/gl_test.h"
#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/smap.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/silhouette_passes.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array kSearches = {NextVSearch::binary, NextVSearch::quad, NextVSearch::parallel_quad};

float greatest_m(const HeightField& field)
{
    const HeightRange range = height_range(field);
    return range.lowest_m > range.highest_m ? 0.0f
                                            : std::max(std::abs(range.lowest_m), std::abs(range.highest_m));
}

// Whether all texels are the same; else how many are not, and where the first is.
testing::AssertionResult same_texels(const Grid<SilhouetteTexel>& actual,
                                     GridView<const SilhouetteTexel> expected)
{
    if (actual.rows() != expected.rows() || actual.columns() != expected.columns())
        return testing::AssertionFailure() << "of another size";
    std::size_t different = 0;
    auto result = testing::AssertionFailure();
    for (std::size_t v = 0; v < actual.rows(); ++v)
        for (std::size_t x = 0; x < actual.columns(); ++x)
            if (!(actual(v, x) == expected(v, x)) && different++ == 0)
                result << "(v " << v << ", x " << x << ") is " << actual(v, x).bits << ", not "
                       << expected(v, x).bits;
    return different == 0 ? testing::AssertionSuccess() : result << "; " << different << " differ";
}

// As the card answers: no data is lit.
ShadowMask as_mask(const Grid<std::uint8_t>& bytes, const HeightField& field)
{
    ShadowMask mask(bytes.rows(), bytes.columns());
    std::ranges::transform(bytes.values(), mask.values().begin(),
                           [](std::uint8_t byte) { return byte == 0 ? Lit::no : Lit::yes; });
    for (std::size_t row = 0; row < mask.rows(); ++row)
        for (std::size_t column = 0; column < mask.columns(); ++column)
            if (std::isnan(field.heights_m(row, column)))
                mask(row, column) = Lit::unknown;
    return mask;
}

using SilhouettePassesTest = GlTest;

TEST_F(SilhouettePassesTest, HaveTheTexelsOfTheProcessorsMap)
{
    for (const NextVSearch search : kSearches)
        for (const bool better : {false, true}) {
            const SilhouetteMapOptions options{.search = search, .better_next_v = better};
            SilhouettePasses passes(ShaderSources(), options);
            for_seeds(25, [&](Dice& dice) {
                const Terrain terrain = random_terrain(dice);
                const DirectionalLight light = random_light(dice);
                passes.build(height_texture(terrain.heights_m.view()), terrain.cell_size_m, light,
                             greatest_m(terrain));
                EXPECT_TRUE(
                    same_texels(passes.read_texels(), SilhouetteMap(terrain, light, options).texels()))
                    << static_cast<int>(search) << better;
            });
        }
}

TEST_F(SilhouettePassesTest, HaveTheTexelsOfTheProcessorsMapOnMountains)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 200, .columns = 333, .cell_size_m = {30.0, 30.0}}});
    const Texture heights = height_texture(terrain.heights_m.view());
    SilhouettePasses passes{ShaderSources()};
    for (const double azimuth : {0.0, 31.0, 100.0, 215.0, 305.0}) {
        const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth), .altitude = 6_deg};
        passes.build(heights, terrain.cell_size_m, light, greatest_m(terrain));
        EXPECT_TRUE(same_texels(passes.read_texels(), SilhouetteMap(terrain, light).texels())) << azimuth;
    }
}

TEST_F(SilhouettePassesTest, AnswerAsTheCasterButForTies)
{
    SilhouettePasses by_quad(ShaderSources(), {.search = NextVSearch::quad});
    SilhouettePasses by_parallel_quad{ShaderSources()};
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        const Texture heights = height_texture(terrain.heights_m.view());
        const ShadowMask expected = cast_by_smap(terrain, light);
        const Grid<char> tied = ties(terrain, shadow_heights_by_smap(terrain, light));
        for (SilhouettePasses* passes : {&by_quad, &by_parallel_quad}) {
            passes->build(heights, terrain.cell_size_m, light, greatest_m(terrain));
            EXPECT_TRUE(same_mask(as_mask(read_back<std::uint8_t>(passes->mask()), terrain), expected, tied));
            EXPECT_TRUE(same_mask(as_mask(read_back<std::uint8_t>(passes->mask_by_full_scan()), terrain),
                                  expected, tied));
        }
    });
}

TEST_F(SilhouettePassesTest, AnswerForLightUnderTheHorizonAndStraightOverhead)
{
    const Terrain terrain = make_cone({.grid = {.rows = 20, .columns = 30}});
    const Texture heights = height_texture(terrain.heights_m.view());
    SilhouettePasses passes{ShaderSources()};
    for (const Angle altitude : {-10_deg, 0_deg, 90_deg}) {
        const DirectionalLight light{.azimuth = 30_deg, .altitude = altitude};
        passes.build(heights, terrain.cell_size_m, light, 50.0f);
        EXPECT_EQ(passes.texels(), nullptr);
        EXPECT_TRUE(same_mask(as_mask(read_back<std::uint8_t>(passes.mask()), terrain),
                              cast_by_smap(terrain, light)));
    }
}

TEST_F(SilhouettePassesTest, RefuseValuesOutOfRangeInWords)
{
    SilhouettePasses passes{ShaderSources()};
    EXPECT_THROW(passes.mask(), InvalidInput); // nothing built yet
    const Texture heights(TextureFormat::r32f, 4, 4);
    EXPECT_THROW(passes.build(heights, {.x = 0.0, .y = 1.0}, {}, 1.0f), InvalidInput);
    EXPECT_THROW(passes.build(heights, {}, {.altitude = 91_deg}, 1.0f), InvalidInput);
    EXPECT_THAT([&] { passes.build(heights, {}, {}, -1.0f); },
                ThrowsMessage<InvalidInput>(HasSubstr("greatest height")));
}

} // namespace
} // namespace duskline::gl
