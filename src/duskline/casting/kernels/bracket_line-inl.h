// The inner loop of the exact front (exact.cpp): one line of cells against brackets of the front.
//
// A unit of the front lies between two beams and holds one cell of every line, `fraction` from the near beam:
//
//        far beam                  near beam                      heights in the frame of the beams
//            |            o cell       |
//      far_m +-------___./             |  far_m, near_m   highest ground that passed under either beam
//            |          /  `--.______  |  chord           straight between those two
//            |<-- 1-f -->|<--- f --->| + near_m           front: between chord - below and chord + above
//
// A cell above the bracket is lit, one under it in shadow; a line that lies above the bracket all over its unit
// takes its place, one that lies under it is forgotten. What is left, one cell in a hundred, is listed.

#if defined(DUSKLINE_BRACKET_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_BRACKET_LINE_INL_H_
#undef DUSKLINE_BRACKET_LINE_INL_H_
#else
#define DUSKLINE_BRACKET_LINE_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/kernels/open_cells-inl.h>
#include <duskline/casting/kernels/sweep_lines-inl.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Not NaN and at least, as `Ge`; named for reading.
template <class D>
HWY_INLINE hn::Mask<D> is_nan(D, hn::Vec<D> value)
{
    return hn::Not(hn::Eq(value, value));
}

// The column lines of cells i .. between the line before and this one: those that may rise over both lines.
template <class D>
HWY_INLINE hn::Mask<D> may_rise_between(D d, const BracketLine& line, std::size_t i, hn::Vec<D> ground,
                                        hn::Vec<D> ahead)
{
    const auto slope = hn::Set(d, line.slope);
    const auto drop = hn::Set(d, line.drop_m);
    const auto slack = hn::Set(d, line.slack_m);
    const auto before = hn::LoadU(d, line.cell_before + i);
    const auto behind_before = hn::LoadU(d, line.behind_before + i);
    const auto this_line = hn::Add(ground, hn::Mul(hn::Sub(ahead, ground), slope));
    const auto line_before = hn::Add(before, hn::Mul(hn::Sub(behind_before, before), slope));
    // A NaN beside them leaves the column line alone: not under, as far as is known.
    const auto under_this = hn::Le(hn::Add(hn::Sub(before, drop), slack), this_line);
    const auto under_before = hn::Le(hn::Add(hn::Add(ground, drop), slack), line_before);
    const auto there = hn::And(hn::Eq(before, before), hn::Eq(ground, ground));
    return hn::AndNot(hn::Or(under_this, under_before), there);
}

