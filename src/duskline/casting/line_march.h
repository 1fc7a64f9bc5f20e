#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/light/point_light.h>

namespace duskline {

/// The march of the textbooks: from every cell one cell at a time towards the light, asking at each step whether
/// the terrain there is higher than the ray. A step is one cell long, counted in cells along the ground. The ray
/// ends where it leaves the grid, before a lamp, and once it is above the highest ground.
///
/// The two casters differ in what they take for the height at a step: `line_march` that of the nearest sample (the
/// place rounded), `line_march_bilinear` the bilinear surface between the four around it. What a step does not land
/// on is not seen, so both miss crests narrower than a step; and the nearest sample lies up to 0.7 cells beside the
/// ray, so that `line_march` darkens slopes in low light. See docs/algorithms/line-march.md.
///
/// A sample without data, or a surface that touches one, casts nothing. Same bits for any number of threads and for
/// a window that holds all the ground the rays meet. Throws InvalidInput for angles, places or cell sizes out of
/// range, Cancelled. Cost: O(cells x steps), in double precision; the steps of a lit cell are as many as the light
/// needs to climb from it above the highest ground.
ShadowMask cast_by_line_march(const HeightField& field, const DirectionalLight& light,
                              const Execution& execution = {});
ShadowMask cast_by_line_march_bilinear(const HeightField& field, const DirectionalLight& light,
                                       const Execution& execution = {});

/// The shadow heights of the same marches, rounded up to float: `mask_of` them is the mask.
ShadowField shadow_heights_by_line_march(const HeightField& field, const DirectionalLight& light,
                                         const Execution& execution = {});
ShadowField shadow_heights_by_line_march_bilinear(const HeightField& field, const DirectionalLight& light,
                                                  const Execution& execution = {});

/// The same towards a lamp, or towards a sun that stands at a place. The last step ends before it. As for `ray`, a
/// lamp under the ground lights nothing, and one within a billionth of a cell of a line of samples is on it.
ShadowMask cast_by_line_march(const HeightField& field, const PointLight& light,
                              const Execution& execution = {});
ShadowMask cast_by_line_march_bilinear(const HeightField& field, const PointLight& light,
                                       const Execution& execution = {});
ShadowField shadow_heights_by_line_march(const HeightField& field, const PointLight& light,
                                         const Execution& execution = {});
ShadowField shadow_heights_by_line_march_bilinear(const HeightField& field, const PointLight& light,
                                                  const Execution& execution = {});

} // namespace duskline
