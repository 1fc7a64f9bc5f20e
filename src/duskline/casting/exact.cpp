// Exact shadows by carrying the front of the light between two brackets.
//
// In the frame of the beams (sweep.cpp) the front is the upper envelope of all lines passed, rows and the pieces
// of column lines between them, each a chain of straight pieces. A unit of it, from one beam to the next, holds
// one sample of every line:
//
//         far beam                near beam            lines of the unit: the three heights far, sample, near
//            |.       sample         |
//            | `.     __o.           |                 chord: between the highest heights under either beam
//            |___`.--'   `--.____  . |                 front: within `above` over it and `below` under it
//            |    `.            `-'__|
//            |      `._________.-'   |                 candidates: the lines that may show in the front
//
// The two brackets decide nearly everything, many cells at once (kernels/bracket_line-inl.h): a sample above them
// is lit, one below in shadow; a line above them is the only candidate from now on, one below is none. The rest is
// done here: a line in between becomes one candidate more, and a cell in between is decided by its ray's crossings
// with the candidates, by the very formula of the ray march (ray_march.h).
//
// Brackets follow the slope of the ground, and their width is only what lines are bent, so that even on rugged
// ground few cells fall between them: 1 in 60 at the worst of our terrains. Nothing is ever clipped or merged,
// so no error adds up, and a candidate costs four bytes.
//
// A column line from one line to the next counts only where it rises over both: else one of them hides it.
//
// Output-sensitive hidden-surface removal by a sweep of the upper envelope: Reif and Sen, An efficient
// output-sensitive hidden-surface removal algorithm and its parallelization, 1988; Katz, Overmars and Sharir,
// Efficient hidden surface removal for objects with small union size, 1992. The envelope is theirs; brackets and
// lists of candidates in place of the envelope itself are ours.

#include <duskline/casting/beam_strips.h>
#include <duskline/casting/candidates.h>
#include <duskline/casting/exact.h>
#include <duskline/casting/exact_front.h>
#include <duskline/casting/greatest_magnitude.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/ray_march.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace duskline {

namespace {

using kernels::BeamShift;
using kernels::BracketLine;
using kernels::Kernels;
using kernels::OpenCell;
using kernels::StripLines;

// Steeper light than this shades nothing; more would overflow the tilt.
constexpr double kSteepestDrop_m = 1.0e15;

// What float rounding can be wrong by, as a share of the greatest height in the sum: some forty roundings.
constexpr double kRounding = 4e-6;

// A narrower band is not worth a thread.
constexpr std::size_t kLeastBeamsInBand = 32;

// What all strips of a cast share.
struct Cast {
    const RayMarch& march;
    const Kernels& kernels;
    LightOrder<const float> heights;
    double lateral;
    double slope; // cells sideways per line
    double drop_m;
    std::ptrdiff_t sideways;    // 1 when light moves towards higher cells, else -1
    std::size_t first_line;     // with nothing before it
    std::size_t first_answered; // line
    std::size_t lines_per_tilt; // lines between two lowerings of the front
    float slack_m;
};

// The front over one strip of units, named by their near beams.
class FrontStrip {
public:
    FrontStrip(const Cast& cast, std::ptrdiff_t first_beam, std::ptrdiff_t last_beam)
        : cast_(cast), first_beam_(first_beam), last_beam_(last_beam),
          front_m_(static_cast<std::size_t>(last_beam - first_beam) + 2, kNoGround), next_m_(front_m_),
          above_m_(front_m_.size(), 0.0f), below_m_(front_m_.size(), 0.0f), base_(front_m_.size(), -1),
          candidates_(front_m_.size())
    {}

