#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/light/point_light.h>

namespace duskline {

/// The shadow mask of a terrain on finer cells: not the mask blown up, and not the shadow of finer samples, but a ray
/// over the terrain's own surface from the ground under the centre of every finer cell that may be at an edge.
///
///   field   the terrain
///   mask    its mask under `light`, by an exact caster
///   finer   `refined(field, rows, columns)`: says where the finer cells lie; they take its size
///
/// A finer cell in a cell whose eight neighbours agree with it has that cell's answer, so a shadow narrower than a
/// cell and between all centres is not seen. `unknown` where `finer` has no data. From `finer` itself a caster would
/// cut off the crests between its samples; see docs/algorithms/light_map.md for how much that is.
///
/// Same bytes for any number of threads. Throws InvalidInput for sizes that do not fit and lights out of range,
/// Cancelled. About a microsecond for each finer cell at an edge.
ShadowMask finer_mask(const HeightField& field, const ShadowMask& mask, const DirectionalLight& light,
                      const HeightField& finer, const Execution& execution = {});

/// The same for a lamp, at its place over the cells of `field`.
ShadowMask finer_mask(const HeightField& field, const ShadowMask& mask, const PointLight& light,
                      const HeightField& finer, const Execution& execution = {});

} // namespace duskline
