// The strider against the loops of its source, one line after the other, and against itself in pieces.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/ray.h>
#include <duskline/casting/strider.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

// The two loops, over all cells away from the light and from each that is lit along its track, with a mark for every
// cell that a line passes.
class TwoLoops {
public:
    TwoLoops(const HeightField& field, const DirectionalLight& light)
        : frame_(light_frame(light, field.cell_size_m)), heights_(in_light_order(field.heights_m, frame_)),
          marks_(heights_.lines, heights_.cells, 0), doubtful_(heights_.lines, heights_.cells, 0)
    {
        for (std::size_t v = 0; v < heights_.lines; ++v)
            for (std::size_t u = 0; u < heights_.cells; ++u)
                if (marks_(v, u) == 0 && !std::isnan(heights_.at(v, u)))
                    cast_from(v, u);
    }

    bool is_dark(std::size_t v, std::size_t u) const { return marks_(v, u) > 0; }
    bool is_doubtful(std::size_t v, std::size_t u) const { return doubtful_(v, u) != 0; }
    int most_marks() const { return *std::ranges::max_element(marks_.values()); }
    const LightFrame& frame() const { return frame_; }

private:
    double moved(std::size_t v) const { return frame_.lateral * static_cast<double>(v); }

    // The track of a cell: the one nearest to it, as a number on line 0.
    double track_of(std::size_t v, std::size_t u) const
    {
        const double nearest = std::floor(std::abs(moved(v)) + 0.5);
        return static_cast<double>(u) - std::copysign(nearest, frame_.lateral);
    }

    // The ground where the track of a cell crosses its line.
    double ground_m(std::size_t v, std::size_t u) const
    {
        const double aside = track_of(v, u) + moved(v) - static_cast<double>(u);
        const double own_m = heights_.at(v, u);
        if (std::abs(aside) < 1e-6)
            return own_m;
        const std::size_t beside = aside > 0.0 ? u + 1 : u - 1; // -1 wraps
        if (beside >= heights_.cells || std::isnan(heights_.at(v, beside)))
            return own_m;
        return own_m + (heights_.at(v, beside) - own_m) * std::abs(aside);
    }

    void cast_from(std::size_t v, std::size_t u)
    {
        const double top_m = ground_m(v, u);
        const double track = track_of(v, u);
        for (std::size_t w = v + 1; w < heights_.lines; ++w) {
            const double cell = track + std::copysign(std::floor(std::abs(moved(w)) + 0.5), frame_.lateral);
            if (cell < 0.0 || cell >= static_cast<double>(heights_.cells))
                return;
            const auto u_w = static_cast<std::size_t>(cell);
            if (std::isnan(heights_.at(w, u_w)))
                continue;
            const double line_m = top_m - frame_.drop_m * static_cast<double>(w - v);
            const double over_m = line_m - ground_m(w, u_w);
            if (std::abs(over_m) < 0.01)
                doubtful_(w, u_w) = 1;
            if (over_m <= 0.0)
                return;
            ++marks_(w, u_w);
        }
    }

    LightFrame frame_;
    LightOrder<const float> heights_;
    Grid<int> marks_;
    Grid<char> doubtful_;
};

TEST(Strider, GivesTheMaskOfTheTwoLoops)
{
    for_seeds(80, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const HeightField field = terrain;
        DirectionalLight light = random_light(dice);
        light.altitude = Angle::from_degrees(dice.between(1.0, 70.0));
        const TwoLoops loops(field, light);
        const ShadowMask mask = cast_by_strider(field, light, {.threads = 1});
        const auto answers = in_light_order(mask.view(), loops.frame());
        for (std::size_t v = 0; v < answers.lines; ++v)
            for (std::size_t u = 0; u < answers.cells; ++u)
                if (answers.at(v, u) != Lit::unknown && !loops.is_doubtful(v, u)) {
                    ASSERT_EQ(answers.at(v, u), loops.is_dark(v, u) ? Lit::no : Lit::yes)
                        << "line " << v << ", cell " << u << ", azimuth " << light.azimuth.degrees();
                }
    });
}

