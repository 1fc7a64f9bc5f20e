// The inner loop of the sweep (sweep.cpp): one line of cells against the front of beams.
//
// Beams stand half a cell apart, two over each cell, and the cell between the nearer of them and one behind it:
//
//        behind    cell i  nearer    farther      cell ahead     (light moving to the right)
//          x.........o.......x.........x.............o
//                    |<--f-->|
//                    |<-----f + 1/2--->|
//
// Where light runs along cells every beam passes over cells alone: one over each does, and the farther is left out.
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

// Beams of one comb on a line, shifted so that index i means the one ahead of cell i, by `fraction` of a cell.
struct Beams {
    const float* front;
    float* next;
    float fraction;
};

// One line, shifted so that index i means cell i and its beams.
template <bool kHalfway>
struct Line {
    const float* cell;
    const float* cell_ahead;
    const float* next_line; // its cell i
    const float* fetch;     // what is fetched while cell i is worked on
    Beams nearer;
    Beams farther; // with kHalfway
    const float* behind;
    float behind_share; // of the way from the nearer beam to the one behind, where the cell is
    float tilt_m;       // what the front's heights are above true ones here
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
template <class D, bool kHalfway>
HWY_INLINE Swept<D> sweep_cells(D d, const Line<kHalfway>& line, std::size_t i)
{
    const auto tilt = hn::Set(d, line.tilt_m);
    hwy::Prefetch(line.fetch + i);
    const auto ground = hn::LoadU(d, line.cell + i);
    const auto ahead = hn::LoadU(d, line.cell_ahead + i);
    const auto ground_tilted = hn::Add(ground, tilt);
    const auto rise = hn::Sub(ahead, ground);
    const auto known = hn::Eq(rise, rise);
    const bool all_known = hn::AllTrue(d, known);
    const auto carry_on = [&](const Beams& beams, hn::Vec<D> front) {
        auto under_beam = hn::Add(ground_tilted, hn::Mul(rise, hn::Set(d, beams.fraction)));
        if (HWY_UNLIKELY(!all_known)) // beside a hole: half a cell around a sample casts
            under_beam =
                hn::IfThenElse(known, under_beam, hn::Add(beams.fraction < 0.5f ? ground : ahead, tilt));
        hn::StoreU(higher_or(d, under_beam, front), d, beams.next + i);
    };
    const auto nearer = hn::LoadU(d, line.nearer.front + i);
    const auto behind = hn::LoadU(d, line.behind + i);
    carry_on(line.nearer, nearer);
    if constexpr (kHalfway)
        carry_on(line.farther, hn::LoadU(d, line.farther.front + i));
    const auto front = hn::Add(nearer, hn::Mul(hn::Sub(behind, nearer), hn::Set(d, line.behind_share)));
    return {ground, ground_tilted, front, all_known};
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

// A byte for each answer: 1 for true, else 0.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::uint8_t, D>> as_bytes(D, hn::Mask<D> answers)
{
    const hn::RebindToUnsigned<D> du;
    return hn::U8FromU32(hn::IfThenElseZero(hn::RebindMask(du, answers), hn::Set(du, 1)));
}

// Answers with a byte: 1 lit, 0 shadow, 255 no data.
struct MaskAnswer {
    std::uint8_t* out;

    template <class D, class Line>
    HWY_INLINE void cells(D d, const Line& line, std::size_t i) const
    {
        const hn::Rebind<std::uint8_t, D> du8;
        const auto swept = sweep_cells(d, line, i);
        auto answer = as_bytes(d, is_lit(d, swept));
        if (HWY_UNLIKELY(!swept.all_known))
            answer = hn::Or(answer, hn::Sub(hn::Zero(du8), as_bytes(d, is_no_data(d, swept))));
        hn::StoreU(answer, du8, out + i);
    }
};

// Answers with the height of the shadow over the cell.
struct ShadowHeightAnswer {
    float* out;

    template <class D, class Line>
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

template <class Line, class Answer>
HWY_INLINE void sweep_line(Line line, std::size_t first, std::size_t last, const Answer& answer)
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
    i += lanes - reinterpret_cast<std::uintptr_t>(line.nearer.front + first) / sizeof(float) % lanes;
    line.fetch = line.cell + kCellsFetchedAhead;
    for (; i + lanes + kCellsFetchedAhead <= last; i += lanes)
        answer.cells(d, line, i);
    line.fetch = line.next_line - i;
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

// The comb half a cell further.
inline BeamShift halfway(BeamShift shift)
{
    return shift.fraction < 0.5f ? BeamShift{shift.whole, shift.fraction + 0.5f}
                                 : BeamShift{shift.whole + 1, shift.fraction - 0.5f};
}

// The beams of a comb whose cells the strip does not answer: the one that a beam is interpolated with or that will
// be, and the one that is about to enter the grid. `moved`: cells that the comb is ahead of the strip's.
inline void carry_other_beams(const StripLines& strip, const float* heights, BeamShift shift,
                              std::ptrdiff_t moved, float tilt_m, const float* front, float* next)
{
    const std::ptrdiff_t unanswered = strip.sideways > 0
                                          ? (moved == 0 ? strip.first_beam - 1 : strip.last_beam - 1)
                                          : (moved == 0 ? strip.last_beam : strip.first_beam);
    const std::ptrdiff_t outside = strip.sideways > 0 ? -1 : static_cast<std::ptrdiff_t>(strip.cells);
    const std::ptrdiff_t entering = outside - strip.sideways * shift.whole;
    carry_beam(strip, heights, shift, tilt_m, unanswered, front, next);
    if (entering >= strip.first_beam - 1 && entering <= strip.last_beam)
        carry_beam(strip, heights, shift, tilt_m, entering, front, next);
}

// The line's beams from cell `first` on.
template <bool kHalfway>
Line<kHalfway> line_of(const SweepLines& sweep, BeamShift shift, const float* heights, float tilt_m,
                       std::ptrdiff_t first)
{
    const StripLines& strip = sweep.strip;
    const std::ptrdiff_t sideways = strip.sideways;
    // In a comb's arrays, the beam ahead of a cell.
    const auto at = [&](BeamShift comb) { return first + 1 - strip.first_beam - sideways * comb.whole; };
    const auto comb = [&](const CombFront& front, BeamShift its) {
        return Beams{front.newer + at(its), front.other + at(its), its.fraction};
    };
    Line<kHalfway> line{};
    line.cell = line.fetch = heights + first;
    line.next_line = line.cell + strip.line_step;
    line.tilt_m = tilt_m;
    if constexpr (kHalfway) {
        line.cell_ahead = line.cell + sideways;
        line.nearer = comb(sweep.beams, shift);
        line.farther = comb(sweep.halfway, halfway(shift));
        if (line.farther.fraction < line.nearer.fraction)
            std::swap(line.nearer, line.farther);
        line.behind = line.farther.front - sideways;
        line.behind_share = 2.0f * line.nearer.fraction;
    } else {
        line.cell_ahead = line.cell;
        line.nearer = comb(sweep.beams, shift);
        line.behind = line.nearer.front;
    }
    return line;
}

template <bool kHalfway, class MakeAnswer>
HWY_INLINE void sweep_lines(SweepLines sweep, const MakeAnswer& answer_for_line)
{
    const StripLines& strip = sweep.strip;
    const std::ptrdiff_t sideways = strip.sideways;
    const auto beams = static_cast<std::size_t>(strip.last_beam - strip.first_beam + 2);
    const auto cells = static_cast<std::ptrdiff_t>(strip.cells);
    const auto lower = [&](float* front) {
        for (std::size_t k = 0; k < beams; ++k)
            front[k] -= sweep.drop_m * static_cast<float>(kLinesPerTilt);
    };

    for (std::size_t i = 0; i < strip.lines; ++i) {
        const std::size_t v = strip.first_line + i;
        if (v % kLinesPerTilt == 0 && v != 0) {
            lower(sweep.beams.newer);
            if constexpr (kHalfway)
                lower(sweep.halfway.newer);
        }
        const BeamShift shift = strip.shifts[i];
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(strip.first_beam + sideways * shift.whole, 0);
        const std::ptrdiff_t last = std::min(strip.last_beam + sideways * shift.whole, cells);
        const float* heights = strip.heights + static_cast<std::ptrdiff_t>(i) * strip.line_step
                               - static_cast<std::ptrdiff_t>(strip.first_cell);
        const float tilt_m = sweep.drop_m * static_cast<float>(v % kLinesPerTilt);
        carry_other_beams(strip, heights, shift, 0, tilt_m, sweep.beams.newer, sweep.beams.other);
        if constexpr (kHalfway) {
            const BeamShift further = halfway(shift);
            carry_other_beams(strip, heights, further, further.whole - shift.whole, tilt_m,
                              sweep.halfway.newer, sweep.halfway.other);
        }
        if (first < last) {
            const auto line = line_of<kHalfway>(sweep, shift, heights, tilt_m, first);
            const auto answer = answer_for_line(i, first);
            const auto count = static_cast<std::size_t>(last - first);
            // The beams ahead of the outermost cell have left the grid. They shade nothing but that cell, which is
            // compared with what they pass, so they go on over ground like the cell's.
            const bool from_edge = kHalfway && sideways < 0 && first == 0;
            const bool to_edge = kHalfway && sideways > 0 && last == cells;
            sweep_line(line, from_edge ? 1 : 0, to_edge ? count - 1 : count, answer);
            if (from_edge || to_edge) {
                auto alone = line;
                alone.cell_ahead = line.cell;
                answer.cells(hn::CappedTag<float, 1>(), alone, from_edge ? 0 : count - 1);
            }
        }
        std::swap(sweep.beams.newer, sweep.beams.other);
        std::swap(sweep.halfway.newer, sweep.halfway.other);
    }
}

template <class MakeAnswer>
HWY_INLINE void sweep_all_lines(const SweepLines& sweep, const MakeAnswer& answer_for_line)
{
    if (sweep.halfway.newer != nullptr)
        sweep_lines<true>(sweep, answer_for_line);
    else
        sweep_lines<false>(sweep, answer_for_line);
}

inline void sweep_mask(const SweepLines& sweep, std::uint8_t* lit, std::ptrdiff_t lit_line_step)
{
    sweep_all_lines(sweep, [&](std::size_t i, std::ptrdiff_t first) {
        return MaskAnswer{lit + static_cast<std::ptrdiff_t>(i) * lit_line_step + first
                          - static_cast<std::ptrdiff_t>(sweep.strip.first_cell)};
    });
}

inline void sweep_shadow_heights(const SweepLines& sweep, float* shadow_m, std::ptrdiff_t shadow_line_step)
{
    sweep_all_lines(sweep, [&](std::size_t i, std::ptrdiff_t first) {
        return ShadowHeightAnswer{shadow_m + static_cast<std::ptrdiff_t>(i) * shadow_line_step + first
                                  - static_cast<std::ptrdiff_t>(sweep.strip.first_cell)};
    });
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
