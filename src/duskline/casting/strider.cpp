// Shadows by lines cast from what stands in the light, away from it, until they touch ground.
//
//          .                                light comes from the left
//      o- _   ' - _
//     /|\    ' - _   ' - o- _              o  lit: touched by the line from before, and where the next goes off
//    / | \   x   x ' o       ' x           x  passed over by a line: in shadow
//   o  |  o
//
// From above, the tracks that lines follow are one cell apart. Light moves at most one cell sideways from line to
// line of the grid (light_frame.h), so the cell nearest to a track on each line is another for every track, and
// every cell has one:
//
//      line v    o--x--o--x--o--x--o       o  cells
//                    \     \     \         x  tracks: cell k on line 0, k + lateral v on line v
//      line v+1  o----ox----ox----ox       ground there is straight between the two cells beside
//
// On a track nothing is ever marked twice: a line stops at the first ground it touches, and that ground, higher
// than the line, casts on. So the two nested loops of the source, over tops and along their lines, come to one: a
// line's height is carried on from line to line of the grid, for all tracks side by side, and whatever ground
// reaches it takes its place. Heights are tilted, as in sweep.cpp: the ground rises by the light's fall and a line
// keeps its height.
//
// Source: Matthew Strahan, "Real-Time Heightmap Self-Shadowing Using the Strider Technique", gamedev.net, 2004.
// Departs from it: any azimuth, where it shows one diagonal and leaves the others open; tracks that share the cells
// out among them; heights on a track between two cells, where rounding to one would darken slopes; edges of the grid
// are cast on and from; ground that a line just touches is lit, as there.

#include <duskline/casting/beam_strips.h>
#include <duskline/casting/strider.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace duskline {

namespace {

using kernels::kLinesPerTilt;
using kernels::StripLines;

constexpr float kNoLine = -std::numeric_limits<float>::infinity();

// Steeper light than this shades nothing anyone could have measured; more would overflow the tilt.
constexpr double kSteepestDrop_m = 1.0e15;

// Where tracks stand on a line of the grid.
struct Stand {
    std::ptrdiff_t cells; // from a track's number to the cell nearest to it, sideways
    float part;           // of the way from there to the cell beside it
    bool ahead;           // whether that is the next one sideways, or else the one before
};

Stand stand_on(double lateral, std::size_t line)
{
    const double moved = std::abs(lateral) * static_cast<double>(line);
    const double nearest = std::floor(moved + 0.5);
    const double beside = std::abs(moved - nearest);
    return {static_cast<std::ptrdiff_t>(nearest), beside < 1e-6 ? 0.0f : static_cast<float>(beside),
            moved > nearest};
}

std::vector<kernels::BeamShift> shifts_of_tracks(double lateral, std::size_t first_line, std::size_t lines)
{
    std::vector<kernels::BeamShift> shifts(lines);
    for (std::size_t i = 0; i < lines; ++i)
        shifts[i].whole = stand_on(lateral, first_line + i).cells;
    return shifts;
}

void answer(float own_m, float ground_m, float line_m, std::uint8_t& lit)
{
    lit = std::isnan(own_m) ? std::uint8_t{255} : static_cast<std::uint8_t>(ground_m >= line_m);
}

void answer(float own_m, float ground_m, float line_m, float& shadow_m)
{
    shadow_m = own_m + (line_m - ground_m);
    if (line_m > ground_m && shadow_m <= own_m) // by rounding
        shadow_m = std::nextafter(own_m, std::numeric_limits<float>::infinity());
}

// Takes the lines on the tracks of neighbouring cells over them. `ground_m(i)` is the ground there on the track of
// cell i, NaN where the cell is.
template <typename Ground, typename Value>
void pass_cells(std::size_t count, const float* own_m, const Ground& ground_m, float tilt_m, float* line_m,
                Value* answers)
{
    for (std::size_t i = 0; i < count; ++i) {
        const float tilted_m = ground_m(i) + tilt_m;
        answer(own_m[i], tilted_m, line_m[i], answers[i]);
        line_m[i] = tilted_m > line_m[i] ? tilted_m : line_m[i]; // not for NaN
    }
}

template <typename Value>
void pass_on_cells(std::size_t count, const float* own_m, float tilt_m, float* line_m, Value* answers)
{
    pass_cells(
        count, own_m, [own_m](std::size_t i) { return own_m[i]; }, tilt_m, line_m, answers);
}

template <typename Value>
void pass_beside_cells(std::size_t count, const float* own_m, const float* beside_m, float part, float tilt_m,
                       float* line_m, Value* answers)
{
    const auto between_m = [=](std::size_t i) {
        const float height_m = own_m[i] + (beside_m[i] - own_m[i]) * part;
        return std::isnan(height_m) ? own_m[i] : height_m;
    };
    pass_cells(count, own_m, between_m, tilt_m, line_m, answers);
}

std::uint8_t* as_values(Lit* answers)
{
    return as_bytes(answers);
}

float* as_values(float* answers)
{
    return answers;
}

// Takes the tracks of a strip, whose lines are `line_m` high, over its lines of the grid.
template <typename Value>
void pass_lines(const StripLines& strip, const LightFrame& frame, float* line_m, Value* answers,
                std::ptrdiff_t answer_step)
{
    const auto drop_m = static_cast<float>(std::min(frame.drop_m, kSteepestDrop_m));
    const auto tracks = strip.last_beam - strip.first_beam;
    const auto cells = static_cast<std::ptrdiff_t>(strip.cells);
    const auto first_cell = static_cast<std::ptrdiff_t>(strip.first_cell);
    for (std::size_t i = 0; i < strip.lines; ++i) {
        const std::size_t line = strip.first_line + i;
        const Stand stand = stand_on(frame.lateral, line);
        const float tilt_m = static_cast<float>(line % kLinesPerTilt) * drop_m;
        if (line % kLinesPerTilt == 0)
            for (std::ptrdiff_t k = 0; k < tracks; ++k)
                line_m[k] -= static_cast<float>(kLinesPerTilt) * drop_m;

        const std::ptrdiff_t moved = strip.first_beam + strip.sideways * stand.cells;
        const std::ptrdiff_t beside = stand.part == 0.0f ? 0 : stand.ahead ? strip.sideways : -strip.sideways;
        const float* const heights_m =
            strip.heights + static_cast<std::ptrdiff_t>(i) * strip.line_step - first_cell;
        Value* const out = answers + static_cast<std::ptrdiff_t>(i) * answer_step - first_cell;
        const auto pass = [&](std::ptrdiff_t first, std::ptrdiff_t last, std::ptrdiff_t to_beside) {
            if (first >= last)
                return;
            const auto count = static_cast<std::size_t>(last - first);
            const float* const own_m = heights_m + first;
            float* const its_line_m = line_m + (first - moved);
            if (to_beside == 0)
                pass_on_cells(count, own_m, tilt_m, its_line_m, out + first);
            else
                pass_beside_cells(count, own_m, own_m + to_beside, stand.part, tilt_m, its_line_m,
                                  out + first);
        };
        // At the border there is no cell beside the last one.
        const std::ptrdiff_t from = std::clamp<std::ptrdiff_t>(moved, 0, cells);
        const std::ptrdiff_t to = std::clamp<std::ptrdiff_t>(moved + tracks, 0, cells);
        const std::ptrdiff_t inner_from = std::min(std::max<std::ptrdiff_t>(from, -beside), to);
        const std::ptrdiff_t inner_to = std::max(std::min(to, cells - beside), inner_from);
        pass(from, inner_from, 0);
        pass(inner_from, inner_to, beside);
        pass(inner_to, to, 0);
    }
}

} // namespace

