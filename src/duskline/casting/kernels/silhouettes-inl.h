// The inner loops of the silhouette map (smap_beams.cpp): which sections of a line hold a silhouette, and the parallel
// search for the next of them. Lanes are neighbouring beams; the four lines that the paper packs into one RGBA texel
// are taken together, since from the second pass on they look up the same places.

#if defined(DUSKLINE_SILHOUETTES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DUSKLINE_SILHOUETTES_INL_H_
#undef DUSKLINE_SILHOUETTES_INL_H_
#else
#define DUSKLINE_SILHOUETTES_INL_H_
#endif

#include <duskline/casting/kernels/kernels.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace duskline::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A straight piece between two of the five places, at either end: how much the line before, and the line after, are
// lower than this line seen along the light. Not below 0 means towards the light, and away from it.
template <class D>
struct PieceEnd {
    hn::Vec<D> over_before;
    hn::Vec<D> over_after;
    hn::Mask<D> towards;
    hn::Mask<D> away;
};

template <class D>
HWY_INLINE hn::Vec<D> height_at(D d, const float* samples, const SectionTap& tap, std::size_t i)
{
    const float* const from = samples + tap.sample + i;
    const auto first = hn::LoadU(d, from);
    if (tap.share == 0.0f) // whatever is missing beside it
        return first;
    const auto rise = hn::Sub(hn::LoadU(d, from + 1), first);
    return hn::Add(first, hn::Mul(rise, hn::Set(d, tap.share)));
}

// Not below, which what is not known is not.
template <class D>
HWY_INLINE hn::Mask<D> not_below(hn::Vec<D> a, hn::Vec<D> b)
{
    return hn::Not(hn::Lt(a, b));
}

template <class D>
HWY_INLINE PieceEnd<D> piece_end(D d, const SilhouetteLine& line, std::size_t place, std::size_t i)
{
    const auto own = height_at(d, line.own, line.taps->own[place], i);
    const auto before = height_at(d, line.before, line.taps->before[place], i);
    const auto after = height_at(d, line.after, line.taps->after[place], i);
    const auto over_before = hn::Add(hn::Sub(own, before), hn::Set(d, line.rise_m));
    const auto over_after = hn::Add(hn::Sub(own, after), hn::Set(d, line.fall_m));
    const auto zero = hn::Zero(d);
    return {over_before, over_after, not_below<D>(over_before, zero), not_below<D>(over_after, zero)};
}

// Whether both are towards and away somewhere between the ends: at one of them, or where one turns before the other.
template <class D>
HWY_INLINE hn::Mask<D> piece_holds_silhouette(const PieceEnd<D>& a, const PieceEnd<D>& b)
{
    const auto down = hn::Mul(a.over_before, b.over_after);
    const auto up = hn::Mul(b.over_before, a.over_after);
    const auto at_an_end = hn::Or(hn::And(a.towards, a.away), hn::And(b.towards, b.away));
    const auto from_a_to_b = hn::And(hn::And(a.towards, b.away), not_below<D>(down, up));
    const auto from_b_to_a = hn::And(hn::And(b.towards, a.away), not_below<D>(up, down));
    return hn::Or(at_an_end, hn::Or(from_a_to_b, from_b_to_a));
}

template <class D>
HWY_INLINE hn::Mask<D> is_known(hn::Vec<D> values)
{
    return hn::Eq(values, values);
}

// Whether there is any ground in the section: its second sample always lies in it.
template <class D>
HWY_INLINE hn::Mask<D> has_ground(D d, const SilhouetteLine& line, std::size_t i)
{
    auto known = is_known<D>(hn::LoadU(d, line.own + 1 + i));
    if (line.first_sample_counts)
        known = hn::Or(known, is_known<D>(hn::LoadU(d, line.own + i)));
    return known;
}

