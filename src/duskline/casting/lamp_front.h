#pragma once

// The front of a lamp's light over a strip of beams, as exact_lamp.cpp tells. Not installed.

#include <duskline/casting/candidates.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/lamp_march.h>
#include <duskline/casting/lamp_wedge.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace duskline {

/// What all strips of a cast share.
struct LampCast {
    const LampMarch& march;
    const kernels::Kernels& kernels;
};

/// The front over one strip of units of a wedge.
class LampFront {
public:
    LampFront(const LampCast& cast, const LampWedge& wedge, const LampStrip& strip)
        : cast_(cast), wedge_(wedge), beams_(strip.beams), first_own_(strip.first), last_own_(strip.last),
          is_first_strip_(strip.is_first), is_last_strip_(strip.is_last), front_(beam_room(), kNoGround),
          above_(beam_room(), 0.0f), below_(beam_room(), 0.0f), base_(beam_room(), -1), candidates_(units()),
          over_(wedge.heights.cells + 2 * kPadding, std::numeric_limits<float>::quiet_NaN()),
          over_before_(over_), lit_(over_.size())
    {
        make_room();
    }

    // Cells that line `line` needs in memory.
    CellRange needed_cells(std::ptrdiff_t line) const
    {
        const double step = wedge_.distance(line) / beams_;
        const double first =
            wedge_.centre(static_cast<double>(line)) + static_cast<double>(first_unit()) * step;
        const double last = first + static_cast<double>(units()) * step;
        return clipped(first, last);
    }

    // Answers the strip's own cells of a line, and has the line pass. `heights` and `answers` by cell.
    template <typename Answer>
    CellRange carry(std::ptrdiff_t line, const float* heights, Answer* answers)
    {
        begin_line(line);
        if (first_ == last_) {
            before_known_ = false;
            return {0, 0};
        }
        if constexpr (std::is_same_v<Answer, float>)
            base_before_ = base_;
        const std::size_t open = bracket(heights);
        if constexpr (std::is_same_v<Answer, float>) {
            answer_heights(heights, answers);
        } else {
            spread_answers();
            for (std::size_t i = 0; i < open; ++i)
                if ((open_[i].flags & kernels::OpenCell::kUnanswered) != 0)
                    answer_cell(first_ + open_[i].index, heights);
            if (!own_.empty())
                std::memcpy(answers + own_.first, &lit_of(own_.first), own_.size());
        }
        raised_.clear();
        for (std::size_t i = 0; i < open; ++i)
            if ((open_[i].flags & kernels::OpenCell::kUnplaced) != 0)
                place_line(first_ + open_[i].index);
        for (const Raise& raise : raised_)
            raise_front(raise);
        add_lines_across();
        std::swap(over_, over_before_);
        before_known_ = true;
        return own_;
    }

private:
    // Units that a strip carries beside its own: what crosses its border is known on both sides.
    static constexpr std::int64_t kMarginUnits = 2;

    // Cells that a strip reads beside its own.
    static constexpr std::ptrdiff_t kMarginCells = 8;

    // No data around the line at hand, for the kernels to read.
    static constexpr std::size_t kPadding = 64;

    // Nearer lines have lines across that run over many units; they are not filtered.
    static constexpr double kNearLines = 8.0;

    // Lines across are followed up to this b.
    static constexpr double kWidest = 1.25;

    // What is this close to a beam, in units, may be met by rays on the other side of it.
    static constexpr double kBesideBeam = 1e-4;

    std::int64_t first_unit() const { return first_own_ - kMarginUnits; }
    std::size_t units() const { return static_cast<std::size_t>(last_own_ - first_own_ + 2 * kMarginUnits); }
    std::size_t beam_room() const { return units() + kPadding; }

    void make_room()
    {
        for (auto* each : {&at_, &part_, &next_, &size_, &front_before_})
            each->resize(beam_room());
        before_.resize(beam_room());
        answer_.resize(beam_room());
        open_.resize(beam_room());
    }

    CellRange clipped(double first, double last) const
    {
        const auto cells = static_cast<double>(wedge_.heights.cells);
        const auto margin = static_cast<double>(kMarginCells);
        return {static_cast<std::ptrdiff_t>(std::clamp(std::floor(first) - margin, 0.0, cells)),
                static_cast<std::ptrdiff_t>(std::clamp(std::ceil(last) + margin, 0.0, cells))};
    }

