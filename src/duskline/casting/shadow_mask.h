#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/light/directional_light.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace duskline {

/// What became of one cell. A byte, so that a mask goes to a file as it is.
enum class Lit : std::uint8_t { no = 0, yes = 1, unknown = 255 };

/// One answer per cell of the height field it was cast on; `unknown` where the heights have no data.
using ShadowMask = Grid<Lit>;

/// Shadow heights, metres, rounded up to float, so that the mask they mean (`mask_of`) is the mask itself:
/// a point above the cell is in shadow when it lies below this height. At or under the ground where the
/// ground is lit, minus infinity where nothing towards the light can shade the cell, plus infinity when the
/// light is at or below the horizon, NaN where the heights have no data.
using ShadowField = Grid<float>;

/// The one answer for all cells that some lights give: `no` at or below the horizon, `yes` straight
/// overhead. Empty for every other light.
std::optional<Lit> uniform_answer(const DirectionalLight& light);

/// `answer` in every cell with data, `unknown` elsewhere.
ShadowMask uniform_mask(const HeightField& field, Lit answer);

/// The shadow heights that go with `uniform_mask`: plus infinity for `no`, minus infinity for `yes`.
ShadowField uniform_shadow_heights(const HeightField& field, Lit answer);

/// A shadow height as a ShadowField holds it: the least float that is not below it. Rounded to the nearest, a
/// shadow that just covers the ground would sink to it and be gone.
float shadow_height_as_float(double height_m);

/// The mask that shadow heights mean for the ground they were cast on: lit where ground >= shadow height.
ShadowMask mask_of(const HeightField& field, const ShadowField& shadow_heights_m);

/// Whether one of the eight neighbours has another answer than the cell: an edge of shadow may pass through it.
/// No data is no answer.
bool has_other_neighbour(const ShadowMask& mask, std::size_t row, std::size_t column);

} // namespace duskline