    template <typename Answer>
    void carry(const StripLines& lines, Answer* answers, std::ptrdiff_t answer_step)
    {
        for (std::size_t i = 0; i < lines.lines; ++i) {
            begin_line(lines, i);
            Answer* const out = answers + static_cast<std::ptrdiff_t>(i) * answer_step
                                - static_cast<std::ptrdiff_t>(lines.first_cell);
            const bool answered = v_ >= cast_.first_answered;
            if constexpr (std::is_same_v<Answer, float>)
                for (std::ptrdiff_t cell = cells_.first; answered && cell < cells_.last; ++cell)
                    out[cell] = shadow_height_m(cell);
            std::uint8_t* lit = nullptr;
            if constexpr (std::is_same_v<Answer, Lit>)
                lit = answered ? as_bytes(out) : nullptr;
            if (lit == nullptr) {
                unused_lit_.resize(lines.cells);
                lit = unused_lit_.data();
            }
            carry_line(lit);
            std::swap(front_m_, next_m_);
        }
    }

private:
    // Sets up everything that depends on the line.
    void begin_line(const StripLines& lines, std::size_t i)
    {
        v_ = lines.first_line + i;
        shift_ = lines.shifts[i];
        heights_ = lines.heights + static_cast<std::ptrdiff_t>(i) * lines.line_step
                   - static_cast<std::ptrdiff_t>(lines.first_cell);
        before_ = v_ > cast_.first_line && cast_.slope > 0.0 ? heights_ - lines.line_step : nullptr;
        next_heights_ = i + 1 < lines.lines ? heights_ + lines.line_step : heights_;
        const auto cells = static_cast<std::ptrdiff_t>(cast_.heights.cells);
        const std::ptrdiff_t moved = cast_.sideways * shift_.whole;
        cells_ = {std::clamp<std::ptrdiff_t>(first_beam_ + moved, 0, cells),
                  std::clamp<std::ptrdiff_t>(last_beam_ + moved, 0, cells)};
        if (v_ % cast_.lines_per_tilt == 0 && v_ != 0)
            for (float& height_m : front_m_)
                height_m -= static_cast<float>(cast_.drop_m * static_cast<double>(cast_.lines_per_tilt));
        tilt_m_ = cast_.drop_m * static_cast<double>(v_ % cast_.lines_per_tilt);
    }

