#pragma once

#include <duskline/casting/kernels/kernels.h>
#include <duskline/execution/for_rows.h>
#include <duskline/terrain/height_field.h>

#include <algorithm>
#include <vector>

namespace duskline {

/// The greatest magnitude among all heights; 0 when there are none. A pass in SIMD, where only a bound on heights is
/// wanted. Takes the threads of `execution`, not its progress. Not installed.
inline float greatest_magnitude_m(const kernels::Kernels& kernels, const HeightField& field,
                                  const Execution& execution)
{
    std::vector<float> greatest_m(field.rows(), 0.0f);
    for_rows(field.rows(), 64, {.threads = execution.threads}, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            greatest_m[y] = kernels.highest_magnitude(field.heights_m.row(y).data(), field.columns());
    });
    return greatest_m.empty() ? 0.0f : std::ranges::max(greatest_m);
}

} // namespace duskline