    // Sets up everything that depends on the line.
    void begin_line(std::ptrdiff_t line)
    {
        line_ = line;
        distance_ = wedge_.distance(line);
        while (distance_ * kBeamSpare > beams_)
            halve_units();
        step_ = distance_ / beams_;
        centre_ = wedge_.centre(static_cast<double>(line));
        first_place_ = centre_ + static_cast<double>(first_unit()) * step_;

        // Units over the grid.
        const auto count = static_cast<double>(units());
        const auto cells = static_cast<double>(wedge_.heights.cells);
        first_ = static_cast<std::size_t>(std::clamp(std::floor((-1.0 - first_place_) / step_), 0.0, count));
        last_ = static_cast<std::size_t>(std::clamp(std::ceil((cells - first_place_) / step_), 0.0, count));
        last_ = std::max(first_, last_);

        const auto own_place = [&](std::int64_t unit) {
            return static_cast<std::ptrdiff_t>(
                std::clamp(std::ceil(centre_ + static_cast<double>(unit) * step_), 0.0, cells));
        };
        own_ = wedge_.own_cells(line);
        if (!is_first_strip_)
            own_.first = std::max(own_.first, own_place(first_own_));
        if (!is_last_strip_)
            own_.last = std::min(own_.last, own_place(last_own_));
    }

    // Twice as many beams. A unit's halves inherit all it knows.
    void halve_units()
    {
        const std::int64_t old_first = first_unit();
        const auto old_front = std::move(front_);
        const auto old_above = std::move(above_);
        const auto old_below = std::move(below_);
        const auto old_base = std::move(base_);
        const CandidateLists old_candidates = std::move(candidates_);
        beams_ *= 2.0;
        first_own_ *= 2;
        last_own_ *= 2;
        front_.assign(beam_room(), kNoGround);
        above_.assign(beam_room(), 0.0f);
        below_.assign(beam_room(), 0.0f);
        base_.assign(beam_room(), -1);
        candidates_ = CandidateLists(units());
        make_room();
        for (std::size_t i = 0; i <= units(); ++i) {
            const std::int64_t beam = first_unit() + static_cast<std::int64_t>(i);
            const auto old = static_cast<std::size_t>((beam >> 1) - old_first);
            const bool between = (beam & 1) != 0;
            front_[i] =
                between ? old_front[old] + (old_front[old + 1] - old_front[old]) * 0.5f : old_front[old];
            if (i == units())
                break;
            above_[i] = old_above[old];
            below_[i] = old_below[old];
            base_[i] = old_base[old];
            candidates_.inherit(i, base_[i], old_candidates, old);
        }
    }

    // Lets the brackets settle what they can; open units are listed from `first_` on.
    std::size_t bracket(const float* heights)
    {
        const double plane_m = wedge_.plane_m(static_cast<double>(line_));
        const auto high = static_cast<float>(plane_m);
        const auto low = static_cast<float>(plane_m - high);
        const CellRange cells = clipped(first_place_ + static_cast<double>(first_) * step_,
                                        first_place_ + static_cast<double>(last_) * step_);
        cast_.kernels.heights_over(heights + cells.first, cells.size(), high, low, over() + cells.first);

        kernels::LampLine line;
        line.over = over();
        line.first_place = first_place_ + static_cast<double>(first_) * step_;
        line.step = step_;
        line.beams_per_cell = static_cast<float>(1.0 / step_);
        line.per_line = static_cast<float>(1.0 / distance_);
        line.number = static_cast<std::int32_t>(line_);
        line.at = at_.data() + first_;
        line.part = part_.data() + first_;
        line.before = before_.data() + first_;
        line.next = next_.data() + first_;
        line.size = size_.data() + first_;
        line.front_before = front_before_.data() + first_;
        line.front = front_.data() + first_;
        line.above = above_.data() + first_;
        line.below = below_.data() + first_;
        line.base = base_.data() + first_;
        line.answer = answer_.data() + first_;
        line.open = open_.data();
        return cast_.kernels.bracket_lamp_line(line, last_ - first_);
    }