StriderFront::StriderFront(std::size_t lines, std::size_t cells, const LightFrame& frame)
    : frame_(frame), cells_(cells)
{
    const std::ptrdiff_t drift = lines == 0 ? 0 : stand_on(frame.lateral, lines - 1).cells;
    first_track_ = frame.lateral < 0.0 ? 0 : -drift;
    line_m_.assign(cells + static_cast<std::size_t>(drift), kNoLine);
}

void StriderFront::advance(const LightOrder<const float>& heights, const LightOrder<Lit>& mask,
                           const Execution& execution)
{
    advance_tracks(heights, mask, execution);
}

void StriderFront::advance(const LightOrder<const float>& heights, const LightOrder<float>& shadow_heights_m,
                           const Execution& execution)
{
    advance_tracks(heights, shadow_heights_m, execution);
}

template <typename Answer>
void StriderFront::advance_tracks(const LightOrder<const float>& heights, const LightOrder<Answer>& answers,
                                  const Execution& execution)
{
    assert(heights.lines == answers.lines && heights.cells == cells_ && answers.cells == cells_);
    assert(heights.cell_step == 1 || std::abs(heights.line_step) == 1);
    if (heights.lines == 0 || cells_ == 0)
        return;
    const auto shifts = shifts_of_tracks(frame_.lateral, next_line_, heights.lines);
    const StripLines all = lines_under_beams(cells_, next_line_, shifts, frame_.lateral, first_track_,
                                             first_track_ + static_cast<std::ptrdiff_t>(line_m_.size()));
    const auto bands = bands_for_threads(all, thread_count(execution), heights.cell_step == 1);
    for_rows(bands.size(), 1, execution, [&](std::size_t i, std::size_t) {
        walk_band<0>(kernels::active_kernels(), all, bands[i], heights, answers,
                     [&](std::size_t, const StripLines& strip, Answer* out, std::ptrdiff_t out_step) {
                         pass_lines(strip, frame_, line_m_.data() + (strip.first_beam - first_track_),
                                    as_values(out), out_step);
                     });
    });
    next_line_ += heights.lines;
}

ShadowMask cast_by_strider(const HeightField& field, const DirectionalLight& light,
                           const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);
    return advance_over_all<StriderFront, Lit>(field, light, execution);
}

ShadowField shadow_heights_by_strider(const HeightField& field, const DirectionalLight& light,
                                      const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);
    return advance_over_all<StriderFront, float>(field, light, execution);
}

} // namespace duskline
