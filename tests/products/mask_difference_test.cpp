#include "terrains.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/products/mask_difference.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace duskline {
namespace {

// '#' shadow, '.' lit, '?' no data.
ShadowMask drawn(const std::vector<std::string>& rows)
{
    ShadowMask mask(rows.size(), rows.front().size());
    for (std::size_t y = 0; y < mask.rows(); ++y)
        for (std::size_t x = 0; x < mask.columns(); ++x)
            mask(y, x) = rows[y][x] == '#' ? Lit::no : rows[y][x] == '.' ? Lit::yes : Lit::unknown;
    return mask;
}

// The distance of one cell by its definition: look at all cells.
std::size_t distance_from_edge(const ShadowMask& truth, std::size_t row, std::size_t column)
{
    const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
    std::size_t nearest = 0;
    for (std::size_t y = 0; y < truth.rows(); ++y)
        for (std::size_t x = 0; x < truth.columns(); ++x)
            if (truth(y, x) != Lit::unknown && truth(y, x) != truth(row, column)) {
                const std::size_t distance = std::max(apart(y, row), apart(x, column));
                nearest = nearest == 0 ? distance : std::min(nearest, distance);
            }
    return nearest;
}

TEST(MaskDifference, OfAMaskAndItselfIsNothing)
{
    const ShadowMask mask = drawn({"..#?", "....", "##.."});
    const MaskDifference difference = mask_difference(mask, mask);
    EXPECT_EQ(difference.cells, 12U);
    EXPECT_EQ(difference.differing, 0U);
    EXPECT_EQ(difference.farthest_from_edge, 0U);
}

TEST(MaskDifference, TellsBothMistakesApartAndMeasuresFromTheEdge)
{
    const ShadowMask truth = drawn({".......", ".......", ".......", "...##..", "......."});
    const MaskDifference difference =
        mask_difference(truth, drawn({"......#", ".......", "..#....", "...#...", "......."}));
    EXPECT_EQ(difference.differing, 3U);
    EXPECT_EQ(difference.false_light, 1U);
    EXPECT_EQ(difference.false_shadow, 2U);
    EXPECT_EQ(difference.beside_edge, 2U); // the diagonal counts
    EXPECT_EQ(difference.farthest_from_edge, 3U);
}

TEST(MaskDifference, WithoutAnEdgeHasNoDistance)
{
    const MaskDifference difference = mask_difference(drawn({"...?"}), drawn({"..#?"}));
    EXPECT_EQ(difference.differing, 1U);
    EXPECT_EQ(difference.beside_edge, 0U);
    EXPECT_EQ(difference.farthest_from_edge, std::nullopt);
}

TEST(MaskDifference, WhereTheTruthHasNoDataHasNoDistance)
{
    const MaskDifference difference = mask_difference(drawn({"..#?"}), drawn({".##."}));
    EXPECT_EQ(difference.differing, 2U);
    EXPECT_EQ(difference.false_light + difference.false_shadow, 1U);
    EXPECT_EQ(difference.farthest_from_edge, std::nullopt);
}

TEST(MaskDifference, ACellThatLosesItsDataDiffersOnNeitherSide)
{
    const MaskDifference difference = mask_difference(drawn({"..#."}), drawn({"?.#."}));
    EXPECT_EQ(difference.differing, 1U);
    EXPECT_EQ(difference.false_light + difference.false_shadow, 0U);
    EXPECT_EQ(difference.farthest_from_edge, 2U);
}

TEST(MaskDifference, OfRandomMasksIsWhatItsDefinitionSays)
{
    for_seeds(40, [](Dice& dice) {
        const std::size_t rows = 1 + dice.below(25);
        const std::size_t columns = 1 + dice.below(25);
        const double dark = dice.between(0.0, 0.2);
        ShadowMask truth(rows, columns, Lit::yes);
        for (Lit& lit : truth.values())
            lit = dice.chance(dark) ? Lit::no : dice.chance(0.1) ? Lit::unknown : Lit::yes;
        ShadowMask other = truth.copy();
        std::size_t differing = 0;
        std::size_t beside_edge = 0;
        std::size_t farthest = 0;
        bool no_edge = false;
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                if (truth(y, x) == Lit::unknown || !dice.chance(0.1))
                    continue;
                other(y, x) = truth(y, x) == Lit::no ? Lit::yes : Lit::no;
                const std::size_t distance = distance_from_edge(truth, y, x);
                ++differing;
                beside_edge += distance == 1 ? 1U : 0U;
                farthest = std::max(farthest, distance);
                no_edge = no_edge || distance == 0;
            }
        const MaskDifference difference = mask_difference(truth, other);
        EXPECT_EQ(difference.differing, differing);
        EXPECT_EQ(difference.beside_edge, beside_edge);
        EXPECT_EQ(difference.farthest_from_edge,
                  no_edge ? std::nullopt : std::optional<std::size_t>(farthest));
    });
}

TEST(MaskDifference, NeedsMasksOfOneSize)
{
    EXPECT_THROW(mask_difference(ShadowMask(2, 3), ShadowMask(3, 2)), InvalidInput);
    EXPECT_EQ(mask_difference(ShadowMask(), ShadowMask()).cells, 0U);
}

} // namespace
} // namespace duskline