    // The place of a beam in the arrays; a unit's is that of its near beam.
    std::size_t slot(std::ptrdiff_t beam) const { return static_cast<std::size_t>(beam - (first_beam_ - 1)); }
    std::ptrdiff_t near_beam(std::ptrdiff_t cell) const { return cell - cast_.sideways * shift_.whole; }
    std::size_t unit_of(std::ptrdiff_t cell) const { return slot(near_beam(cell)); }
    std::size_t far_slot(std::size_t unit) const
    {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(unit) - cast_.sideways);
    }
    std::size_t unit_ahead(std::size_t unit) const
    {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(unit) + cast_.sideways);
    }
    bool is_own(std::ptrdiff_t beam) const { return beam >= first_beam_ && beam < last_beam_; }
    bool is_cell(std::ptrdiff_t cell) const
    {
        return cell >= 0 && cell < static_cast<std::ptrdiff_t>(cast_.heights.cells);
    }

    // The cell whose rays leave the grid at once, behind which there is nothing; -1 when light moves straight.
    std::ptrdiff_t entering_cell() const
    {
        if (cast_.slope == 0.0)
            return -1;
        return cast_.sideways > 0 ? 0 : static_cast<std::ptrdiff_t>(cast_.heights.cells) - 1;
    }
    // The cell ahead of which there is nothing. What its line does ahead of it matters to no cell: as level.
    std::ptrdiff_t leaving_cell() const
    {
        return cast_.sideways > 0 ? static_cast<std::ptrdiff_t>(cast_.heights.cells) - 1 : 0;
    }

    void carry_line(std::uint8_t* lit)
    {
        carry_neighbour();
        raised_.clear();
        open_.resize(cells_.size());
        std::size_t open = 0;
        CellRange inner = cells_;
        if (!inner.empty() && cast_.slope > 0.0) {
            // The cells at the border of the grid need care; they are at either end.
            for (const std::ptrdiff_t cell : {entering_cell(), leaving_cell()}) {
                if (inner.empty() || (cell != inner.first && cell != inner.last - 1))
                    continue;
                (cell == inner.first ? inner.first : inner.last) += cell == inner.first ? 1 : -1;
                if (cell == entering_cell())
                    enter(cell, lit);
                else
                    open = bracket({cell, cell + 1}, lit, open);
            }
        }
        if (!inner.empty())
            open = bracket(inner, lit, open);

        for (std::size_t i = 0; i < open; ++i) {
            const auto cell = static_cast<std::ptrdiff_t>(open_[i].index);
            if ((open_[i].flags & OpenCell::kUnanswered) != 0)
                lit[cell] = heights_[cell] >= shadow_by_candidates_m(cell) ? 1 : 0;
            if ((open_[i].flags & OpenCell::kUnplaced) != 0)
                place_line(cell);
        }
        for (const Raise& raise : raised_)
            raise_front(raise);
        add_column_line_of_neighbour();
        if (const std::ptrdiff_t cell = entering_cell(); cell >= cells_.first && cell < cells_.last)
            add_column_line(cell);
        for (std::size_t i = 0; i < open; ++i)
            if ((open_[i].flags & OpenCell::kRises) != 0)
                add_column_line(static_cast<std::ptrdiff_t>(open_[i].index));
    }

    // Lets the brackets settle what they can; open cells are listed from `open` on, by their numbers.
    std::size_t bracket(CellRange cells, std::uint8_t* lit, std::size_t open)
    {
        const bool straight = cast_.slope == 0.0;
        const bool leaving = !straight && cells.size() == 1 && cells.first == leaving_cell();
        const std::size_t unit = unit_of(cells.first);
        BracketLine line;
        line.cell = heights_ + cells.first;
        line.ahead = straight || leaving ? line.cell : line.cell + cast_.sideways;
        line.behind = straight ? line.cell : line.cell - cast_.sideways;
        if (before_ != nullptr) {
            line.cell_before = before_ + cells.first;
            line.behind_before = line.cell_before - cast_.sideways;
        }
        line.next_cell = next_heights_ + cells.first;
        line.near = front_m_.data() + unit;
        line.far = straight ? line.near : front_m_.data() + far_slot(unit);
        line.next_near = next_m_.data() + unit;
        line.above = above_m_.data() + unit;
        line.below = below_m_.data() + unit;
        line.base = base_.data() + unit;
        line.lit = lit + cells.first;
        line.open = open_.data() + open;
        line.fraction = shift_.fraction;
        line.slope = static_cast<float>(cast_.slope);
        line.drop_m = static_cast<float>(cast_.drop_m);
        line.tilt_m = static_cast<float>(tilt_m_);
        line.slack_m = cast_.slack_m;
        line.number = static_cast<std::int32_t>(v_);
        const std::size_t found = cast_.kernels.bracket_line(line, cells.size());
        for (std::size_t i = open; i < open + found; ++i)
            open_[i].index += static_cast<std::uint32_t>(cells.first);
        return open + found;
    }

    // A cell whose line is known only from it forwards, and over whose ray there is nothing.
    void enter(std::ptrdiff_t cell, std::uint8_t* lit)
    {
        const std::size_t unit = unit_of(cell);
        next_m_[unit] = std::max(front_m_[unit], static_cast<float>(at_near_m(cell)));
        if (std::isnan(at_near_m(cell)))
            next_m_[unit] = front_m_[unit];
        if (std::isnan(heights_[cell])) {
            lit[cell] = static_cast<std::uint8_t>(Lit::unknown);
            return;
        }
        const double ground_m = heights_[cell];
        lit[cell] = ground_m >= cast_.march.shadow_height_m(start(cell), ground_m, ground_m) ? 1 : 0;
        place_line(cell);
    }

    // The beam behind the strip's first unit, whose own unit is another strip's.
    std::ptrdiff_t neighbour_beam() const { return cast_.sideways > 0 ? first_beam_ - 1 : last_beam_; }

    void carry_neighbour()
    {
        const std::ptrdiff_t beam = neighbour_beam();
        const std::ptrdiff_t cell = beam + cast_.sideways * shift_.whole;
        const std::size_t at = slot(beam);
        next_m_[at] = front_m_[at];
        if (cast_.slope > 0.0 && is_cell(cell) && at_near_m(cell) > front_m_[at])
            next_m_[at] = static_cast<float>(at_near_m(cell));
    }

    void add_column_line_of_neighbour()
    {
        const std::ptrdiff_t cell = neighbour_beam() + cast_.sideways * shift_.whole;
        if (before_ != nullptr && is_cell(cell))
            add_column_line(cell);
    }

    double tilted_m(std::ptrdiff_t cell) const
    {
        return is_cell(cell) ? heights_[cell] + tilt_m_ : std::numeric_limits<double>::quiet_NaN();
    }
    double at_near_m(std::ptrdiff_t cell) const
    {
        const double ground_m = tilted_m(cell);
        return ground_m + (tilted_m(cell + cast_.sideways) - ground_m) * shift_.fraction;
    }
    double at_far_m(std::ptrdiff_t cell) const
    {
        const double behind_m = tilted_m(cell - cast_.sideways);
        return behind_m + (tilted_m(cell) - behind_m) * shift_.fraction;
    }

    // Makes this line a candidate of the cell's unit, and widens the brackets around it.
    void place_line(std::ptrdiff_t cell)
    {
        const std::size_t unit = unit_of(cell);
        const std::size_t far = far_slot(unit);
        candidates_.add(unit, base_[unit], Candidate::line(v_));

        const double ground_m = tilted_m(cell);
        double near_m = cast_.slope == 0.0 || cell == leaving_cell() ? ground_m : at_near_m(cell);
        double far_m = cast_.slope == 0.0 ? ground_m : at_far_m(cell);
        const bool near_known = !std::isnan(near_m);
        const bool far_known = !std::isnan(far_m);
        // Beside a hole, or behind the cell that enters, as if level: right for the upper bracket alone.
        near_m = near_known ? near_m : ground_m;
        far_m = far_known ? far_m : ground_m;
        const double off_chord = ground_m - (near_m + (far_m - near_m) * shift_.fraction);
        const auto peak_m = static_cast<float>(std::max(off_chord, 0.0));
        const auto notch_m = static_cast<float>(std::max(-off_chord, 0.0));
        const auto over_near = static_cast<float>(near_m - front_m_[unit]);
        const auto over_far = cast_.slope == 0.0 ? over_near : static_cast<float>(far_m - front_m_[far]);
        float& above_m = above_m_[unit];
        float& below_m = below_m_[unit];
        if (!near_known || !far_known) {
            above_m = std::max(above_m, peak_m);
            below_m += std::max({near_known ? over_near : 0.0f, far_known ? over_far : 0.0f, 0.0f});
            if (!near_known)
                raised_.push_back({unit, static_cast<float>(near_m)});
            if (!far_known)
                raised_.push_back({far, static_cast<float>(far_m)});
            return;
        }
        const float least = std::min(over_near, over_far);
        const float most = std::max(over_near, over_far);
        if (least >= 0.0f) { // over both ends: the front cannot fall under it
            above_m = std::max(peak_m, above_m - least);
            below_m = std::min(notch_m, below_m + most);
        } else if (most <= 0.0f) { // under both
            above_m = std::max(above_m, peak_m + most);
        } else { // across: where the two cross, the front is under the new chord
            above_m = std::max(above_m, peak_m);
            below_m = std::max(below_m, notch_m) + -least * most / (most - least);
        }
        if (candidates_.is_full(unit))
            drop_hidden_candidates(cell, unit);
    }

    struct Raise {
        std::size_t slot;
        float height_m;
    };

    // Raises the end of two chords, for a line that is not really there: the brackets stay where they were.
    void raise_front(Raise raise)
    {
        const float by = raise.height_m - next_m_[raise.slot];
        if (!(by > 0.0f))
            return;
        front_m_[raise.slot] = next_m_[raise.slot] = raise.height_m;
        below_m_[raise.slot] += by;
        if (const std::size_t ahead = unit_ahead(raise.slot); ahead < below_m_.size())
            below_m_[ahead] += by;
    }

    // The column line of a cell, from the line before to this one: from the cell on, over its unit and the next.
    void add_column_line(std::ptrdiff_t cell)
    {
        if (before_ == nullptr)
            return;
        const double here_m = tilted_m(cell);
        const double there_m = before_[cell] + tilt_m_ - cast_.drop_m;
        if (std::isnan(here_m + there_m))
            return;
        const double end = shift_.fraction - cast_.slope; // places ahead of the near beam are below 0
        const double rise = there_m - here_m;
        const auto height_m = [&](double place) {
            return here_m + rise * ((shift_.fraction - place) / cast_.slope);
        };
        const std::ptrdiff_t beam = near_beam(cell);
        const double in_unit = std::max(end, 0.0);
        add_column_line(beam, cell, {in_unit, height_m(in_unit)}, {shift_.fraction, here_m});
        if (end < 0.0)
            add_column_line(beam + cast_.sideways, cell + cast_.sideways, {end + 1.0, there_m},
                            {1.0, height_m(0.0)});
    }

    void add_column_line(std::ptrdiff_t beam, std::ptrdiff_t cell, Piece::Knot nearer, Piece::Knot farther)
    {
        if (!is_own(beam) || !is_cell(cell))
            return;
        const std::size_t unit = slot(beam);
        const std::size_t far = far_slot(unit);
        for (const Raise end : {Raise{unit, static_cast<float>(nearer.height_m)},
                                Raise{far, static_cast<float>(farther.height_m)}})
            if (next_m_[end.slot] < kSeenGround)
                raise_front(end);
        const auto over_chord = [&](Piece::Knot knot) {
            return knot.height_m - (next_m_[unit] + (next_m_[far] - next_m_[unit]) * knot.place);
        };
        const double over = std::max(over_chord(nearer), over_chord(farther));
        if (over + below_m_[unit] + 2.0 * cast_.slack_m <= 0.0)
            return;
        candidates_.add(unit, base_[unit], Candidate::between(v_));
        above_m_[unit] = std::max(above_m_[unit], static_cast<float>(over));
        if (candidates_.is_full(unit))
            drop_hidden_candidates(cell, unit);
    }

    RayStart start(std::ptrdiff_t cell) const
    {
        // The march counts lines and cells towards the light.
        const std::int64_t line = cast_.march.last_line() - static_cast<std::int64_t>(v_);
        return {line, cast_.march.cells_turned() ? cast_.march.last_cell() - cell : cell, 0.0, 0.0};
    }

    // The shadow over a cell by all crossings of its ray that can matter.
    double shadow_by_candidates_m(std::ptrdiff_t cell)
    {
        const std::size_t unit = unit_of(cell);
        const RayStart from = start(cell);
        double shadow_m = kNothing;
        if (base_[unit] < 0 && candidates_.of(unit, -1).empty())
            return shadow_m;
        for (const std::uint32_t id : candidates_.of(unit, base_[unit])) {
            const auto line = cast_.march.last_line() - static_cast<std::int64_t>(Candidate::number(id));
            if (!Candidate::is_between(id)) {
                shadow_m = std::max(shadow_m, cast_.march.shadow_of_line_m(from, line));
                continue;
            }
            const double distance = cast_.march.distance_to(from, line);
            const std::int64_t first = std::max(cast_.march.cell_after(from, distance), from.cell + 1);
            const std::int64_t last =
                std::min(cast_.march.cell_after(from, distance + 1.0) + 1, cast_.march.last_cell());
            for (std::int64_t crossed = first; crossed <= last; ++crossed)
                shadow_m = std::max(shadow_m, cast_.march.shadow_of_cell_m(from, crossed));
        }
        return shadow_m;
    }

    float shadow_height_m(std::ptrdiff_t cell)
    {
        if (std::isnan(heights_[cell]))
            return std::numeric_limits<float>::quiet_NaN();
        if (cell == entering_cell())
            return shadow_height_as_float(cast_.march.shadow_height_m(start(cell), kNothing, kNeverEnough));
        return shadow_height_as_float(shadow_by_candidates_m(cell));
    }

    // A candidate's pieces in a unit, in the tilt of this line: of a line one, of column lines up to two.
    std::array<Piece, 2> pieces_of(std::uint32_t id, std::ptrdiff_t beam) const
    {
        const std::size_t v = Candidate::number(id);
        const BeamShift shift = kernels::beam_shift(cast_.lateral, v);
        const std::ptrdiff_t cell = beam + cast_.sideways * shift.whole;
        const double tilt_m = tilt_m_ + cast_.drop_m * (static_cast<double>(v) - static_cast<double>(v_));
        const auto height_m = [&](std::size_t line, std::ptrdiff_t u) {
            return is_cell(u) ? cast_.heights.at(line, static_cast<std::size_t>(u)) + tilt_m
                              : std::numeric_limits<double>::quiet_NaN();
        };
        std::array<Piece, 2> pieces;
        if (!Candidate::is_between(id)) {
            const double sample_m = height_m(v, cell);
            const double ahead_m = height_m(v, cell + cast_.sideways);
            const double behind_m = height_m(v, cell - cast_.sideways);
            if (std::isnan(sample_m))
                return pieces;
            if (cast_.slope == 0.0) {
                pieces[0].add(0.0, sample_m);
                pieces[0].add(1.0, sample_m);
                return pieces;
            }
            if (!std::isnan(ahead_m) && shift.fraction > 0.0f)
                pieces[0].add(0.0, sample_m + (ahead_m - sample_m) * shift.fraction);
            pieces[0].add(shift.fraction, sample_m);
            if (!std::isnan(behind_m))
                pieces[0].add(1.0, behind_m + (sample_m - behind_m) * shift.fraction);
            return pieces;
        }
        for (const std::ptrdiff_t i : {0, 1}) { // of the unit's own cell, and of the cell behind
            const std::ptrdiff_t u = cell - i * cast_.sideways;
            const double here_m = height_m(v, u);
            const double there_m = v > 0 ? height_m(v - 1, u) - cast_.drop_m : here_m;
            const double place = shift.fraction + static_cast<double>(i);
            const double end = place - cast_.slope;
            if (std::isnan(here_m + there_m) || end >= 1.0)
                continue;
            const auto at = [&](double x) {
                return here_m + (there_m - here_m) * ((place - x) / cast_.slope);
            };
            const double from = std::max(end, 0.0);
            const double to = std::min(place, 1.0);
            pieces[static_cast<std::size_t>(i)].add(from, at(from));
            pieces[static_cast<std::size_t>(i)].add(to, at(to));
        }
        return pieces;
    }

    // Forgets candidates that lie under another one all over the unit, and draws the brackets as tightly as what
    // is left allows.
    void drop_hidden_candidates(std::ptrdiff_t cell, std::size_t unit)
    {
        const std::ptrdiff_t beam = near_beam(cell);
        const auto all = candidates_.of(unit, base_[unit]);
        std::vector<std::uint32_t> kept;
        std::vector<std::array<Piece, 2>> pieces;
        for (auto id = all.rbegin(); id != all.rend(); ++id) { // the latest first: they hide most
            const auto own = pieces_of(*id, beam);
            const auto hidden = [&](std::size_t k) {
                return !Candidate::is_between(kept[k]) && hides(pieces[k][0], own[0], kStraight_m)
                       && hides(pieces[k][0], own[1], kStraight_m);
            };
            bool keep = true;
            for (std::size_t k = 0; keep && k < kept.size(); ++k)
                keep = !hidden(k);
            if (keep) {
                kept.push_back(*id);
                pieces.push_back(own);
            }
        }
        candidates_.keep_only(unit, kept);
        draw_brackets(unit, pieces);
    }

    void draw_brackets(std::size_t unit, std::span<const std::array<Piece, 2>> pieces)
    {
        const double near_m = next_m_[unit];
        const double far_m = cast_.slope == 0.0 ? near_m : next_m_[far_slot(unit)];
        double above_m = 0.0;
        double below_m = kWideOpen;
        for (const auto& candidate : pieces)
            for (const Piece& piece : candidate) {
                double deepest_m = 0.0;
                for (std::size_t i = 0; i < piece.count; ++i) {
                    const Piece::Knot knot = piece.knots[i];
                    const double over_m = knot.height_m - (near_m + (far_m - near_m) * knot.place);
                    above_m = std::max(above_m, over_m);
                    deepest_m = std::max(deepest_m, -over_m);
                }
                if (piece.covers(0.0, 1.0))
                    below_m = std::min(below_m, deepest_m);
            }
        above_m_[unit] = static_cast<float>(above_m);
        below_m_[unit] = std::min(below_m_[unit], static_cast<float>(below_m));
    }

    const Cast& cast_;
    std::ptrdiff_t first_beam_;
    std::ptrdiff_t last_beam_;
    std::vector<float> front_m_;
    std::vector<float> next_m_;
    std::vector<float> above_m_;
    std::vector<float> below_m_;
    std::vector<std::int32_t> base_;
    CandidateLists candidates_;
    std::vector<OpenCell> open_;
    std::vector<Raise> raised_;
    std::vector<std::uint8_t> unused_lit_;

    // Of the line at hand.
    std::size_t v_ = 0;
    BeamShift shift_;
    CellRange cells_{0, 0};
    double tilt_m_ = 0.0;
    const float* heights_ = nullptr; // by cell number
    const float* before_ = nullptr;  // the line before; null where column lines do not matter
    const float* next_heights_ = nullptr;
};

