#include <duskline/execution/for_rows.h>
#include <duskline/products/block_means.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

float mean_of_block(GridView<const float> block)
{
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t y = 0; y < block.rows(); ++y)
        for (const float value : block.row(y))
            if (!std::isnan(value)) {
                sum += value;
                ++count;
            }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count))
                     : std::numeric_limits<float>::quiet_NaN();
}

// Running mean over 2 radius + 1 values; beyond the ends the end value goes on.
void running_mean(std::span<float> values, std::size_t radius, std::vector<float>& copy)
{
    copy.assign(values.begin(), values.end());
    const auto at = [&](std::ptrdiff_t i) {
        return copy[static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(i, 0, static_cast<std::ptrdiff_t>(copy.size()) - 1))];
    };
    const auto reach = static_cast<std::ptrdiff_t>(radius);
    double sum = 0.0;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i)
        sum += at(i);
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(copy.size()); ++i) {
        values[static_cast<std::size_t>(i)] = static_cast<float>(sum / static_cast<double>(2 * radius + 1));
        sum += static_cast<double>(at(i + reach + 1)) - at(i - reach);
    }
}

// Radii of three running means that together have about the variance of the Gaussian: a running mean of
// w = 2 r + 1 values has the variance (w^2 - 1) / 12.
std::array<std::size_t, 3> running_mean_radii(double sigma)
{
    const double radius = std::floor((std::sqrt(4.0 * sigma * sigma + 1.0) - 1.0) / 2.0);
    const double narrow = (2.0 * radius + 1.0) * (2.0 * radius + 1.0);
    const double wide = (2.0 * radius + 3.0) * (2.0 * radius + 3.0);
    const double wide_ones = (12.0 * sigma * sigma + 3.0 - 3.0 * narrow) / (wide - narrow);
    std::array<std::size_t, 3> radii = {};
    for (std::size_t i = 0; i < 3; ++i)
        radii[i] = static_cast<std::size_t>(radius) + (static_cast<double>(i) + 0.5 < wide_ones ? 1 : 0);
    return radii;
}

Grid<float> transposed(const Grid<float>& grid)
{
    Grid<float> result(grid.columns(), grid.rows());
    for (std::size_t y = 0; y < grid.rows(); ++y)
        for (std::size_t x = 0; x < grid.columns(); ++x)
            result(x, y) = grid(y, x);
    return result;
}

} // namespace

BlockMeans::BlockMeans(GridView<const float> values, std::size_t block, const Execution& execution)
    : block_(block), means_(values.rows() / block + 2, values.columns() / block + 2, 0.0f)
{
    assert(block >= 1 && block <= values.rows() && block <= values.columns());
    for_rows(means_.rows() - 2, 8, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            for (std::size_t x = 0; x < means_.columns() - 2; ++x)
                means_(y + 1, x + 1) = mean_of_block(values.window(y * block, x * block, block, block));
    });
    fill_empty_blocks();
    extend_beyond_border();
    across_.reserve(values.columns());
    for (std::size_t x = 0; x < values.columns(); ++x)
        across_.push_back(taps_at(x, means_.columns()));
}

BlockMeans::Taps BlockMeans::taps_at(std::size_t cell, std::size_t blocks_with_margin) const
{
    const double place = (static_cast<double>(cell) + 0.5) / static_cast<double>(block_) + 0.5;
    const double last = static_cast<double>(blocks_with_margin) - 2.0;
    const double centre = std::clamp(std::floor(place + 0.5), 1.0, last);
    const auto t = static_cast<float>(place - centre);
    return {static_cast<std::size_t>(centre) - 1,
            {0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t, 0.5f * (0.5f + t) * (0.5f + t)}};
}

void BlockMeans::fill_empty_blocks()
{
    const Grid<float> known = means_.copy();
    for (std::size_t y = 1; y + 1 < means_.rows(); ++y)
        for (std::size_t x = 1; x + 1 < means_.columns(); ++x) {
            if (!std::isnan(known(y, x)))
                continue;
            double sum = 0.0;
            int count = 0;
            for (std::size_t j = std::max<std::size_t>(y - 1, 1); j <= std::min(y + 1, means_.rows() - 2);
                 ++j)
                for (std::size_t i = std::max<std::size_t>(x - 1, 1);
                     i <= std::min(x + 1, means_.columns() - 2); ++i)
                    if (!std::isnan(known(j, i))) {
                        sum += known(j, i);
                        ++count;
                    }
            means_(y, x) = count > 0 ? static_cast<float>(sum / count) : 0.0f;
        }
}

void BlockMeans::extend_beyond_border()
{
    const std::size_t bottom = means_.rows() - 1;
    const std::size_t right = means_.columns() - 1;
    const auto beyond = [](float last, float before, bool alone) {
        return alone ? last : 2.0f * last - before;
    };
    for (std::size_t x = 1; x < right; ++x) {
        means_(0, x) = beyond(means_(1, x), means_(2, x), bottom == 2);
        means_(bottom, x) = beyond(means_(bottom - 1, x), means_(bottom - 2, x), bottom == 2);
    }
    for (std::size_t y = 0; y <= bottom; ++y) {
        means_(y, 0) = beyond(means_(y, 1), means_(y, 2), right == 2);
        means_(y, right) = beyond(means_(y, right - 1), means_(y, right - 2), right == 2);
    }
}

void BlockMeans::smooth(double sigma_cells)
{
    const auto radii = running_mean_radii(sigma_cells / static_cast<double>(block_));
    std::vector<float> copy;
    for (int direction = 0; direction < 2; ++direction) {
        for (std::size_t y = 0; y < means_.rows(); ++y)
            for (const std::size_t radius : radii)
                running_mean(means_.row(y), radius, copy);
        means_ = transposed(means_);
    }
}

void BlockMeans::row(std::size_t row, std::span<float> out) const
{
    const Taps down = taps_at(row, means_.rows());
    std::vector<float> blended(means_.columns());
    for (std::size_t x = 0; x < blended.size(); ++x)
        blended[x] = down.weights[0] * means_(down.first, x) + down.weights[1] * means_(down.first + 1, x)
                     + down.weights[2] * means_(down.first + 2, x);
    for (std::size_t x = 0; x < out.size(); ++x) {
        const Taps& across = across_[x];
        const float* blocks = &blended[across.first];
        out[x] =
            across.weights[0] * blocks[0] + across.weights[1] * blocks[1] + across.weights[2] * blocks[2];
    }
}

} // namespace duskline
