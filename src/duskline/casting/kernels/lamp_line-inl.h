// The inner loops of the exact front of a lamp (exact_lamp.cpp): one line of cells against brackets of the front.
//
// The beams of a lamp spread: on one line they stand `step` cells apart, on the next a little more. A unit, from one
// beam to the next, holds one sample of a line or none:
//
//        sample         beam      sample      beam   beam                  heights over the lamp's plane, divided
//      ----o--------------|-----------o---------|------|-----o------       by the distance from it: what a ray
//          |<----part---->|<-- place*step ->|                              keeps from line to line
//
// A cell above the bracket of its unit is lit, one under it in shadow; a line above the bracket all over a unit takes
// its place, one under it is forgotten; the rest is listed. Rounding is allowed for wherever two numbers meet, as a
// share of their sizes: a front comes from lines that may be a thousand times nearer to the lamp.

#if defined(DUSKLINE_LAMP_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_LAMP_LINE_INL_H_
#undef DUSKLINE_LAMP_LINE_INL_H_
#else
#define DUSKLINE_LAMP_LINE_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/kernels/open_cells-inl.h>

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline void heights_over(const float* heights, std::size_t count, float high, float low, float* over)
{
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        hn::StoreU(hn::Sub(hn::Sub(hn::LoadU(d, heights + i), hn::Set(d, high)), hn::Set(d, low)), d,
                   over + i);
    for (; i < count; ++i)
        over[i] = (heights[i] - high) - low;
}

// Places are counted from a whole cell anew for every sixteen beams, so that floats suffice and all SIMD levels
// round alike.
inline constexpr std::size_t kBeamsPerBase = 16;

inline void find_beams(const LampLine& line, std::size_t beams)
{
    const hn::CappedTag<float, kBeamsPerBase> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t lanes = hn::Lanes(d);
    const auto step = hn::Set(d, static_cast<float>(line.step));
    const auto per_line = hn::Set(d, line.per_line);
    for (std::size_t first = 0; first < beams; first += kBeamsPerBase) {
        const double base = line.first_place + static_cast<double>(first) * line.step;
        const double whole = std::floor(base);
        const auto from_whole = hn::Set(d, static_cast<float>(base - whole));
        const auto cell = hn::Set(di, static_cast<std::int32_t>(whole));
        for (std::size_t i = 0; i < kBeamsPerBase; i += lanes) {
            const auto number = hn::Iota(d, static_cast<float>(i));
            const auto place = hn::Add(from_whole, hn::Mul(number, step));
            const auto below = hn::Floor(place);
            const auto part = hn::Sub(place, below);
            const auto before = hn::Add(cell, hn::ConvertTo(di, below));
            const auto a = hn::Mul(hn::GatherIndex(d, line.over, before), per_line);
            const auto b = hn::Mul(hn::GatherIndex(d, line.over + 1, before), per_line);
            hn::StoreU(hn::Add(a, hn::Mul(hn::Sub(b, a), part)), d, line.at + first + i);
            hn::StoreU(part, d, line.part + first + i);
            hn::StoreU(before, di, line.before + first + i);
            hn::StoreU(b, d, line.next + first + i);
            hn::StoreU(hn::Add(hn::Abs(a), hn::Abs(b)), d, line.size + first + i);
        }
    }
}

template <class D>
HWY_INLINE std::size_t bracket_units(D d, const LampLine& line, std::size_t i, std::size_t found)
{
    const hn::RebindToSigned<D> di;
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1.0f);
    const auto near = hn::LoadU(d, line.at + i);
    const auto far = hn::LoadU(d, line.at + i + 1);
    const auto sample = hn::LoadU(d, line.next + i);
    const auto part = hn::LoadU(d, line.part + i);
    const auto holds =
        hn::RebindMask(d, hn::Gt(hn::LoadU(di, line.before + i + 1), hn::LoadU(di, line.before + i)));
    const auto place = hn::Min(hn::Mul(hn::Sub(one, part), hn::Set(d, line.beams_per_cell)), one);
    const auto straight = hn::Add(near, hn::Mul(hn::Sub(far, near), place));
    const auto off_chord = hn::IfThenElseZero(holds, hn::Sub(sample, straight));
    const auto peak = hn::Max(off_chord, zero);
    const auto notch = hn::Max(hn::Neg(off_chord), zero);

    const auto front_near = hn::LoadU(d, line.front + i);
    const auto front_far = hn::LoadU(d, line.front + i + 1);
    const auto above = hn::LoadU(d, line.above + i);
    const auto below = hn::LoadU(d, line.below + i);
    const auto chord = hn::Add(front_near, hn::Mul(hn::Sub(front_far, front_near), place));
    const auto own_size = hn::Add(hn::LoadU(d, line.size + i), hn::LoadU(d, line.size + i + 1));
    const auto size = hn::Add(own_size, hn::Add(hn::Abs(front_near), hn::Abs(front_far)));
    const auto slack = hn::Mul(size, hn::Set(d, kLampRounding));
    const auto own_slack = hn::Mul(own_size, hn::Set(d, kLampRounding));

    const auto lit = hn::And(holds, hn::Ge(sample, hn::Add(chord, hn::Add(above, slack))));
    const auto dark = hn::And(holds, hn::Lt(sample, hn::Sub(chord, hn::Add(below, slack))));
    // Without a sample both ends lie on one piece, known or not.
    const auto known = hn::IfThenElse(holds, sample, near);
    const auto no_data = hn::Not(hn::Eq(known, known));

    const auto over_near = hn::Sub(near, front_near);
    const auto over_far = hn::Sub(far, front_far);
    const auto sum = hn::Add(over_near, over_far);
    const auto whole = hn::Eq(sum, sum);
    const auto least = hn::Min(over_near, over_far);
    const auto most = hn::Max(over_near, over_far);
    const auto twice = hn::Add(slack, slack);
    const auto replaces = hn::And(whole, hn::Ge(least, hn::Add(hn::Add(above, notch), twice)));
    const auto forgotten = hn::And(whole, hn::Le(hn::Add(hn::Add(most, peak), hn::Add(below, twice)), zero));

    hn::StoreU(front_near, d, line.front_before + i);
    hn::StoreU(hn::IfThenElse(hn::Gt(near, front_near), near, front_near), d, line.front + i);
    hn::StoreU(hn::IfThenElse(replaces, hn::Add(peak, own_slack), above), d, line.above + i);
    hn::StoreU(hn::IfThenElse(replaces, hn::Add(notch, own_slack), below), d, line.below + i);
    const auto base = hn::LoadU(di, line.base + i);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, replaces), hn::Set(di, line.number), base), di,
               line.base + i);

    const hn::Rebind<std::uint8_t, D> du8;
    const auto answer = hn::IfThenElse(hn::RebindMask(di, no_data), hn::Set(di, 255),
                                       hn::IfThenElseZero(hn::RebindMask(di, lit), hn::Set(di, 1)));
    hn::StoreU(hn::DemoteTo(du8, answer), du8, line.answer + i);

    const auto unanswered = hn::And(holds, hn::Not(hn::Or(hn::Or(lit, dark), no_data)));
    const auto unplaced = hn::Not(hn::Or(hn::Or(replaces, forgotten), no_data));
    if (HWY_LIKELY(hn::AllFalse(d, hn::Or(unanswered, unplaced))))
        return found;
    const auto flags =
        hn::Or(hn::IfThenElseZero(hn::RebindMask(di, unanswered), hn::Set(di, OpenCell::kUnanswered)),
               hn::IfThenElseZero(hn::RebindMask(di, unplaced), hn::Set(di, OpenCell::kUnplaced)));
    return list_open(di, flags, i, line.open, found);
}

