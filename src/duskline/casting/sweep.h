#pragma once

#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace duskline {

namespace kernels {
struct Kernels;
}

/// Shadows by one pass over the grid, away from the light, that carries a front of shadow heights: one beam
/// of light per cell of a line, its height the highest ground it has passed. The fastest caster; differs
/// from `ray` in a few cells in ten thousand, all beside a shadow edge, because heights between samples and
/// fronts between beams are interpolated.
///
/// No data is skipped and stays unknown. Same bytes for any number of threads and any SIMD level.
/// Throws InvalidInput for angles or cell sizes out of range, Cancelled. Cost: O(cells), about that of copying
/// the heights once.
ShadowMask cast_by_sweep(const HeightField& field, const DirectionalLight& light,
                         const Execution& execution = {});

/// The shadow heights of the same sweep; `mask_of` them is the mask, up to rounding of the heights.
ShadowField shadow_heights_by_sweep(const HeightField& field, const DirectionalLight& light,
                                    const Execution& execution = {});

/// A sweep that is fed line by line, for terrain that comes in pieces: read a block of lines nearest the
/// light, advance, and the answers for that block are final. Lines are rows or columns as the frame says, and
/// come in light order, every line once. However they are cut into blocks, the bytes are the same.
///
/// Memory: four floats per beam (at most twice the cells of a line), and per thread some 600 KiB.
class SweepFront {
public:
    /// A front that has met nothing yet, for `lines` lines of `cells` cells.
    SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame);

    /// The same with the SIMD level of that name (see `runnable_kernels`). Throws InvalidInput for another.
    SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame, std::string_view isa);

    /// Carries the front over the next `heights.lines` lines and answers each of their cells. Both have
    /// `cells` cells a line; one of line step and cell step must be 1 or -1 (rows or columns of a grid).
    /// After Cancelled the front is of no more use.
    void advance(const LightOrder<const float>& heights, const LightOrder<Lit>& mask,
                 const Execution& execution);
    void advance(const LightOrder<const float>& heights, const LightOrder<float>& shadow_heights_m,
                 const Execution& execution);

private:
    template <typename Answer>
    void advance_strips(const LightOrder<const float>& heights, const LightOrder<Answer>& answers,
                        const Execution& execution);

    const kernels::Kernels* kernels_;
    LightFrame frame_;
    std::size_t cells_;
    std::size_t next_line_ = 0;
    std::ptrdiff_t first_beam_;                 // the beam whose height is front_m_[.][1]
    bool halfway_;                              // whether there are beams half a cell from the others
    std::array<std::vector<float>, 2> front_m_; // the beams, and those halfway
    std::array<std::vector<float>, 2> next_front_m_;
};

} // namespace duskline
