#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/light/point_light.h>

#include <string_view>

namespace duskline {

/// The answers of `ray` at the price of a sweep: the true front of the light, carried over the grid line by line
/// between an upper and a lower bracket, and worked out only where a cell or a line falls between the two.
///
/// Every cell near the front is decided by the crossings that `ray` itself would decide it by, in double
/// precision and by the same formula; the others are further from it than float rounding can reach. Two
/// crossings that lie on one straight line may be taken for one, which can tip a cell whose ground touches its
/// ray to a billionth of a metre. No data, borders, ties: as for `ray`.
///
/// Same bytes for any number of threads and any SIMD level. Throws InvalidInput for angles or cell sizes out of
/// range, Cancelled. Cost: O(cells) and a little for every cell at the edge of a shadow; memory: 50 bytes per
/// beam.
ShadowMask cast_by_exact(const HeightField& field, const DirectionalLight& light,
                         const Execution& execution = {});

/// The same with the SIMD level of that name (see `kernels::runnable_kernels`). Throws InvalidInput for another.
ShadowMask cast_by_exact(const HeightField& field, const DirectionalLight& light, const Execution& execution,
                         std::string_view isa);

/// The shadow heights that go with it, rounded to float. Cost: some ten times the mask's.
ShadowField shadow_heights_by_exact(const HeightField& field, const DirectionalLight& light,
                                    const Execution& execution = {});

/// The same for a lamp: the answers of `ray`, as for the sun. Cost: a few times a sun's; memory: some 100 bytes for
/// every beam of a strip of 1024 cells or so, and for each thread.
ShadowMask cast_by_exact(const HeightField& field, const PointLight& light, const Execution& execution = {});
ShadowMask cast_by_exact(const HeightField& field, const PointLight& light, const Execution& execution,
                         std::string_view isa);
ShadowField shadow_heights_by_exact(const HeightField& field, const PointLight& light,
                                    const Execution& execution = {});

} // namespace duskline
