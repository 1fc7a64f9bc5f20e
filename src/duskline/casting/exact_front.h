#pragma once

// The exact front over a part of the beams and lines of a light, into a mask that is there already: what
// `cast_by_exact` and `TerrainShadows` share. Not installed.

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>

#include <cstddef>

namespace duskline {

/// Lines [first_line, last_line) of a light's frame, and beams [first_beam, last_beam) over them: beam k is next to
/// cell k + sideways * whole (kernels::BeamShift). In cells of the grid a parallelogram.
struct BeamPart {
    std::size_t first_line = 0;
    std::size_t first_answered = 0; ///< the line from which on cells are answered; the front starts earlier
    std::size_t last_line = 0;
    std::ptrdiff_t first_beam = 0;
    std::ptrdiff_t last_beam = 0;
};

/// 1 when the light of a frame moves towards higher cells, else -1.
inline std::ptrdiff_t sideways_of(const LightFrame& frame)
{
    return frame.lateral < 0.0 ? -1 : 1;
}

/// All lines, and all beams that meet a cell. For a field of at least one cell.
BeamPart all_beams(const HeightField& field, const LightFrame& frame);

/// Casts the cells of a part from its line first_answered on, as `cast_by_exact` would, and leaves the others as they
/// are. Ground on lines before the part counts for nothing, so it must be out of their reach.
/// `highest_m`: the greatest magnitude of all heights. The light must have no uniform answer.
void cast_exact_part(const HeightField& field, const DirectionalLight& light, double highest_m,
                     const BeamPart& part, GridView<Lit> mask, const Execution& execution,
                     const kernels::Kernels& kernels);

} // namespace duskline