    float* over() { return over_.data() + kPadding; }
    std::uint8_t& lit_of(std::ptrdiff_t cell)
    {
        return lit_[static_cast<std::size_t>(cell + static_cast<std::ptrdiff_t>(kPadding))];
    }
    bool holds_sample(std::size_t unit) const { return before_[unit + 1] > before_[unit]; }
    std::ptrdiff_t cell_in(std::size_t unit) const { return before_[unit] + 1; }
    bool is_own(std::ptrdiff_t cell) const { return cell >= own_.first && cell < own_.last; }

    // From units to cells. Units without a sample write theirs to the next one's, which is yet to come.
    void spread_answers()
    {
        std::uint8_t* const lit = lit_.data() + kPadding + 1;
        const std::int32_t* const before = before_.data();
        const std::uint8_t* const answer = answer_.data();
        for (std::size_t unit = first_, last = last_; unit < last; ++unit)
            lit[before[unit]] = answer[unit];
    }

    void answer_cell(std::size_t unit, const float* heights)
    {
        const std::ptrdiff_t cell = cell_in(unit);
        if (is_own(cell))
            lit_of(cell) = heights[cell] >= shadow_by_candidates_m(unit, base_[unit]) ? 1 : 0;
    }

    void answer_heights(const float* heights, float* answers)
    {
        for (std::size_t unit = first_; unit < last_; ++unit) {
            const std::ptrdiff_t cell = cell_in(unit);
            if (holds_sample(unit) && is_own(cell))
                answers[cell] =
                    std::isnan(heights[cell])
                        ? std::numeric_limits<float>::quiet_NaN()
                        : shadow_height_as_float(shadow_by_candidates_m(unit, base_before_[unit]));
        }
    }

    // The shadow over the cell in a unit by all crossings of its ray that can matter.
    double shadow_by_candidates_m(std::size_t unit, std::int32_t base)
    {
        const auto candidates = candidates_.of(unit, base);
        if (candidates.empty())
            return kNothing;
        const auto index = static_cast<std::size_t>(wedge_.index_of(line_));
        const auto cell = static_cast<std::size_t>(cell_in(unit));
        const LampRay ray =
            wedge_.lines_are_rows ? cast_.march.ray_from(index, cell) : cast_.march.ray_from(cell, index);
        const bool turned = ray.surface().counting().lines_turned;
        double shadow_m = kNothing;
        for (const std::uint32_t id : candidates) {
            const auto of_grid = static_cast<std::int64_t>(
                wedge_.index_of(static_cast<std::ptrdiff_t>(Candidate::number(id))));
            const std::int64_t line = turned ? ray.surface().last_line() - of_grid : of_grid;
            if (!Candidate::is_between(id)) {
                shadow_m = std::max(shadow_m, ray.shadow_of_line_m(line));
                continue;
            }
            const std::int64_t first = std::max(ray.cell_at(line), ray.first_cell() + 1);
            const std::int64_t last = std::min(ray.cell_at(line + 1) + 1, ray.last_cell());
            for (std::int64_t crossed = first; crossed <= last; ++crossed)
                shadow_m = std::max(shadow_m, ray.shadow_of_cell_m(crossed));
        }
        return shadow_m;
    }

