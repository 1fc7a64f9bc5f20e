// One pass over numbers just read, while they are in the cache. Written so that compilers vectorise it: values
// that decide are prepared outside the loop, and nothing in it branches.

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
};

struct Counts {
    std::uint32_t no_data = 0;
    std::uint32_t undeclared = 0;
    std::uint32_t infinite = 0;
};

// At most 2^24 values, so that the counts fit the lanes of a vector.
Counts clean_piece(float* values, std::size_t count, const Voids& voids, float factor, float shift)
{
    std::uint32_t no_data = 0;
    std::uint32_t undeclared = 0;
    std::uint32_t infinite = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float h = values[i];
        const float size = std::abs(h);
        const std::uint32_t is_infinite = size > std::numeric_limits<float>::max() ? 1U : 0U;
        const std::uint32_t is_declared =
            (h == voids.declared ? 1U : 0U) | (h == voids.more ? 1U : 0U) | (h != h ? 1U : 0U);
        const std::uint32_t is_void =
            (size >= kTooLarge ? 1U : 0U) | (h == kShortVoid ? 1U : 0U) | (h == voids.customary ? 1U : 0U);
        const std::uint32_t is_nothing = is_declared | is_void;
        values[i] = is_nothing != 0U ? kNaN : h * factor + shift;
        no_data += is_nothing;
        undeclared += is_void & (is_declared ^ 1U);
        infinite += is_infinite & (is_declared ^ 1U);
    }
    return {no_data, undeclared, infinite};
}

} // namespace

void clean_heights(std::span<float> values, const Cleaning& how, ReadTally& tally)
{
    const Voids voids = {how.declared_no_data.value_or(kNaN), how.more_no_data.value_or(kNaN),
                         how.declared_no_data ? kNaN : kCustomaryVoid};
    constexpr std::size_t piece = std::size_t{1} << 24U;
    for (std::size_t first = 0; first < values.size(); first += piece) {
        const Counts counts = clean_piece(values.data() + first, std::min(piece, values.size() - first),
                                          voids, how.factor, how.shift);
        tally.no_data += counts.no_data;
        tally.undeclared_voids += counts.undeclared;
        tally.infinities += counts.infinite;
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
