#pragma once

#include <duskline/terrain/height_field.h>

#include <optional>

namespace duskline {

/// How high the ground lies at a place between samples, metres: bilinear between the four around it, so that on
/// the lines of the grid it is the surface itself. Rows and columns count from the centre of cell (0, 0).
/// Nothing outside the grid and beside missing samples, but for places within a millionth of a cell of the
/// samples that are there.
std::optional<double> ground_height_m(const HeightField& field, double row, double column);

} // namespace duskline
