#include "light_slabs.h"

#include <algorithm>
#include <numeric>

namespace duskline::cli {

std::size_t slab_lines(std::size_t input_block, std::size_t output_block)
{
    const std::size_t larger = std::max(input_block, output_block);
    const std::size_t both = std::lcm(input_block, output_block);
    const std::size_t step = both <= 4 * larger ? both : larger;
    return (kLeastLines + step - 1) / step * step;
}

std::vector<Slab> slabs_in_light_order(const HeightFile& file, const LightFrame& frame, std::size_t at_once)
{
    const std::size_t lines = frame.lines_are_rows ? file.rows() : file.columns();
    const GroundFrame& ground = file.ground();
    const bool flipped = frame.lines_are_rows ? ground.rows_flipped : ground.columns_flipped;
    std::vector<Slab> slabs;
    for (std::size_t first = 0; first < lines; first += at_once) { // in the order of the file
        const std::size_t count = std::min(at_once, lines - first);
        slabs.push_back({flipped ? lines - first - count : first, count});
    }
    if (flipped == frame.first_line_is_index_0)
        std::ranges::reverse(slabs);
    return slabs;
}

} // namespace duskline::cli
