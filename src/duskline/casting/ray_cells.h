#pragma once

// One ray per cell: what the plain ray and the fast ray do with a whole terrain. Not installed.

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/for_rows.h>

#include <cmath>
#include <limits>

namespace duskline {

/// Calls `cell(row, column)` for every cell, rows shared among threads.
template <typename Cell>
void for_cells(const HeightField& field, const Execution& execution, const Cell& cell)
{
    for_rows(field.rows(), 4, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < field.columns(); ++column)
                cell(row, column);
    });
}

/// `shadow_m(row, column, ground_m)` is the shadow height over a cell, right where it is above the ground.
template <typename Shadow>
ShadowMask mask_by_rays(const HeightField& field, const Execution& execution, const Shadow& shadow_m)
{
    ShadowMask mask(field.rows(), field.columns());
    for_cells(field, execution, [&](std::size_t row, std::size_t column) {
        const double ground_m = field.heights_m(row, column);
        if (std::isnan(ground_m))
            mask(row, column) = Lit::unknown;
        else
            mask(row, column) = ground_m >= shadow_m(row, column, ground_m) ? Lit::yes : Lit::no;
    });
    return mask;
}

/// `shadow_m(row, column)` is the shadow height over a cell.
template <typename Shadow>
ShadowField shadow_heights_by_rays(const HeightField& field, const Execution& execution,
                                   const Shadow& shadow_m)
{
    ShadowField shadows(field.rows(), field.columns());
    for_cells(field, execution, [&](std::size_t row, std::size_t column) {
        shadows(row, column) = std::isnan(field.heights_m(row, column))
                                   ? std::numeric_limits<float>::quiet_NaN()
                                   : shadow_height_as_float(shadow_m(row, column));
    });
    return shadows;
}

} // namespace duskline
