// How far from a shadow's edge masks differ: a chessboard distance transform in two passes.
//
//      1 2 3     Downwards, a cell takes the least of the neighbours already passed (1 to 4), plus one;
//      4 x -     upwards again with the others. Two passes reach every cell by a shortest way of a king.
//      - - -
//
// A. Rosenfeld and J. L. Pfaltz, Distance functions on digital pictures, Pattern Recognition 1, 1968.

#include <duskline/geometry/invalid_input.h>
#include <duskline/products/mask_difference.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace duskline {

namespace {

constexpr std::uint32_t kFarAway = 0xffffffffU;

std::uint32_t one_more(std::uint32_t distance)
{
    return distance == kFarAway ? kFarAway : distance + 1;
}

// Cells to the nearest one with that answer, kFarAway when there is none; with a frame of one cell around the
// mask that answers nothing.
Grid<std::uint32_t> distances_to(Lit answer, const ShadowMask& mask)
{
    Grid<std::uint32_t> distances(mask.rows() + 2, mask.columns() + 2, kFarAway);
    for (std::size_t y = 1; y <= mask.rows(); ++y) {
        const auto cells = mask.row(y - 1);
        const auto above = distances.row(y - 1);
        const auto own = distances.row(y);
        for (std::size_t x = 1; x <= mask.columns(); ++x)
            own[x] = cells[x - 1] == answer
                         ? 0
                         : one_more(std::min({above[x - 1], above[x], above[x + 1], own[x - 1]}));
    }
    for (std::size_t y = mask.rows(); y >= 1; --y) {
        const auto below = distances.row(y + 1);
        const auto own = distances.row(y);
        for (std::size_t x = mask.columns(); x >= 1; --x)
            own[x] = std::min(own[x], one_more(std::min({below[x - 1], below[x], below[x + 1], own[x + 1]})));
    }
    return distances;
}

void count(MaskDifference& difference, const ShadowMask& truth, const ShadowMask& other)
{
    difference.cells = truth.size();
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Lit right = truth.values()[i];
        const Lit wrong = other.values()[i];
        difference.differing += right != wrong ? 1U : 0U;
        difference.false_light += right == Lit::no && wrong == Lit::yes ? 1U : 0U;
        difference.false_shadow += right == Lit::yes && wrong == Lit::no ? 1U : 0U;
    }
}

// Takes the differing cells that `right` would be right for into account.
void measure(MaskDifference& difference, Lit right, const ShadowMask& truth, const ShadowMask& other)
{
    const Grid<std::uint32_t> distances = distances_to(right == Lit::no ? Lit::yes : Lit::no, truth);
    for (std::size_t y = 0; y < truth.rows(); ++y) {
        for (std::size_t x = 0; x < truth.columns(); ++x) {
            if (truth(y, x) != right || other(y, x) == right)
                continue;
            const std::uint32_t distance = distances(y + 1, x + 1);
            difference.beside_edge += distance == 1 ? 1U : 0U;
            if (distance == kFarAway)
                difference.farthest_from_edge.reset();
            else if (difference.farthest_from_edge)
                difference.farthest_from_edge =
                    std::max<std::size_t>(*difference.farthest_from_edge, distance);
        }
    }
}

bool differs_where_unknown(const ShadowMask& truth, const ShadowMask& other)
{
    return !std::ranges::equal(truth.values(), other.values(),
                               [](Lit right, Lit given) { return right != Lit::unknown || right == given; });
}

} // namespace

MaskDifference mask_difference(const ShadowMask& truth, const ShadowMask& other)
{
    if (truth.rows() != other.rows() || truth.columns() != other.columns())
        throw InvalidInput("a mask of " + std::to_string(other.rows()) + " x "
                           + std::to_string(other.columns()) + " cells cannot be compared with one of "
                           + std::to_string(truth.rows()) + " x " + std::to_string(truth.columns()));
    MaskDifference difference;
    count(difference, truth, other);
    if (difference.differing == 0)
        return difference;
    for (const Lit right : {Lit::no, Lit::yes})
        measure(difference, right, truth, other);
    if (differs_where_unknown(truth, other))
        difference.farthest_from_edge.reset();
    return difference;
}

} // namespace duskline
