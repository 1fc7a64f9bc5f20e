#pragma once

#include <duskline/execution/progress.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// The lowest and highest ground of every block of 2^level x 2^level grid squares, for level 1, 2, ... up to
/// one block that covers all. A block counts the samples on its border too, so the whole surface inside it
/// lies between its two numbers. NaN samples do not count; a block of nothing else has lowest = +infinity and
/// highest = -infinity.
class MinMaxPyramid {
public:
    MinMaxPyramid() = default;

    /// One pass over the heights, and two thirds of their memory. Copies the heights' ranges, keeps no view.
    explicit MinMaxPyramid(const HeightField& field, const Execution& execution = {});

    /// Levels there are: 1 .. levels(). At least 1 for a field that is not empty.
    std::size_t levels() const { return levels_.size(); }

    /// Block (block_row, block_column) of a level covers samples block_row * 2^level to
    /// (block_row + 1) * 2^level, both included, and columns alike.
    HeightRange range(std::size_t level, std::size_t block_row, std::size_t block_column) const
    {
        return levels_[level - 1](block_row, block_column);
    }

    /// Of the whole field.
    HeightRange total() const { return levels_.empty() ? HeightRange() : levels_.back()(0, 0); }

private:
    std::vector<Grid<HeightRange>> levels_;
};

} // namespace duskline