template <typename Answer>
void cast_part(const HeightField& field, const DirectionalLight& light, double highest_m,
               const BeamPart& part, GridView<Answer> answers, const Execution& execution,
               const Kernels& kernels)
{
    const LightFrame frame = light_frame(light, field.cell_size_m);
    const auto heights = in_light_order(field.heights_m, frame);
    const std::size_t lines_there = part.last_line - part.first_line;
    const auto heights_there = heights.part(part.first_line, lines_there);
    const auto out = in_light_order(answers, frame).part(part.first_line, lines_there);
    const double drop_m = std::min(frame.drop_m, kSteepestDrop_m);
    const double lines_per_tilt = std::clamp(std::floor(highest_m / drop_m), 1.0, 1048576.0);
    const RayMarch march(field, light, {-static_cast<float>(highest_m), static_cast<float>(highest_m)});
    const Cast cast{march,
                    kernels,
                    heights,
                    frame.lateral,
                    std::abs(frame.lateral),
                    drop_m,
                    sideways_of(frame),
                    part.first_line,
                    part.first_answered,
                    static_cast<std::size_t>(lines_per_tilt),
                    static_cast<float>(kRounding * (highest_m + drop_m * lines_per_tilt))};

    const auto shifts = beam_shifts(frame.lateral, part.first_line, lines_there);
    const StripLines all = lines_under_beams(heights.cells, part.first_line, shifts, frame.lateral,
                                             part.first_beam, part.last_beam);
    const auto wide_enough =
        static_cast<std::size_t>(part.last_beam - part.first_beam) / kLeastBeamsInBand + 1;
    const auto bands = bands_for_threads(all, thread_count(execution), heights.cell_step == 1, wide_enough);
    for_rows(bands.size(), 1, execution, [&](std::size_t i, std::size_t) {
        const Band& band = bands[i];
        std::vector<FrontStrip> fronts;
        for (std::size_t k = 0; k + 1 < band.size(); ++k)
            fronts.emplace_back(cast, band[k], band[k + 1]);
        const auto carry = [&](std::size_t k, const StripLines& lines, Answer* to, std::ptrdiff_t step) {
            fronts[k].carry(lines, to, step);
        };
        walk_band<1>(kernels, all, band, heights_there, out, carry, part.first_answered - part.first_line);
    });
}

