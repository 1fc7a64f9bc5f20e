// One pass over numbers just read, while they are in the cache. Most pieces of most rasters hold nothing but
// heights: whether one does is asked first, in a loop that compilers vectorise, and only the others are looked
// at number by number.

#include <duskline/raster_io/clean_heights.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kTooLarge = 1e30F;         // 3.4e38, 1e38, 9.97e36 (NetCDF's fill value)
constexpr float kShortVoid = -32768.0F;    // SRTM's, whether declared or not: deeper than any sea
constexpr float kCustomaryVoid = -9999.0F; // only where nothing is declared: seas come close to it

// What counts as a void. Unused values are NaN, which equals nothing.
struct Voids {
    float declared = kNaN;
    float more = kNaN;
    float customary = kNaN;

    bool is_declared(float h) const { return h == declared || h == more || std::isnan(h); }
    bool is_undeclared(float h) const
    {
        return std::abs(h) >= kTooLarge || h == kShortVoid || h == customary;
    }
};

// Whether all numbers are heights for sure: none near a void that is lower than any ground, or too large, and none
// of those that are declared.
bool are_all_heights(std::span<const float> values, const Voids& voids)
{
    const float lowest = std::isnan(voids.customary) ? kShortVoid : kCustomaryVoid;
    std::uint32_t heights = 0;
    for (const float h : values) {
        const bool is_height = (h > lowest) & (h < kTooLarge) & (h != voids.declared) & (h != voids.more);
        heights += static_cast<std::uint32_t>(is_height);
    }
    return heights == values.size();
}

void to_heights(std::span<float> values, const Cleaning& how)
{
    if (how.factor == 1.0F && how.shift == 0.0F)
        return;
    for (float& value : values)
        value = value * how.factor + how.shift;
}

void clean_one_by_one(std::span<float> values, const Voids& voids, const Cleaning& how, ReadTally& tally)
{
    for (float& value : values) {
        const bool declared = voids.is_declared(value);
        const bool undeclared = !declared && voids.is_undeclared(value);
        tally.no_data += declared || undeclared ? 1U : 0U;
        tally.undeclared_voids += undeclared ? 1U : 0U;
        tally.infinities += undeclared && std::isinf(value) ? 1U : 0U;
        value = declared || undeclared ? kNaN : value * how.factor + how.shift;
    }
}

} // namespace

void clean_heights(std::span<float> values, const Cleaning& how, ReadTally& tally)
{
    constexpr std::size_t piece = 256;
    const Voids voids = {how.declared_no_data.value_or(kNaN), how.more_no_data.value_or(kNaN),
                         how.declared_no_data ? kNaN : kCustomaryVoid};
    for (std::size_t first = 0; first < values.size(); first += piece) {
        const auto part = values.subspan(first, std::min(piece, values.size() - first));
        if (are_all_heights(part, voids))
            to_heights(part, how);
        else
            clean_one_by_one(part, voids, how, tally);
    }
    tally.cells += values.size();
}

void apply_mask(std::span<float> heights, std::span<const std::uint8_t> mask, ReadTally& tally)
{
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (mask[i] != 0 || std::isnan(heights[i]))
            continue;
        heights[i] = kNaN;
        ++tally.no_data;
    }
}

} // namespace duskline
