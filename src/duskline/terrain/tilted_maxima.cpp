#include <duskline/execution/for_rows.h>
#include <duskline/terrain/tilted_maxima.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace duskline {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << TiltedMaxima::kFirstLevel;
constexpr float kNoGround_m = -std::numeric_limits<float>::infinity();

// A grid of one sample has no squares, and one block all the same.
std::size_t blocks_of(std::size_t samples)
{
    return std::max<std::size_t>((samples + kBlock - 2) / kBlock, 1);
}

// NaN is not above anything.
void raise(float& highest_m, float height_m)
{
    highest_m = height_m > highest_m ? height_m : highest_m;
}

// Of samples side by side; the last one of a block is the first of the next.
void highest_of_blocks(std::span<float> samples, std::span<float> highest)
{
    for (std::size_t x = 0; x + 1 < samples.size(); ++x) // each and the next, which vectorises
        raise(samples[x], samples[x + 1]);
    for (std::size_t block = 0; block < highest.size(); ++block) {
        const std::size_t first = block * kBlock;
        highest[block] = kNoGround_m;
        for (std::size_t x = first; x < std::min(first + kBlock, samples.size()); x += 2)
            raise(highest[block], samples[x]);
        if (first + kBlock < samples.size())
            raise(highest[block], samples[first + kBlock - 1]);
    }
}

} // namespace

TiltedMaxima::TiltedMaxima(const HeightField& field, const TiltedPlane& plane, double greatest_m,
                           const Execution& execution)
    : plane_(plane)
{
    if (field.heights_m.empty())
        return;
    // Heights, what they are lowered by along rows and columns: three roundings of numbers no greater than this.
    const double lowered_m = std::abs(plane.at(static_cast<double>(field.rows()), 0.0))
                             + std::abs(plane.at(0.0, static_cast<double>(field.columns())));
    rounding_m_ = 1e-6 * (greatest_m + 3.0 * lowered_m);
    fill_first_level(field, execution);
    while (levels_.back().highest_m.size() > 1)
        add_level();
}

// By column, over the plane's rise along rows.
void TiltedMaxima::fill_highest_of_rows(const HeightField& field, std::size_t block_row,
                                        std::vector<float>& over_m) const
{
    const std::size_t last = std::min((block_row + 1) * kBlock, field.rows() - 1);
    std::fill(over_m.begin(), over_m.end(), kNoGround_m);
    for (std::size_t row = block_row * kBlock; row <= last; ++row) {
        const float* const heights_m = field.heights_m.row(row).data();
        const auto lower_m = static_cast<float>(plane_.at(static_cast<double>(row), 0.0));
        for (std::size_t x = 0; x < over_m.size(); ++x)
            raise(over_m[x], heights_m[x] - lower_m);
    }
}

void TiltedMaxima::fill_first_level(const HeightField& field, const Execution& execution)
{
    const std::size_t columns = field.columns();
    Level first{blocks_of(field.rows()), blocks_of(columns), {}};
    first.highest_m.resize(first.rows * first.columns);
    for_rows(first.rows, 16, execution, [&](std::size_t begin, std::size_t end) {
        std::vector<float> over_m(columns);
        for (std::size_t block_row = begin; block_row < end; ++block_row) {
            fill_highest_of_rows(field, block_row, over_m);
            for (std::size_t x = 0; x < columns; ++x)
                over_m[x] -= static_cast<float>(plane_.at(0.0, static_cast<double>(x)));
            highest_of_blocks(over_m, {first.highest_m.data() + block_row * first.columns, first.columns});
        }
    });
    levels_.push_back(std::move(first));
}

void TiltedMaxima::add_level()
{
    const Level& below = levels_.back();
    Level level{(below.rows + 1) / 2, (below.columns + 1) / 2, {}};
    level.highest_m.assign(level.rows * level.columns, kNoGround_m);
    for (std::size_t y = 0; y < below.rows; ++y)
        for (std::size_t x = 0; x < below.columns; ++x)
            raise(level.highest_m[y / 2 * level.columns + x / 2], below.highest_m[y * below.columns + x]);
    levels_.push_back(std::move(level));
}

} // namespace duskline
