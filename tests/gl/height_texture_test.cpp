#include "gl/gl_test.h"
#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gmock/gmock.h>

#include <limits>

namespace duskline::gl {
namespace {

using namespace angle_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

using HeightTexture = GlTest;

constexpr DirectionalLight kLow{.azimuth = 240_deg, .altitude = 10_deg};

TEST_F(HeightTexture, HoldsExactShadowHeightsAsTheyAre)
{
    for_seeds(20, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const ShadowField shadow = shadow_heights_by_exact(terrain, random_light(dice));
        EXPECT_TRUE(same_bits(read_back<float>(height_texture(shadow.view())), shadow));
    });
}

TEST_F(HeightTexture, FollowsAnEditByTheRectangleItChanges)
{
    Terrain terrain = make_gaussian_hill({.grid = {.rows = 90, .columns = 120}});
    const ShadowField before = shadow_heights_by_exact(terrain, kLow);
    Texture texture = height_texture(before.view());
    for (std::size_t row = 40; row < 44; ++row)
        for (std::size_t column = 60; column < 70; ++column)
            terrain.heights_m(row, column) += 15.0f;

    const ShadowField after = shadow_heights_by_exact(terrain, kLow);
    const CellRectangle changed = changed_rectangle(before.view(), after.view());
    EXPECT_LT(changed.rows * changed.columns, after.size() / 2); // down-light of the edit, not everywhere
    EXPECT_GT(changed.rows * changed.columns, 0U);
    upload_rectangle(texture, after.view(), changed);
    EXPECT_TRUE(same_bits(read_back<float>(texture), after));
}

TEST_F(HeightTexture, LeavesTexelsOutsideTheRectangleAlone)
{
    Texture texture = height_texture(Grid<float>(5, 6, 1.0f).view());
    const Grid<float> edited(5, 6, 2.0f);
    upload_rectangle(texture, edited.view(), {1, 2, 3, 4});
    const Grid<float> back = read_back<float>(texture);
    for (std::size_t row = 0; row < 5; ++row)
        for (std::size_t column = 0; column < 6; ++column)
            EXPECT_EQ(back(row, column), row >= 1 && row < 4 && column >= 2 ? 2.0f : 1.0f);
}

TEST(ChangedRectangle, IsTheSmallestOne)
{
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    Grid<float> before(6, 7, 1.0f);
    before(5, 6) = none;
    Grid<float> after = before.copy();
    EXPECT_EQ(changed_rectangle(before.view(), after.view()).rows, 0U); // no data is like itself
    after(2, 5) = 3.0f;
    after(4, 1) = none;
    const CellRectangle changed = changed_rectangle(before.view(), after.view());
    EXPECT_EQ(changed.first_row, 2U);
    EXPECT_EQ(changed.first_column, 1U);
    EXPECT_EQ(changed.rows, 3U);
    EXPECT_EQ(changed.columns, 5U);
}

TEST_F(HeightTexture, RefusesWhatDoesNotFitInWords)
{
    Texture texture = height_texture(Grid<float>(5, 6, 1.0f).view());
    const Grid<float> other(5, 7, 1.0f);
    const Grid<float> same(5, 6, 1.0f);
    EXPECT_THAT([&] { upload_rectangle(texture, other.view(), {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("texture of 6 x 5")));
    EXPECT_THAT(
        [&] {
            upload_rectangle(texture, same.view(), {4, 0, 2, 1});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("1 x 2 from column 0 and row 4")));
    EXPECT_THAT([&] { changed_rectangle(same.view(), other.view()); },
                ThrowsMessage<InvalidInput>(HasSubstr("6 x 5 and 7 x 5")));
}

} // namespace
} // namespace duskline::gl
