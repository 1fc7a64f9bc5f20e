#include <duskline/execution/for_rows.h>
#include <duskline/terrain/min_max_pyramid.h>

#include <algorithm>

namespace duskline {

namespace {

// Blocks of two that cover `count` blocks, or the squares between `count` + 1 samples; at least one.
std::size_t halved(std::size_t count)
{
    return std::max<std::size_t>((count + 1) / 2, 1);
}

// One row of the first level: blocks of 3 x 3 samples that share their border samples.
void gather(std::span<HeightRange> blocks, std::span<const float> heights_m)
{
    for (std::size_t x = 0; x < blocks.size(); ++x) {
        blocks[x].include(heights_m[2 * x]);
        if (2 * x + 1 < heights_m.size())
            blocks[x].include(heights_m[2 * x + 1]);
        if (2 * x + 2 < heights_m.size())
            blocks[x].include(heights_m[2 * x + 2]);
    }
}

Grid<HeightRange> first_level(const HeightField& field, const Execution& execution)
{
    Grid<HeightRange> level(halved(field.rows() - 1), halved(field.columns() - 1), HeightRange());
    for_rows(level.rows(), 16, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block)
            for (std::size_t y = 2 * block; y < std::min(2 * block + 3, field.rows()); ++y)
                gather(level.row(block), field.heights_m.row(y));
    });
    return level;
}

Grid<HeightRange> next_level(const Grid<HeightRange>& below)
{
    Grid<HeightRange> level(halved(below.rows()), halved(below.columns()), HeightRange());
    for (std::size_t y = 0; y < below.rows(); ++y)
        for (std::size_t x = 0; x < below.columns(); ++x)
            level(y / 2, x / 2).include(below(y, x));
    return level;
}

} // namespace

MinMaxPyramid::MinMaxPyramid(const HeightField& field, const Execution& execution)
{
    if (field.heights_m.empty())
        return;
    // The first level is three quarters of the work, and all of it that is reported.
    levels_.push_back(first_level(field, execution));
    while (levels_.back().size() > 1)
        levels_.push_back(next_level(levels_.back()));
}

} // namespace duskline