template <typename Answer>
Grid<Answer> cast_all(const HeightField& field, const DirectionalLight& light, const Execution& execution,
                      const Kernels& kernels)
{
    Grid<Answer> answers(field.rows(), field.columns());
    if (answers.empty())
        return answers;
    const BeamPart all = all_beams(field, light_frame(light, field.cell_size_m));
    cast_part(field, light, greatest_magnitude_m(kernels, field, execution), all, answers.view(), execution,
              kernels);
    return answers;
}

} // namespace

BeamPart all_beams(const HeightField& field, const LightFrame& frame)
{
    const std::size_t lines = frame.lines_are_rows ? field.rows() : field.columns();
    const std::size_t cells = frame.lines_are_rows ? field.columns() : field.rows();
    const std::ptrdiff_t drift = kernels::beam_shift(frame.lateral, lines - 1).whole;
    const bool towards_higher = sideways_of(frame) > 0;
    return {0, 0, lines, towards_higher ? -drift : 0,
            static_cast<std::ptrdiff_t>(cells) + (towards_higher ? 0 : drift)};
}

void cast_exact_part(const HeightField& field, const DirectionalLight& light, double highest_m,
                     const BeamPart& part, GridView<Lit> mask, const Execution& execution,
                     const Kernels& kernels)
{
    cast_part(field, light, highest_m, part, mask, execution, kernels);
}

ShadowMask cast_by_exact(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    return cast_by_exact(field, light, execution, kernels::active_kernels().isa);
}

ShadowMask cast_by_exact(const HeightField& field, const DirectionalLight& light, const Execution& execution,
                         std::string_view isa)
{
    require_valid(field);
    require_valid(light);
    const Kernels& kernels = kernels::kernels_named(isa);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);
    return cast_all<Lit>(field, light, execution, kernels);
}

ShadowField shadow_heights_by_exact(const HeightField& field, const DirectionalLight& light,
                                    const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);
    return cast_all<float>(field, light, execution, kernels::active_kernels());
}

} // namespace duskline
