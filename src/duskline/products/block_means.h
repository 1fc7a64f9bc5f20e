#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace duskline {

/// A coarse, smooth likeness of a grid: the means of its blocks of `block` x `block` values, read back at any
/// cell through quadratic B-splines, so without facets or seams. A plane comes back as that plane, up to the
/// border: blocks beyond it carry on what the last two inside do, and the rest of a side that is no multiple
/// of the block counts as beyond.
///
/// NaN values do not count; a block of nothing else takes the mean of its neighbours. Where all of those are
/// empty, too, what comes back is 0.
class BlockMeans {
public:
    /// One pass over the values. `block` is at least 1 and at most the shorter side of the grid (asserted).
    BlockMeans(GridView<const float> values, std::size_t block, const Execution& execution = {});

    /// Smooths further, close to a Gaussian of that standard deviation in cells (three running means; Wells,
    /// Efficient synthesis of Gaussian filters by cascaded uniform filters, PAMI 1986).
    void smooth(double sigma_cells);

    /// The values of one row of the grid.
    void row(std::size_t row, std::span<float> out) const;

    std::size_t block() const { return block_; }

private:
    void fill_empty_blocks();
    void extend_beyond_border();

    // The three blocks around a cell, the first counted with the margin, and what each contributes.
    struct Taps {
        std::size_t first;
        std::array<float, 3> weights;
    };
    Taps taps_at(std::size_t cell, std::size_t blocks_with_margin) const;

    std::size_t block_;
    Grid<float> means_;        // one block wider than the grid on each side
    std::vector<Taps> across_; // of every column
};

} // namespace duskline