inline std::size_t bracket_lamp_line(const LampLine& line, std::size_t units)
{
    find_beams(line, units + 1);
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t found = 0;
    std::size_t i = 0;
    for (; i + lanes <= units; i += lanes)
        found = bracket_units(d, line, i, found);
    for (; i + 4 <= units; i += hn::Lanes(hn::CappedTag<float, 4>()))
        found = bracket_units(hn::CappedTag<float, 4>(), line, i, found);
    for (; i < units; ++i)
        found = bracket_units(hn::CappedTag<float, 1>(), line, i, found);
    // The last beam has no unit of its own.
    line.front_before[units] = line.front[units];
    if (line.at[units] > line.front[units])
        line.front[units] = line.at[units];
    return found;
}

// The lines across of some cells, all on one side of the lamp, from the line before to this one: lists those that may
// rise over both.
template <class D>
HWY_INLINE std::size_t rising(D d, const LampCells& cells, std::size_t i, std::size_t found)
{
    const hn::RebindToSigned<D> di;
    const auto per_line = hn::Set(d, cells.per_line);
    const auto per_line_before = hn::Set(d, cells.per_line_before);
    const auto away = hn::Abs(
        hn::Add(hn::Set(d, cells.first_away), hn::Iota(d, static_cast<float>(i)))); // cells beside the lamp
    const auto outwards = hn::Mul(away, per_line_before);
    const auto inwards = hn::Mul(away, per_line);
    const auto here = hn::Mul(hn::LoadU(d, cells.over + i), per_line);
    const auto outer =
        hn::Mul(hn::LoadU(d, cells.over + cells.outwards + static_cast<std::ptrdiff_t>(i)), per_line);
    const auto before = hn::Mul(hn::LoadU(d, cells.over_before + i), per_line_before);
    const auto inner = hn::Mul(
        hn::LoadU(d, cells.over_before - cells.outwards + static_cast<std::ptrdiff_t>(i)), per_line_before);

    const auto rounding = hn::Set(d, kLampRounding);
    const auto sizes = hn::Add(hn::Abs(here), hn::Abs(before));
    const auto slack_here = hn::Mul(rounding, hn::Add(sizes, hn::Abs(outer)));
    const auto slack_before = hn::Mul(rounding, hn::Add(sizes, hn::Abs(inner)));
    const auto this_line = hn::Add(here, hn::Mul(hn::Sub(outer, here), outwards));
    const auto line_before = hn::Add(before, hn::Mul(hn::Sub(inner, before), inwards));
    // A NaN beside them leaves the line across alone: not under, as far as is known.
    // Beyond the neighbour the lines are not looked at.
    const auto one = hn::Set(d, 1.0f);
    const auto under_this = hn::And(hn::Le(hn::Add(before, slack_here), this_line), hn::Le(outwards, one));
    const auto under_before = hn::And(hn::Le(hn::Add(here, slack_before), line_before), hn::Le(inwards, one));
    const auto there = hn::Add(here, before);
    const auto rises = hn::AndNot(hn::Or(under_this, under_before), hn::Eq(there, there));
    if (HWY_LIKELY(hn::AllFalse(d, rises)))
        return found;
    HWY_ALIGN std::int32_t each[hn::MaxLanes(hn::ScalableTag<float>())];
    hn::Store(hn::IfThenElseZero(hn::RebindMask(di, rises), hn::Set(di, 1)), di, each);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
        if (each[lane] != 0)
            cells.rising[found++] = static_cast<std::uint32_t>(i + lane);
    return found;
}

inline std::size_t rising_lines_across(const LampCells& cells, std::size_t count)
{
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t found = 0;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        found = rising(d, cells, i, found);
    for (; i < count; ++i)
        found = rising(hn::CappedTag<float, 1>(), cells, i, found);
    return found;
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