// Straight bounds over and under the ground of the section: its chord, moved up or down to its middle sample.
template <class D>
HWY_INLINE void bound_ground(D d, const SilhouetteLine& line, std::size_t i)
{
    const auto first = height_at(d, line.own, {0, line.part}, i);
    const auto last = height_at(d, line.own, {1, line.part}, i);
    const auto sample = hn::LoadU(d, line.own + 1 + i);
    const auto chord = hn::Add(first, hn::Mul(hn::Sub(last, first), hn::Set(d, 1.0f - line.part)));
    const auto bulge = hn::Sub(sample, chord);
    const auto rounding = hn::Set(d, line.rounding_m);
    const auto zero = hn::Zero(d);
    const auto up = hn::Add(hn::IfThenElse(hn::Gt(bulge, zero), bulge, zero), rounding);
    const auto down = hn::Add(hn::IfThenElse(hn::Gt(zero, bulge), hn::Neg(bulge), zero), rounding);
    const auto tilt = hn::Set(d, line.tilt_m);
    const auto first_tilted = hn::Add(first, tilt);
    const auto last_tilted = hn::Add(last, tilt);
    hn::StoreU(hn::Add(first_tilted, up), d, line.out.highest_first + i);
    hn::StoreU(hn::Add(last_tilted, up), d, line.out.highest_last + i);
    hn::StoreU(hn::Sub(first_tilted, down), d, line.out.lowest_first + i);
    hn::StoreU(hn::Sub(last_tilted, down), d, line.out.lowest_last + i);
}

// Colours the sections of one line of a band, and bounds their ground.
inline void mark_silhouettes(const SilhouetteLine& line)
{
    const hn::CappedTag<float, kBeamsPerBand> d;
    const hn::RebindToSigned<decltype(d)> di;
    for (std::size_t i = 0; i < kBeamsPerBand; i += hn::Lanes(d)) {
        auto end = piece_end(d, line, 0, i);
        auto black = hn::FirstN(d, 0);
        for (std::size_t place = 1; place < kSectionPlaces; ++place) {
            const auto next = piece_end(d, line, place, i);
            black = hn::Or(black, piece_holds_silhouette(end, next));
            end = next;
        }
        black = hn::And(black, has_ground(d, line, i));
        hn::StoreU(hn::IfThenElseZero(hn::RebindMask(di, black), hn::Set(di, 1)), di, line.out.texels + i);
        bound_ground(d, line, i);
    }
}

// Beams i .. i + Lanes - 1 of a band. Candidates are numbers of lines of the band, plus 1; 0 is none.
class SilhouetteLanes {
public:
    using D = hn::CappedTag<float, kBeamsPerBand>;
    using DI = hn::RebindToSigned<D>;
    using Vec = hn::Vec<DI>;
    using Mask = hn::Mask<DI>;

    SilhouetteLanes(const SilhouetteBand& band, std::size_t i)
        : band_(band), i_(i), lane_(hn::Iota(DI(), static_cast<std::int32_t>(i)))
    {}

    // What the texels of a line offer those after it: themselves where Black, else their NextV.
    Vec offer(std::size_t line) const
    {
        const Vec texels = load(line);
        const Mask black = hn::Ne(hn::And(texels, hn::Set(DI(), 1)), hn::Zero(DI()));
        return hn::IfThenElse(black, hn::Set(DI(), static_cast<std::int32_t>(line) + 1),
                              hn::ShiftRight<1>(texels));
    }

    // Gives the offered to the texels of a line that know no NextV yet and that it may shadow, or else whatever comes
    // after it and may.
    void take(std::size_t line, Vec offered) const
    {
        const Vec texels = load(line);
        const Mask unknown = hn::Eq(hn::ShiftRight<1>(texels), hn::Zero(DI()));
        Vec next = hn::IfThenElseZero(unknown, offered);
        if (hn::AllFalse(DI(), exists(next)))
            return;
        if (band_.better)
            next = past_those_that_cannot_shadow(line, next);
        store(line, hn::Or(texels, hn::ShiftLeft<1>(next)));
    }

