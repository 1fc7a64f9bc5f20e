// The inner loop of the sweep (sweep.cpp): one line of cells against the front of beams.
//
// Cell i stands between beam i, `fraction` of a cell ahead of it, and beam i's neighbour behind; beam i stands
// between cell i and the cell ahead, `fraction` of the way:
//
//      far beam      cell i   beam i     far cell            (light moving to the right)
//          x...........o.......x...........o
//          |<--1-f---->|<--f-->|
//
// Everything is interpolated from the nearer one, near + (far - near) * f, which keeps level ground level to
// the last bit and makes mirrored terrain give mirrored answers.

#if defined(DUSKLINE_SWEEP_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_SWEEP_LINES_INL_H_
#undef DUSKLINE_SWEEP_LINES_INL_H_
#else
#define DUSKLINE_SWEEP_LINES_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A front below this is one that no ground has raised yet. Finite, because it is interpolated.
inline constexpr float kRaised_m = -1.0e20f;

// Half a page. The processor's own prefetching stops at the end of each page.
inline constexpr std::size_t kCellsFetchedAhead = 512;

// One line, shifted so that index i means cell i and its beam.
struct Line {
    const float* near_cell;
    const float* far_cell;
    const float* near_beam;
    const float* far_beam;
    float* next_beam;
    float fraction;
    float tilt_m; // what the front's heights are above true ones here
};

// What is known of some cells once their line is swept.
template <class D>
struct Swept {
    hn::Vec<D> ground;
    hn::Vec<D> ground_tilted;
    hn::Vec<D> front;
    bool all_known; // none of them is without data
};

// The greater of the two; `otherwise` when `candidate` is NaN.
template <class D>
HWY_INLINE hn::Vec<D> higher_or(D, hn::Vec<D> candidate, hn::Vec<D> otherwise)
{
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
    return hn::Max(candidate, otherwise); // maxps gives its second operand when either is NaN
#else
    return hn::IfThenElse(hn::Gt(candidate, otherwise), candidate, otherwise);
#endif
}

// Cells i .. i + Lanes(d) - 1: what their answers need, and their beams carried on.
template <class D>
HWY_INLINE Swept<D> sweep_cells(D d, const Line& line, std::size_t i)
{
    const auto fraction = hn::Set(d, line.fraction);
    const auto tilt = hn::Set(d, line.tilt_m);
    hwy::Prefetch(line.near_cell + i + kCellsFetchedAhead);
    const auto ground = hn::LoadU(d, line.near_cell + i);
    const auto ahead = hn::LoadU(d, line.far_cell + i);
    const auto beam = hn::LoadU(d, line.near_beam + i);
    const auto behind = hn::LoadU(d, line.far_beam + i);

    const auto ground_tilted = hn::Add(ground, tilt);
    const auto rise = hn::Sub(ahead, ground);
    const auto known = hn::Eq(rise, rise);
    const bool all_known = hn::AllTrue(d, known);
    auto under_beam = hn::Add(ground_tilted, hn::Mul(rise, fraction));
    if (HWY_UNLIKELY(!all_known)) // beside a hole: half a cell around a sample casts
        under_beam = hn::IfThenElse(known, under_beam, hn::Add(line.fraction < 0.5f ? ground : ahead, tilt));
    hn::StoreU(higher_or(d, under_beam, beam), d, line.next_beam + i);
    return {ground, ground_tilted, hn::Add(beam, hn::Mul(hn::Sub(behind, beam), fraction)), all_known};
}

template <class D>
HWY_INLINE hn::Mask<D> is_lit(D, const Swept<D>& cells)
{
    return hn::Ge(cells.ground_tilted, cells.front);
}

template <class D>
HWY_INLINE hn::Mask<D> is_no_data(D, const Swept<D>& cells)
{
    return hn::Not(hn::Eq(cells.ground, cells.ground));
}

// Answers with a byte: 1 lit, 0 shadow, 255 no data.
struct MaskAnswer {
    std::uint8_t* out;

    template <class D>
    HWY_INLINE void cells(D d, const Line& line, std::size_t i) const
    {
        const hn::RebindToUnsigned<D> du;
        const hn::Rebind<std::uint8_t, D> du8;
        const auto swept = sweep_cells(d, line, i);
        auto answer = hn::IfThenElseZero(hn::RebindMask(du, is_lit(d, swept)), hn::Set(du, 1));
        if (HWY_UNLIKELY(!swept.all_known))
            answer = hn::IfThenElse(hn::RebindMask(du, is_no_data(d, swept)), hn::Set(du, 255), answer);
        hn::StoreU(hn::U8FromU32(answer), du8, out + i);
    }
};

// Answers with the height of the shadow over the cell.
struct ShadowHeightAnswer {
    float* out;

    template <class D>
    HWY_INLINE void cells(D d, const Line& line, std::size_t i) const
    {
        const auto swept = sweep_cells(d, line, i);
        const auto none = hn::Set(d, -std::numeric_limits<float>::infinity());
        const auto raised = hn::Gt(swept.front, hn::Set(d, kRaised_m));
        const auto shadow = hn::IfThenElse(raised, hn::Sub(swept.front, hn::Set(d, line.tilt_m)), none);
        const auto no_data = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
        hn::StoreU(hn::IfThenElse(is_no_data(d, swept), no_data, shadow), d, out + i);
    }
};

template <class Answer>
HWY_INLINE void sweep_line(const Line& line, std::size_t first, std::size_t last, const Answer& answer)
{
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = first;
    if (last - first < lanes) {
        for (; i < last; ++i)
            answer.cells(hn::CappedTag<float, 1>(), line, i);
        return;
    }
    // Some cells twice, so that registers of beams begin where cache lines do, and at the end. The front goes to
    // another copy: nothing is carried twice.
    answer.cells(d, line, i);
    i += lanes - reinterpret_cast<std::uintptr_t>(line.near_beam + first) / sizeof(float) % lanes;
    for (; i + lanes <= last; i += lanes)
        answer.cells(d, line, i);
    if (i < last)
        answer.cells(d, line, last - lanes);
}

