// Shadows by sweeping a front of shadow heights away from the light.
//
// In the frame of the light (light_frame.h) a beam that passes over u = k on line 0 is over k + lateral * v on
// line v, and has fallen by drop_m * v. Seen by the beam the ground rises by that much instead, and a front of
// one height per beam need only remember the highest ground so far:
//
//      line v-1   o----o-x--o-x--o-x--      o cells   x beams
//                        |    |    |        front[k] = max(front[k], ground under the beam + drop_m * v)
//      line v     o--x-o--x-o--x-o---
//
// Two such combs of beams, half a cell apart, unless beams pass over cells alone.
//
// A cell is lit when its own ground reaches the front between its two beams. No height is ever resampled from
// the front, so far edges stay sharp, and every cell is visited once, whatever the length of the shadows.
//
// Beams know nothing of each other but for that last comparison, so threads take strips of neighbouring beams.
// When lines are columns of the grid, blocks of it are turned in cache first.
//
// Departs from an exact sweep in two places: ground between two cells and front between two beams are taken to
// be linear. Both are wrong only next to an edge of shadow. Lines along the light between cells are not tested.
//
// The idea of a height that travels with the light: Timonen and Westerholm, Scalable Height Field Self-Shadowing,
// Eurographics 2010, who keep a convex hull where one sun needs only a maximum.

#include <duskline/casting/beam_strips.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/sweep.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace duskline {

namespace {

using kernels::Kernels;
using kernels::StripLines;
using kernels::SweepLines;

// Lower than any ground, and finite, because fronts are interpolated.
constexpr float kNoShadow_m = -1.0e30f;

// Steeper light than this shades nothing anyone could have measured; more would overflow the tilt.
constexpr double kSteepestDrop_m = 1.0e15;

void sweep(const Kernels& kernels, const SweepLines& lines, Lit* mask, std::ptrdiff_t line_step)
{
    kernels.sweep_mask(lines, as_bytes(mask), line_step);
}

void sweep(const Kernels& kernels, const SweepLines& lines, float* shadow_m, std::ptrdiff_t line_step)
{
    kernels.sweep_shadow_heights(lines, shadow_m, line_step);
}

// One comb of the front over a strip: neighbour, own beams, neighbour. Two copies, because a line is carried from
// one to the other. The own beams begin where a cache line does.
class CarriedComb {
public:
    explicit CarriedComb(std::span<const float> front)
        : copies_(2, (kBefore + front.size() + kCacheLine - 1) / kCacheLine * kCacheLine)
    {
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
            std::ranges::copy(front, copy(i));
    }

    kernels::CombFront front() { return {copy(newer_), copy(1 - newer_)}; }
    void carried_over(std::size_t lines) { newer_ = (newer_ + lines) % 2; }

private:
    static constexpr std::size_t kCacheLine = 16; // floats
    static constexpr std::size_t kBefore = kCacheLine - 1;

    float* copy(std::size_t i) { return copies_.row(i).data() + kBefore; }

    Grid<float> copies_;
    std::size_t newer_ = 0;
};

} // namespace

SweepFront::SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame)
    : kernels_(&kernels::active_kernels()), frame_(frame), cells_(cells)
{
    frame_.drop_m = std::min(frame_.drop_m, kSteepestDrop_m);
    halfway_ = frame_.lateral != std::trunc(frame_.lateral);
    // The beams halfway may drift by one cell more.
    const std::ptrdiff_t drift = lines == 0 ? 0 : kernels::beam_shift(frame_.lateral, lines - 1).whole + 1;
    first_beam_ = frame_.lateral < 0.0 ? 0 : -drift;
    // One more on either side, so that every beam has neighbours.
    front_m_[0].assign(cells + static_cast<std::size_t>(drift) + 2, kNoShadow_m);
    if (halfway_)
        front_m_[1] = front_m_[0];
    next_front_m_ = front_m_;
}

SweepFront::SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame, std::string_view isa)
    : SweepFront(lines, cells, frame)
{
    kernels_ = &kernels::kernels_named(isa);
}

void SweepFront::advance(const LightOrder<const float>& heights, const LightOrder<Lit>& mask,
                         const Execution& execution)
{
    advance_strips(heights, mask, execution);
}

void SweepFront::advance(const LightOrder<const float>& heights, const LightOrder<float>& shadow_heights_m,
                         const Execution& execution)
{
    advance_strips(heights, shadow_heights_m, execution);
}

template <typename Answer>
void SweepFront::advance_strips(const LightOrder<const float>& heights, const LightOrder<Answer>& answers,
                                const Execution& execution)
{
    assert(heights.lines == answers.lines && heights.cells == cells_ && answers.cells == cells_);
    assert(heights.cell_step == 1 || std::abs(heights.line_step) == 1);
    if (heights.lines == 0 || cells_ == 0)
        return;
    const auto shifts = beam_shifts(frame_.lateral, next_line_, heights.lines);
    const StripLines all =
        lines_under_beams(cells_, next_line_, shifts, frame_.lateral, first_beam_,
                          first_beam_ + static_cast<std::ptrdiff_t>(front_m_[0].size()) - 2);
    const auto bands = bands_for_threads(all, thread_count(execution), heights.cell_step == 1);
    for_rows(bands.size(), 1, execution, [&](std::size_t i, std::size_t) {
        const Band& band = bands[i];
        std::vector<CarriedComb> combs; // of each strip one, or one and the one halfway
        const std::size_t each = halfway_ ? 2 : 1;
        for (std::size_t k = 0; k + 1 < band.size(); ++k)
            for (std::size_t c = 0; c < each; ++c)
                combs.emplace_back(std::span<const float>(front_m_[c])
                                       .subspan(static_cast<std::size_t>(band[k] - all.first_beam),
                                                static_cast<std::size_t>(band[k + 1] - band[k]) + 2));
        walk_band<0>(
            *kernels_, all, band, heights, answers,
            [&](std::size_t k, const StripLines& lines, Answer* out, std::ptrdiff_t out_step) {
                const std::span of_strip(combs.data() + k * each, each);
                SweepLines sweep_lines{lines, static_cast<float>(frame_.drop_m), of_strip[0].front(), {}};
                if (halfway_)
                    sweep_lines.halfway = of_strip[1].front();
                sweep(*kernels_, sweep_lines, out, out_step);
                for (CarriedComb& comb : of_strip)
                    comb.carried_over(lines.lines);
            });
        for (std::size_t k = 0; k + 1 < band.size(); ++k)
            for (std::size_t c = 0; c < each; ++c)
                std::copy_n(combs[k * each + c].front().newer + 1, band[k + 1] - band[k],
                            next_front_m_[c].begin() + (band[k] - all.first_beam) + 1);
    });
    std::swap(front_m_, next_front_m_);
    next_line_ += heights.lines;
}

ShadowMask cast_by_sweep(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);
    return advance_over_all<SweepFront, Lit>(field, light, execution);
}

ShadowField shadow_heights_by_sweep(const HeightField& field, const DirectionalLight& light,
                                    const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);
    return advance_over_all<SweepFront, float>(field, light, execution);
}

} // namespace duskline