    // Moves the NextV of a line on while the one after it covers it wholly.
    void skip_covered(std::size_t line) const
    {
        const Vec texels = load(line);
        Vec next = hn::ShiftRight<1>(texels);
        while (!hn::AllFalse(DI(), exists(next))) {
            const Vec index = index_of(next);
            const Vec after = hn::IfThenElseZero(
                exists(next), hn::ShiftRight<1>(hn::GatherIndex(DI(), band_.texels, index)));
            if (hn::AllFalse(DI(), exists(after)))
                break;
            const Vec after_index = index_of(after);
            const Mask covered =
                hn::And(exists(after), not_above(index, gather(band_.lowest_first, after_index),
                                                 gather(band_.lowest_last, after_index)));
            if (hn::AllFalse(DI(), covered))
                break;
            next = hn::IfThenElse(covered, after, next);
        }
        store(line, hn::Or(hn::And(texels, hn::Set(DI(), 1)), hn::ShiftLeft<1>(next)));
    }

private:
    Vec load(std::size_t line) const { return hn::LoadU(DI(), band_.texels + line * kBeamsPerBand + i_); }
    void store(std::size_t line, Vec texels) const
    {
        hn::StoreU(texels, DI(), band_.texels + line * kBeamsPerBand + i_);
    }

    static Mask exists(Vec candidate) { return hn::Gt(candidate, hn::Zero(DI())); }

    // Of the texel of a candidate; of some texel of the beam where there is none.
    Vec index_of(Vec candidate) const
    {
        const Vec line = hn::Max(hn::Sub(candidate, hn::Set(DI(), 1)), hn::Zero(DI()));
        return hn::Add(hn::ShiftLeft<kBeamsPerBandLog2>(line), lane_);
    }

    hn::Vec<D> gather(const float* values, Vec index) const { return hn::GatherIndex(D(), values, index); }

    // Whether the highest ground there is not above some bounds.
    Mask not_above(Vec index, hn::Vec<D> lowest_first, hn::Vec<D> lowest_last) const
    {
        return hn::RebindMask(DI(), hn::And(hn::Le(gather(band_.highest_first, index), lowest_first),
                                            hn::Le(gather(band_.highest_last, index), lowest_last)));
    }

    Vec past_those_that_cannot_shadow(std::size_t line, Vec next) const
    {
        const auto lowest_first = hn::LoadU(D(), band_.lowest_first + line * kBeamsPerBand + i_);
        const auto lowest_last = hn::LoadU(D(), band_.lowest_last + line * kBeamsPerBand + i_);
        for (;;) {
            const Mask candidates = exists(next);
            if (hn::AllFalse(DI(), candidates))
                return next;
            const Vec index = index_of(next);
            const Mask cannot = hn::And(candidates, not_above(index, lowest_first, lowest_last));
            if (hn::AllFalse(DI(), cannot))
                return next;
            next =
                hn::IfThenElse(cannot, hn::ShiftRight<1>(hn::GatherIndex(DI(), band_.texels, index)), next);
        }
    }

    const SilhouetteBand& band_;
    std::size_t i_;
    Vec lane_;
};

// Merges four blocks of `distance` lines into one, the farthest from the light first: what is looked up is not yet
// changed. Lines of a group of four have their look-ups in common.
inline void merge_four_blocks(const SilhouetteBand& band, std::size_t distance)
{
    const std::size_t group = std::min<std::size_t>(distance, 4);
    for (std::size_t end = band.first_line + band.lines; end > band.first_line;) {
        const std::size_t v = std::max((end - 1) / group * group, band.first_line);
        const std::size_t block = v / distance * distance;
        const std::size_t blocks_before = v / distance % 4;
        for (std::size_t i = 0; i < kBeamsPerBand; i += hn::Lanes(SilhouetteLanes::D())) {
            const SilhouetteLanes lanes(band, i);
            for (std::size_t k = 0; k < blocks_before && block - k * distance > band.first_line; ++k) {
                const auto offered = lanes.offer(block - k * distance - 1 - band.first_line);
                for (std::size_t line = v; line < end; ++line)
                    lanes.take(line - band.first_line, offered);
            }
        }
        end = v;
    }
}

// NextV of all texels of a band, by the parallel quad search.
inline void search_next_silhouettes(const SilhouetteBand& band)
{
    for (std::size_t distance = 1; distance < band.first_line + band.lines; distance *= 4)
        merge_four_blocks(band, distance);
    if (!band.better)
        return;
    for (std::size_t line = band.lines; line-- > 0;)
        for (std::size_t i = 0; i < kBeamsPerBand; i += hn::Lanes(SilhouetteLanes::D()))
            SilhouetteLanes(band, i).skip_covered(line);
}

} // namespace HWY_NAMESPACE
} // namespace duskline::kernels
HWY_AFTER_NAMESPACE();

#endif // include guard per target