// One beam carried on, whose cell is not answered, and may be the one just outside the grid: what `sweep_cells`
// does.
inline void carry_beam(const StripLines& strip, const float* heights, BeamShift shift, float tilt_m,
                       std::ptrdiff_t beam, const float* front, float* next)
{
    const std::ptrdiff_t cell = beam + strip.sideways * shift.whole;
    const std::ptrdiff_t slot = beam - (strip.first_beam - 1);
    const auto height_m = [&](std::ptrdiff_t u) {
        const bool inside = u >= 0 && u < static_cast<std::ptrdiff_t>(strip.cells);
        return inside ? heights[u] : std::numeric_limits<float>::quiet_NaN();
    };
    const float ground = height_m(cell);
    const float ahead = shift.fraction == 0.0f ? ground : height_m(cell + strip.sideways);
    float under_beam = (ground + tilt_m) + (ahead - ground) * shift.fraction;
    if (std::isnan(under_beam))
        under_beam = (shift.fraction < 0.5f ? ground : ahead) + tilt_m;
    next[slot] = under_beam > front[slot] ? under_beam : front[slot];
}

// The beams whose cells are not answered: the neighbour that the strip's beams are interpolated with, and the
// beam that is about to enter the grid.
inline void carry_other_beams(const StripLines& strip, const float* heights, BeamShift shift, float tilt_m,
                              const float* front, float* next)
{
    const std::ptrdiff_t neighbour = strip.sideways > 0 ? strip.first_beam - 1 : strip.last_beam;
    const std::ptrdiff_t outside = strip.sideways > 0 ? -1 : static_cast<std::ptrdiff_t>(strip.cells);
    const std::ptrdiff_t entering = outside - strip.sideways * shift.whole;
    carry_beam(strip, heights, shift, tilt_m, neighbour, front, next);
    if (entering >= strip.first_beam && entering < strip.last_beam)
        carry_beam(strip, heights, shift, tilt_m, entering, front, next);
}

template <class MakeAnswer>
HWY_INLINE float* sweep_lines(const SweepLines& sweep, const MakeAnswer& answer_for_line)
{
    const StripLines& strip = sweep.strip;
    const std::ptrdiff_t sideways = strip.sideways;
    const auto beams = static_cast<std::size_t>(strip.last_beam - strip.first_beam + 2);
    const auto cells = static_cast<std::ptrdiff_t>(strip.cells);
    float* front = sweep.front;
    float* next = sweep.other_front;

    for (std::size_t i = 0; i < strip.lines; ++i) {
        const std::size_t v = strip.first_line + i;
        if (v % kLinesPerTilt == 0 && v != 0)
            for (std::size_t k = 0; k < beams; ++k)
                front[k] -= sweep.drop_m * static_cast<float>(kLinesPerTilt);

        const BeamShift shift = strip.shifts[i];
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(strip.first_beam + sideways * shift.whole, 0);
        const std::ptrdiff_t last = std::min(strip.last_beam + sideways * shift.whole, cells);
        const float* heights = strip.heights + static_cast<std::ptrdiff_t>(i) * strip.line_step
                               - static_cast<std::ptrdiff_t>(strip.first_cell);
        const float tilt_m = sweep.drop_m * static_cast<float>(v % kLinesPerTilt);
        carry_other_beams(strip, heights, shift, tilt_m, front, next);
        if (first < last) {
            const std::ptrdiff_t far = shift.fraction == 0.0f ? 0 : sideways;
            // Cell j and the slot of its beam in the two copies of the front.
            const std::ptrdiff_t slot = 1 - strip.first_beam - sideways * shift.whole;
            const Line line{heights + first,
                            heights + first + far,
                            front + first + slot,
                            front + first + slot - far,
                            next + first + slot,
                            shift.fraction,
                            tilt_m};
            const auto answer = answer_for_line(i, first);
            const auto count = static_cast<std::size_t>(last - first);
            // The beam ahead of the outermost cell has left the grid. It shades nothing but that cell, which is
            // compared with what it passes, so it goes on over ground like the cell's.
            const bool from_edge = far < 0 && first == 0;
            const bool to_edge = far > 0 && last == cells;
            sweep_line(line, from_edge ? 1 : 0, to_edge ? count - 1 : count, answer);
            if (from_edge || to_edge) {
                const std::size_t edge = from_edge ? 0 : count - 1;
                Line alone = line;
                alone.far_cell = line.near_cell;
                answer.cells(hn::CappedTag<float, 1>(), alone, edge);
            }
        }
        std::swap(front, next);
    }
    return front;
}

inline float* sweep_mask(const SweepLines& sweep, std::uint8_t* lit, std::ptrdiff_t lit_line_step)
{
    return sweep_lines(sweep, [&](std::size_t i, std::ptrdiff_t first) {
        return MaskAnswer{lit + static_cast<std::ptrdiff_t>(i) * lit_line_step + first
                          - static_cast<std::ptrdiff_t>(sweep.strip.first_cell)};
    });
}

inline float* sweep_shadow_heights(const SweepLines& sweep, float* shadow_m, std::ptrdiff_t shadow_line_step)
{
    return sweep_lines(sweep, [&](std::size_t i, std::ptrdiff_t first) {
        return ShadowHeightAnswer{shadow_m + static_cast<std::ptrdiff_t>(i) * shadow_line_step + first
                                  - static_cast<std::ptrdiff_t>(sweep.strip.first_cell)};
    });
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