    // Makes this line a candidate of a unit, and widens the brackets around it.
    void place_line(std::size_t unit)
    {
        candidates_.add(unit, base_[unit], Candidate::line(static_cast<std::size_t>(line_)));
        const bool holds = holds_sample(unit);
        float near = at_[unit];
        float far = at_[unit + 1];
        const bool near_known = !std::isnan(near);
        const bool far_known = !std::isnan(far);
        const float place = std::min((1.0f - part_[unit]) * static_cast<float>(1.0 / step_), 1.0f);
        const float sample = holds ? next_[unit] : near;
        // Beside a hole as if level: right for the upper bracket alone.
        near = near_known ? near : sample;
        far = far_known ? far : sample;
        const float off_chord = holds ? sample - (near + (far - near) * place) : 0.0f;
        const float rounding = 4.0f * kernels::kLampRounding
                               * (std::abs(near) + std::abs(far) + std::abs(sample)
                                  + seen(front_before_[unit]) + seen(front_before_[unit + 1]));
        const float peak = std::max(off_chord, 0.0f) + rounding;
        const float notch = std::max(-off_chord, 0.0f) + rounding;
        const float over_near = near - front_before_[unit];
        const float over_far = far - front_before_[unit + 1];
        float& above = above_[unit];
        float& below = below_[unit];
        if (!near_known || !far_known) {
            above = std::max(above, peak);
            below += std::max({near_known ? over_near : 0.0f, far_known ? over_far : 0.0f, 0.0f});
            if (!near_known)
                meet_beside(unit, place, -1, near);
            if (!far_known)
                meet_beside(unit, place, 1, far);
            return;
        }
        const float least = std::min(over_near, over_far);
        const float most = std::max(over_near, over_far);
        if (least >= 0.0f) { // over both ends: the front cannot fall under it
            above = std::max(peak, above - least + rounding);
            below = std::min(notch, below + most + rounding);
        } else if (most <= 0.0f) { // under both
            above = std::max(above, peak + most);
        } else { // across: where the two cross, the front is under the new chord
            above = std::max(above, peak);
            below = std::max(below, notch) - least * most / (most - least) + rounding;
        }
        if (candidates_.is_full(unit))
            drop_hidden_candidates(unit);
    }

    static float seen(float front) { return front < kSeenGround ? 0.0f : std::abs(front); }

    struct Raise {
        std::size_t beam;
        float front;
    };

    // A sample with nothing beyond it towards higher (1) or lower (-1) beams. Rays within the march's slack of it meet
    // it all the same, and close to the lamp that may be some units away.
    void meet_beside(std::size_t unit, double place, std::ptrdiff_t towards, float sample)
    {
        const double reach = kBesideBeam + kSlack_cells / step_;
        const double to_end = towards > 0 ? 1.0 - place : place;
        auto neighbour = static_cast<std::ptrdiff_t>(unit);
        raised_.push_back({static_cast<std::size_t>(neighbour + (towards > 0 ? 1 : 0)), sample});
        for (double done = to_end; done < reach; done += 1.0) {
            neighbour += towards;
            if (neighbour < 0 || neighbour >= static_cast<std::ptrdiff_t>(units()))
                return;
            const auto at = static_cast<std::size_t>(neighbour);
            candidates_.add_once(at, base_[at], Candidate::line(static_cast<std::size_t>(line_)));
            raised_.push_back({at + (towards > 0 ? 1 : 0), sample});
        }
    }

    // Raises the end of two chords, for a line that is not really there: the brackets stay where they were.
    void raise_front(Raise raise)
    {
        const float by = raise.front - front_[raise.beam];
        if (!(by > 0.0f))
            return;
        front_[raise.beam] = raise.front;
        if (raise.beam < units())
            below_[raise.beam] += by;
        if (raise.beam > 0)
            below_[raise.beam - 1] += by;
    }

    // The lines across between the line before and this one.
    void add_lines_across()
    {
        const auto cells = static_cast<std::ptrdiff_t>(wedge_.heights.cells);
        const auto count = static_cast<std::size_t>(wedge_.index_count);
        if (static_cast<std::size_t>(wedge_.index_of(line_ - 1)) >= count) // wraps before the first
            return;
        const double first = first_place_ + static_cast<double>(first_) * step_;
        const double last = first_place_ + static_cast<double>(last_) * step_;
        const CellRange all{
            static_cast<std::ptrdiff_t>(std::clamp(std::floor(first) - 1.0, 0.0, static_cast<double>(cells))),
            static_cast<std::ptrdiff_t>(std::clamp(std::ceil(last) + 2.0, 0.0, static_cast<double>(cells)))};
        if (distance_ < kNearLines || !before_known_) {
            for (std::ptrdiff_t cell = all.first; cell < all.last; ++cell)
                add_line_across(cell);
            return;
        }
        const auto lamp = static_cast<std::ptrdiff_t>(
            std::clamp(std::floor(wedge_.lamp_cell) + 1.0, 0.0, static_cast<double>(cells)));
        add_lines_across({all.first, std::min(all.last, lamp)}, -1);
        add_lines_across({std::max(all.first, lamp), all.last}, 1);
    }

