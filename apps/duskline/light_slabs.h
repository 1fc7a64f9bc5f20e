#pragma once

#include <duskline/casting/light_frame.h>
#include <duskline/raster_io/read_height_field.h>

#include <cstddef>
#include <vector>

namespace duskline::cli {

/// Neighbouring rows, or columns, of a grid.
struct Slab {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Lines to a slab at least, but for the last.
inline constexpr std::size_t kLeastLines = 256;

/// Lines to a slab: some hundred, whole blocks of those lengths where that is possible without taking very many.
std::size_t slab_lines(std::size_t input_block, std::size_t output_block);

/// All lines of a file in slabs of `at_once` lines, blocks of the file whole, in the order the light meets them.
std::vector<Slab> slabs_in_light_order(const HeightFile& file, const LightFrame& frame, std::size_t at_once);

} // namespace duskline::cli