template <class D>
HWY_INLINE std::size_t bracket_cells(D d, const BracketLine& line, std::size_t i, std::size_t found)
{
    const auto fraction = hn::Set(d, line.fraction);
    const auto tilt = hn::Set(d, line.tilt_m);
    const auto slack = hn::Set(d, line.slack_m);
    const auto zero = hn::Zero(d);
    hwy::Prefetch(line.next_cell + i);
    const auto ground = hn::LoadU(d, line.cell + i);
    const auto ahead = hn::LoadU(d, line.ahead + i);
    const auto behind = hn::LoadU(d, line.behind + i);

    // This line at the cell and at both beams, and how far the cell lies off their chord.
    const auto at_cell = hn::Add(ground, tilt);
    const auto at_near = hn::Add(at_cell, hn::Mul(hn::Sub(ahead, ground), fraction));
    const auto at_far = hn::Add(hn::Add(behind, tilt), hn::Mul(hn::Sub(ground, behind), fraction));
    const auto off_chord = hn::Sub(at_cell, hn::Add(at_near, hn::Mul(hn::Sub(at_far, at_near), fraction)));
    const auto peak = hn::Max(off_chord, zero);
    const auto notch = hn::Max(hn::Neg(off_chord), zero);

    const auto near = hn::LoadU(d, line.near + i);
    const auto far = hn::LoadU(d, line.far + i);
    const auto above = hn::LoadU(d, line.above + i);
    const auto below = hn::LoadU(d, line.below + i);
    const auto chord = hn::Add(near, hn::Mul(hn::Sub(far, near), fraction));

    const auto lit = hn::Ge(at_cell, hn::Add(chord, hn::Add(above, slack)));
    const auto dark = hn::Lt(at_cell, hn::Sub(chord, hn::Add(below, slack)));
    const auto no_data = is_nan(d, ground);

    const auto over_near = hn::Sub(at_near, near);
    const auto over_far = hn::Sub(at_far, far);
    const auto sum = hn::Add(over_near, over_far);
    const auto whole = hn::Eq(sum, sum); // both ends known
    const auto least = hn::Min(over_near, over_far);
    const auto most = hn::Max(over_near, over_far);
    const auto twice = hn::Add(slack, slack);
    const auto replaces = hn::And(whole, hn::Ge(least, hn::Add(hn::Add(above, notch), twice)));
    const auto forgotten = hn::And(whole, hn::Le(hn::Add(hn::Add(most, peak), hn::Add(below, twice)), zero));

    hn::StoreU(higher_or(d, at_near, near), d, line.next_near + i);
    hn::StoreU(hn::IfThenElse(replaces, peak, above), d, line.above + i);
    hn::StoreU(hn::IfThenElse(replaces, notch, below), d, line.below + i);
    const hn::RebindToSigned<D> di;
    const auto base = hn::LoadU(di, line.base + i);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, replaces), hn::Set(di, line.number), base), di,
               line.base + i);

    const hn::Rebind<std::uint8_t, D> du8;
    const auto answer = hn::IfThenElse(hn::RebindMask(di, no_data), hn::Set(di, 255),
                                       hn::IfThenElseZero(hn::RebindMask(di, lit), hn::Set(di, 1)));
    hn::StoreU(hn::DemoteTo(du8, answer), du8, line.lit + i);

    const auto unanswered = hn::Not(hn::Or(hn::Or(lit, dark), no_data));
    const auto unplaced = hn::Not(hn::Or(hn::Or(replaces, forgotten), no_data));
    auto open = hn::Or(unanswered, unplaced);
    auto rises = hn::MaskFromVec(zero);
    if (line.cell_before != nullptr) {
        rises = may_rise_between(d, line, i, ground, ahead);
        open = hn::Or(open, rises);
    }
    if (HWY_LIKELY(hn::AllFalse(d, open)))
        return found;
    const auto flags =
        hn::Or(hn::Or(hn::IfThenElseZero(hn::RebindMask(di, unanswered), hn::Set(di, OpenCell::kUnanswered)),
                      hn::IfThenElseZero(hn::RebindMask(di, unplaced), hn::Set(di, OpenCell::kUnplaced))),
               hn::IfThenElseZero(hn::RebindMask(di, rises), hn::Set(di, OpenCell::kRises)));
    return list_open(di, flags, i, line.open, found);
}

inline std::size_t bracket_line(const BracketLine& line, std::size_t cells)
{
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t found = 0;
    std::size_t i = 0;
    for (; i + lanes <= cells; i += lanes)
        found = bracket_cells(d, line, i, found);
    for (; i + 4 <= cells; i += hn::Lanes(hn::CappedTag<float, 4>()))
        found = bracket_cells(hn::CappedTag<float, 4>(), line, i, found);
    for (; i < cells; ++i)
        found = bracket_cells(hn::CappedTag<float, 1>(), line, i, found);
    return found;
}

inline float highest_magnitude(const float* values, std::size_t count)
{
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    auto highest = hn::Zero(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        highest = higher_or(d, hn::Abs(hn::LoadU(d, values + i)), highest);
    float result = hn::GetLane(hn::MaxOfLanes(d, highest));
    for (; i < count; ++i)
        if (std::abs(values[i]) > result)
            result = std::abs(values[i]);
    return result;
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
