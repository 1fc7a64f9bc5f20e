#pragma once

// Grids that must lie over a terrain cell by cell. Not installed.

#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <string>

namespace duskline {

inline std::string size_text(std::size_t rows, std::size_t columns)
{
    return std::to_string(rows) + " x " + std::to_string(columns);
}

/// `grid` has rows() and columns(). Throws InvalidInput, with both sizes, unless they are the terrain's; `what` names
/// the grid.
template <typename Sized>
void require_same_size(const char* what, const Sized& grid, const HeightField& field)
{
    if (grid.rows() != field.rows() || grid.columns() != field.columns())
        throw InvalidInput(std::string(what) + " must have the size of the terrain, "
                           + size_text(field.rows(), field.columns()) + ", got "
                           + size_text(grid.rows(), grid.columns()));
}

} // namespace duskline