    void add_lines_across(CellRange cells, std::ptrdiff_t outwards)
    {
        if (cells.empty())
            return;
        rising_.resize(std::max(rising_.size(), cells.size()));
        kernels::LampCells line;
        line.over = over() + cells.first;
        line.over_before = over_before_.data() + kPadding + cells.first;
        line.outwards = outwards;
        line.first_away = static_cast<float>(static_cast<double>(cells.first) - wedge_.lamp_cell);
        line.per_line = static_cast<float>(1.0 / distance_);
        line.per_line_before = static_cast<float>(1.0 / wedge_.distance(line_ - 1));
        line.rising = rising_.data();
        const std::size_t found = cast_.kernels.rising_lines_across(line, cells.size());
        for (std::size_t i = 0; i < found; ++i) {
            const std::ptrdiff_t cell = cells.first + static_cast<std::ptrdiff_t>(rising_[i]);
            if (!is_deep_in_shadow(line, cells.first, cell))
                add_line_across(cell);
        }
    }

    // Whether a line across lies under the front by its two ends alone. Settles most without working out its pieces.
    bool is_deep_in_shadow(const kernels::LampCells& line, std::ptrdiff_t first_cell,
                           std::ptrdiff_t cell) const
    {
        const float here = line.over[cell - first_cell] * line.per_line;
        const float before = line.over_before[cell - first_cell] * line.per_line_before;
        const double beams_before = beams_ / wedge_.distance(line_ - 1);
        const double centre_before = wedge_.centre(static_cast<double>(line_ - 1));
        const auto unit_of = [&](double place) {
            return static_cast<std::size_t>(std::clamp(place - static_cast<double>(first_unit()), 0.0,
                                                       static_cast<double>(units()) - 1.0));
        };
        const std::size_t here_unit = unit_of((static_cast<double>(cell) - centre_) / step_);
        const std::size_t before_unit = unit_of((static_cast<double>(cell) - centre_before) * beams_before);
        const float size = std::abs(here) + std::abs(before);
        for (std::size_t unit = std::min(here_unit, before_unit); unit <= std::max(here_unit, before_unit);
             ++unit) {
            const float rounding =
                4.0f * kernels::kLampRounding * (size + std::abs(front_[unit]) + std::abs(front_[unit + 1]));
            if (!(std::max(here, before) + rounding
                  <= std::min(front_[unit], front_[unit + 1]) - below_[unit]))
                return false;
        }
        return true;
    }

    // A place and a height in the frame of the beams; places in units from the strip's first.
    using Knot = Piece::Knot;

    struct Across {
        Knot lower;
        Knot upper;
    };

    // The line across of a cell, from the line before to `line`, or what of it lies in the wedge; from the lower place
    // to the upper one, the same place when there is nothing.
    Across line_across(std::ptrdiff_t line, std::ptrdiff_t cell) const
    {
        double here = wedge_.over_m(line, cell);
        double before = wedge_.over_m(line - 1, cell);
        const double distance = wedge_.distance(line);
        double farthest = distance;
        double nearest =
            std::max(distance - 1.0, std::abs(static_cast<double>(cell) - wedge_.lamp_cell) / kWidest);
        // Where one end is missing the march's slack is left of it.
        if (std::isnan(before)) {
            nearest = std::max(nearest, distance - kSlack_cells);
            before = here + wedge_.climb_m;
        } else if (std::isnan(here)) {
            farthest = distance - 1.0 + kSlack_cells;
            here = before - wedge_.climb_m;
        }
        if (!(nearest < farthest) || std::isnan(here + before))
            return {};
        const auto knot = [&](double from_lamp) {
            const double back = distance - from_lamp;
            const double place = static_cast<double>(cell) - wedge_.centre(static_cast<double>(line) - back);
            return Knot{place / (from_lamp / beams_) - static_cast<double>(first_unit()),
                        (here + (before - here) * back) / from_lamp};
        };
        const Knot far = knot(farthest);
        const Knot near = knot(nearest);
        return far.place < near.place ? Across{far, near} : Across{near, far};
    }