TEST(Strider, MarksNoCellTwice)
{
    for_seeds(40, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.smallest = 20});
        const TwoLoops loops(terrain, {Angle::from_degrees(dice.between(0.0, 360.0)), 7_deg});
        EXPECT_LE(loops.most_marks(), 1);
    });
}

TEST(Strider, LeavesNoGapInTheShadowOfAWallAtAnyAzimuth)
{
    const Terrain wall =
        make_wall({.grid = {.rows = 61, .columns = 61}, .height_m = 400.0, .thickness_m = 2.5});
    for (double azimuth = 46.0; azimuth < 135.0; azimuth += 0.37) {
        const ShadowMask mask = cast_by_strider(wall, {Angle::from_degrees(azimuth), 30_deg});
        for (std::size_t column = 6; column <= 26; ++column)
            ASSERT_EQ(mask(30, column), Lit::no) << azimuth << ", column " << column;
    }
}

// In pieces of so many lines.
template <typename Answer>
Grid<Answer> stride(const HeightField& field, const DirectionalLight& light, std::size_t threads,
                    std::size_t lines_at_a_time)
{
    const LightFrame frame = light_frame(light, field.cell_size_m);
    const auto heights = in_light_order(field.heights_m, frame);
    Grid<Answer> answers(field.rows(), field.columns());
    const auto out = in_light_order(answers.view(), frame);
    StriderFront front(heights.lines, heights.cells, frame);
    for (std::size_t v = 0; v < heights.lines; v += lines_at_a_time) {
        const std::size_t lines = std::min(lines_at_a_time, heights.lines - v);
        front.advance(heights.part(v, lines), out.part(v, lines), {.threads = threads});
    }
    return answers;
}

TEST(Strider, GivesTheSameBytesForAnyThreadsAndAnyPieces)
{
    Terrain terrain = make_mountains({.grid = {903, 817, {30.0, 25.0}}, .seed = 2}); // wider than a strip
    Dice dice(1);
    for (int i = 0; i < 5000; ++i)
        terrain.heights_m(dice.below(903), dice.below(817)) = std::nanf("");
    for (const double azimuth : {0.0, 45.0, 203.0, 100.3, 280.0, 331.6}) {
        SCOPED_TRACE("azimuth " + std::to_string(azimuth));
        const DirectionalLight light{Angle::from_degrees(azimuth), 7_deg};
        const ShadowMask mask = cast_by_strider(terrain, light, {.threads = 1});
        EXPECT_GT(std::ranges::count(mask.values(), Lit::no), 100'000);
        EXPECT_TRUE(same_mask(stride<Lit>(terrain, light, 7, 10'000), mask));
        EXPECT_TRUE(same_mask(stride<Lit>(terrain, light, 2, 100), mask));
        EXPECT_TRUE(same_mask(stride<Lit>(terrain, light, 1, 37), mask));
        const ShadowField heights = shadow_heights_by_strider(terrain, light, {.threads = 1});
        EXPECT_TRUE(same_bits(stride<float>(terrain, light, 3, 257), heights));
    }
}

TEST(Strider, ShadowHeightsFallWithTheLightOverLevelGround)
{
    Terrain terrain{Grid<float>(1, 30, 100.0f), {10.0, 10.0}};
    terrain.heights_m(0, 25) = 150.0f;
    const ShadowField shadows = shadow_heights_by_strider(terrain, {.azimuth = 90_deg, .altitude = 45_deg});
    for (std::size_t column = 21; column < 25; ++column)
        EXPECT_NEAR(shadows(0, column), 150.0 - 10.0 * static_cast<double>(25 - column), 1e-3);
    EXPECT_EQ(shadows(0, 29), -std::numeric_limits<float>::infinity());
}

} // namespace
} // namespace duskline
