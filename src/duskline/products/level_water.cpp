#include <duskline/execution/for_rows.h>
#include <duskline/products/level_water.h>

#include <algorithm>
#include <cmath>

namespace duskline {

namespace {

constexpr std::size_t kBlock = 4;
constexpr std::size_t kRowsPerPiece = 32;

// Reach of the two bright bands, as shares of the picture's diagonal.
constexpr std::array<double, 2> kReaches = {0.008, 0.05};
constexpr std::array<float, 2> kStrengths = {0.45f, 0.55f};

} // namespace

LevelWater::LevelWater(const HeightField& field, const Tint& tint, const Execution& execution)
    : field_(field), tint_(tint)
{
    if (tint.sea.kind != SeaKind::surface || std::min(field.rows(), field.columns()) < kBlock)
        return;
    Grid<float> land(field.rows(), field.columns());
    for_rows(field.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            std::transform(field.heights_m.row(y).begin(), field.heights_m.row(y).end(), land.row(y).begin(),
                           [this](float height_m) { return is_water(height_m) ? 0.0f : 1.0f; });
    });
    const double diagonal =
        std::hypot(static_cast<double>(field.rows()), static_cast<double>(field.columns()));
    for (const double reach : kReaches) {
        shores_.emplace_back(land.view(), kBlock, execution);
        shores_.back().smooth(reach * diagonal);
    }
}

void LevelWater::fill_cover(std::size_t row, std::span<float> cover) const
{
    std::fill(cover.begin(), cover.end(), 0.0f);
    if (!exists())
        return;
    // Weights 1 2 1 down and across; beyond the border the last cells again.
    const auto above = field_.heights_m.row(row == 0 ? 0 : row - 1);
    const auto here = field_.heights_m.row(row);
    const auto below = field_.heights_m.row(std::min(row + 1, field_.rows() - 1));
    const auto column_share = [&](std::size_t x) {
        return 0.25f * (is_water(above[x]) ? 1.0f : 0.0f) + 0.5f * (is_water(here[x]) ? 1.0f : 0.0f)
               + 0.25f * (is_water(below[x]) ? 1.0f : 0.0f);
    };
    float left = column_share(0);
    float middle = left;
    for (std::size_t x = 0; x < cover.size(); ++x) {
        const float right = x + 1 < cover.size() ? column_share(x + 1) : middle;
        const float share = 0.25f * left + 0.5f * middle + 0.25f * right;
        cover[x] = std::clamp(1.5f * share - 0.25f, 0.0f, 1.0f);
        left = middle;
        middle = right;
    }
}

void LevelWater::fill_colours(std::size_t row, std::span<Colour> colours) const
{
    std::vector<float> shallow(colours.size(), 0.0f);
    std::vector<float> land(colours.size());
    for (std::size_t i = 0; i < shores_.size(); ++i) {
        shores_[i].row(row, land);
        for (std::size_t x = 0; x < shallow.size(); ++x) // on a straight shore half of all around is land
            shallow[x] += kStrengths[i] * std::clamp(2.0f * land[x], 0.0f, 1.0f);
    }
    for (std::size_t x = 0; x < colours.size(); ++x)
        colours[x] = mix(tint_.deep, tint_.shallow, shallow[x] * std::sqrt(shallow[x]));
}

} // namespace duskline