    // What of it lies in one unit; nothing when the places are the same.
    static Across within(const Across& across, double unit)
    {
        const double from = std::max(across.lower.place - unit, 0.0);
        const double to = std::min(across.upper.place - unit, 1.0);
        const double length = across.upper.place - across.lower.place;
        if (!(length > 0.0) || !(from < to))
            return {};
        const auto at = [&](double place) {
            return across.lower.height_m
                   + (across.upper.height_m - across.lower.height_m)
                         * ((place + unit - across.lower.place) / length);
        };
        return {{from, at(from)}, {to, at(to)}};
    }

    void add_line_across(std::ptrdiff_t cell)
    {
        const Across across = line_across(line_, cell);
        if (!(across.lower.place < across.upper.place))
            return;
        const auto count = static_cast<double>(units());
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(across.lower.place), 0.0, count));
        const auto last = static_cast<std::size_t>(std::clamp(std::ceil(across.upper.place), 0.0, count));
        for (std::size_t unit = first; unit < last; ++unit)
            add_line_across(unit, within(across, static_cast<double>(unit)));
    }

    void add_line_across(std::size_t unit, const Across& piece)
    {
        if (!(piece.lower.place < piece.upper.place))
            return;
        for (const Raise end : {Raise{unit, static_cast<float>(piece.lower.height_m)},
                                Raise{unit + 1, static_cast<float>(piece.upper.height_m)}})
            if (front_[end.beam] < kSeenGround)
                raise_front(end);
        const auto over_chord = [&](const Knot& knot) {
            return static_cast<float>(knot.height_m)
                   - (front_[unit] + (front_[unit + 1] - front_[unit]) * static_cast<float>(knot.place));
        };
        const float rounding = 4.0f * kernels::kLampRounding
                               * (std::abs(static_cast<float>(piece.lower.height_m))
                                  + std::abs(static_cast<float>(piece.upper.height_m))
                                  + std::abs(front_[unit]) + std::abs(front_[unit + 1]));
        const float over = std::max(over_chord(piece.lower), over_chord(piece.upper)) + rounding;
        if (over + below_[unit] <= 0.0f)
            return;
        candidates_.add_once(unit, base_[unit], Candidate::between(static_cast<std::size_t>(line_)));
        above_[unit] = std::max(above_[unit], over);
        if (candidates_.is_full(unit))
            drop_hidden_candidates(unit);
    }

    // A candidate's pieces in a unit: of a line one, of lines across a few.
    std::vector<Piece> pieces_of(std::uint32_t id, std::size_t unit) const
    {
        const auto line = static_cast<std::ptrdiff_t>(Candidate::number(id));
        const auto number = static_cast<double>(first_unit() + static_cast<std::int64_t>(unit));
        std::vector<Piece> pieces;
        if (!Candidate::is_between(id)) {
            pieces.push_back(piece_of_line(line, number));
            return pieces;
        }
        // Columns between the unit's places on both lines.
        const auto place = [&](double of_line, double beam) {
            const double back = static_cast<double>(line) - of_line;
            const double from_lamp = std::max(wedge_.distance(line) - back, 0.0);
            return wedge_.centre(of_line) + beam * (from_lamp / beams_);
        };
        const auto own = static_cast<double>(line);
        const auto [least, most] = std::minmax({place(own, number), place(own, number + 1.0),
                                                place(own - 1.0, number), place(own - 1.0, number + 1.0)});
        const auto last = static_cast<std::ptrdiff_t>(std::ceil(most));
        for (auto cell = static_cast<std::ptrdiff_t>(std::floor(least)); cell <= last; ++cell) {
            const Across across = within(line_across(line, cell), static_cast<double>(unit));
            if (!(across.lower.place < across.upper.place))
                continue;
            Piece piece;
            piece.add(across.lower.place, across.lower.height_m);
            piece.add(across.upper.place, across.upper.height_m);
            pieces.push_back(piece);
        }
        return pieces;
    }

    Piece piece_of_line(std::ptrdiff_t line, double unit) const
    {
        const double distance = wedge_.distance(line);
        const double step = distance / beams_;
        const double first = wedge_.centre(static_cast<double>(line)) + unit * step;
        const double last = first + step;
        const double below = std::floor(first);
        const auto cell = static_cast<std::ptrdiff_t>(below);
        const auto sample = [&](std::ptrdiff_t of_cell) { return wedge_.over_m(line, of_cell) / distance; };
        const auto at = [&](double place) { // NaN beside a hole
            const double whole = std::floor(place);
            const double a = sample(static_cast<std::ptrdiff_t>(whole));
            return a + (sample(static_cast<std::ptrdiff_t>(whole) + 1) - a) * (place - whole);
        };
        Piece piece;
        const auto add_known = [&piece](double place, double height) {
            if (!std::isnan(height))
                piece.add(place, height);
        };
        add_known(0.0, at(first));
        if (below + 1.0 < last)
            add_known((below + 1.0 - first) / step, sample(cell + 1));
        add_known(1.0, at(last));
        return piece;
    }

    // Forgets candidates that lie under another one all over the unit, and draws the brackets as tightly as what is
    // left allows.
    void drop_hidden_candidates(std::size_t unit)
    {
        const auto all = candidates_.of(unit, base_[unit]);
        std::vector<std::uint32_t> kept;
        std::vector<std::vector<Piece>> pieces;
        for (auto id = all.rbegin(); id != all.rend(); ++id) { // the latest first: they hide most
            const auto own = pieces_of(*id, unit);
            const auto hidden_by = [&](std::size_t k) {
                return !Candidate::is_between(kept[k]) && std::ranges::all_of(own, [&](const Piece& piece) {
                    return hides(pieces[k][0], piece, kStraight_m / distance_);
                });
            };
            bool keep = true;
            for (std::size_t k = 0; keep && k < kept.size(); ++k)
                keep = !hidden_by(k);
            if (keep) {
                kept.push_back(*id);
                pieces.push_back(own);
            }
        }
        candidates_.keep_only(unit, kept);
        draw_brackets(unit, pieces);
    }

    void draw_brackets(std::size_t unit, const std::vector<std::vector<Piece>>& pieces)
    {
        const double near = front_[unit];
        const double far = front_[unit + 1];
        double above = 0.0;
        double below = kWideOpen;
        for (const auto& candidate : pieces)
            for (const Piece& piece : candidate) {
                double deepest = 0.0;
                double rounding = 0.0;
                for (std::size_t i = 0; i < piece.count; ++i) {
                    const Knot& knot = piece.knots[i];
                    const double over = knot.height_m - (near + (far - near) * knot.place);
                    rounding = std::max(rounding, 4.0 * kernels::kLampRounding * std::abs(knot.height_m));
                    above = std::max(above, over + rounding);
                    deepest = std::max(deepest, -over);
                }
                if (piece.covers(0.0, 1.0))
                    below = std::min(below, deepest + rounding);
            }
        above_[unit] = static_cast<float>(above);
        below_[unit] = std::min(below_[unit], static_cast<float>(below));
    }

    const LampCast& cast_;
    const LampWedge& wedge_;
    double beams_; // from b = 0 to 1
    std::int64_t first_own_;
    std::int64_t last_own_;
    bool is_first_strip_;
    bool is_last_strip_;

    // By beam, or unit.
    std::vector<float> front_;
    std::vector<float> above_;
    std::vector<float> below_;
    std::vector<std::int32_t> base_;
    std::vector<std::int32_t> base_before_;
    CandidateLists candidates_;

    // By cell, after `kPadding`.
    std::vector<float> over_;
    std::vector<float> over_before_;
    std::vector<std::uint8_t> lit_;

    // Of the line at hand.
    std::ptrdiff_t line_ = 0;
    double distance_ = 0.0;
    double step_ = 0.0; // cells from beam to beam
    double centre_ = 0.0;
    double first_place_ = 0.0;
    std::size_t first_ = 0; // units over the grid
    std::size_t last_ = 0;
    CellRange own_{0, 0};
    bool before_known_ = false; // whether over_before_ is the line before
    std::vector<float> at_;
    std::vector<float> part_;
    std::vector<std::int32_t> before_;
    std::vector<float> next_;
    std::vector<float> size_;
    std::vector<float> front_before_;
    std::vector<std::uint8_t> answer_;
    std::vector<kernels::OpenCell> open_;
    std::vector<std::uint32_t> rising_;
    std::vector<Raise> raised_;
};

} // namespace duskline
