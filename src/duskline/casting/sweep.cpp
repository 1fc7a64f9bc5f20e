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

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/sweep.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace duskline {

namespace {

using kernels::BeamShift;
using kernels::Kernels;
using kernels::SweepLines;

// Lower than any ground, and finite, because fronts are interpolated.
constexpr float kNoShadow_m = -1.0e30f;

// Steeper light than this shades nothing anyone could have measured; more would overflow the tilt.
constexpr double kSteepestDrop_m = 1.0e15;

// Beams in a strip: enough to stream along a row, few enough that the columns of a strip stay in the
// translation look-aside buffer and its turned block in the second-level cache.
constexpr std::size_t kMostBeamsAlongRows = 8192;
constexpr std::size_t kMostBeamsAlongColumns = 512;

// Strips for each of several threads, so that one that comes late finds less to do.
constexpr std::size_t kStripsPerThread = 2;

// Columns turned at a time.
constexpr std::size_t kLinesPerBlock = 64;

const Kernels& kernels_named(std::string_view isa)
{
    std::string names;
    for (const Kernels& candidate : kernels::runnable_kernels()) {
        if (candidate.isa == isa)
            return candidate;
        names += (names.empty() ? "" : ", ") + std::string(candidate.isa);
    }
    throw InvalidInput("no SIMD level '" + std::string(isa) + "' on this machine; there are: " + names);
}

std::uint8_t* as_bytes(Lit* lit)
{
    return reinterpret_cast<std::uint8_t*>(lit);
}

float* sweep(const Kernels& kernels, const SweepLines& lines, Lit* mask, std::ptrdiff_t line_step)
{
    return kernels.sweep_mask(lines, as_bytes(mask), line_step);
}

float* sweep(const Kernels& kernels, const SweepLines& lines, float* shadow_m, std::ptrdiff_t line_step)
{
    return kernels.sweep_shadow_heights(lines, shadow_m, line_step);
}

void transpose(const Kernels& kernels, const Lit* from, std::ptrdiff_t from_stride, std::size_t rows,
               std::size_t columns, Lit* to, std::ptrdiff_t to_stride)
{
    kernels.transpose_bytes(reinterpret_cast<const std::uint8_t*>(from), from_stride, rows, columns,
                            as_bytes(to), to_stride);
}

void transpose(const Kernels& kernels, const float* from, std::ptrdiff_t from_stride, std::size_t rows,
               std::size_t columns, float* to, std::ptrdiff_t to_stride)
{
    kernels.transpose_floats(from, from_stride, rows, columns, to, to_stride);
}

// Cells of a line that some beams are over, [first, last).
struct CellRange {
    std::ptrdiff_t first;
    std::ptrdiff_t last;

    bool empty() const { return first >= last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

// A strip of beams on its way over some lines.
template <typename Answer>
class Strip {
public:
    Strip(const Kernels& kernels, SweepLines lines, const LightOrder<const float>& heights,
          const LightOrder<Answer>& answers)
        : kernels_(kernels), sweep_(lines), heights_(heights), answers_(answers)
    {}

    // Returns the copy of the front that is the newer after all lines.
    float* carry_over_rows()
    {
        sweep_.heights = heights_.first;
        sweep_.line_step = heights_.line_step;
        sweep_.first_cell = 0;
        return sweep(kernels_, sweep_, answers_.first, answers_.line_step);
    }

    float* carry_over_columns()
    {
        const std::size_t first_line = sweep_.first_line;
        const std::size_t lines = sweep_.lines;
        const BeamShift* const shifts = sweep_.shifts;
        for (std::size_t done = 0; done < lines; done += kLinesPerBlock) {
            sweep_.first_line = first_line + done;
            sweep_.lines = std::min(kLinesPerBlock, lines - done);
            sweep_.shifts = shifts + done;
            carry_over_block(done);
        }
        return sweep_.front;
    }

private:
    // The cells that are the strip's own on line i of the block.
    CellRange own_cells(std::size_t i) const
    {
        const std::ptrdiff_t moved = sweep_.sideways * sweep_.shifts[i].whole;
        const auto cells = static_cast<std::ptrdiff_t>(sweep_.cells);
        return {std::clamp<std::ptrdiff_t>(sweep_.first_beam + moved, 0, cells),
                std::clamp<std::ptrdiff_t>(sweep_.last_beam + moved, 0, cells)};
    }

    // `kLinesPerBlock` columns of the grid: turned into lines, swept, and the answers turned back.
    void carry_over_block(std::size_t done)
    {
        const CellRange at_start = own_cells(0);
        const CellRange at_end = own_cells(sweep_.lines - 1);
        // The neighbouring beam and the cell ahead of each: two cells more on either side.
        const auto cells = static_cast<std::ptrdiff_t>(sweep_.cells);
        const CellRange needed{std::max<std::ptrdiff_t>(std::min(at_start.first, at_end.first) - 2, 0),
                               std::min(std::max(at_start.last, at_end.last) + 2, cells)};

        const auto width = static_cast<std::ptrdiff_t>(needed.size());
        lines_m_.resize(needed.size() * kLinesPerBlock);
        turned_.resize(needed.size() * kLinesPerBlock);
        turn_heights(done, needed, width);

        sweep_.heights = lines_m_.data();
        sweep_.line_step = width;
        sweep_.first_cell = static_cast<std::size_t>(needed.first);
        float* const newer = sweep(kernels_, sweep_, turned_.data(), width);
        if (newer != sweep_.front)
            std::swap(sweep_.front, sweep_.other_front);
        turn_answers_back(done, needed, width);
    }

    // From the lowest column on, whichever way the light goes.
    void turn_heights(std::size_t done, CellRange needed, std::ptrdiff_t width)
    {
        const bool eastwards = heights_.line_step > 0;
        const std::size_t lowest = eastwards ? 0 : sweep_.lines - 1;
        const float* const from = heights_.first
                                  + static_cast<std::ptrdiff_t>(done + lowest) * heights_.line_step
                                  + needed.first * heights_.cell_step;
        float* const to = lines_m_.data() + static_cast<std::ptrdiff_t>(lowest) * width;
        transpose(kernels_, from, heights_.cell_step, needed.size(), sweep_.lines, to,
                  eastwards ? width : -width);
    }

    // Only the strip's own cells may be written, a slanted band of the block: the rectangle that all its lines
    // have in common as one, what is left at both sides in smaller rectangles, the rest line by line.
    // The thinner the rectangles, the more of the band they hold, but the less of a cache line is written at
    // a time.
    void turn_answers_back(std::size_t done, CellRange needed, std::ptrdiff_t width)
    {
        constexpr std::size_t few = 16;
        const CellRange all = common_cells(0, sweep_.lines);
        turn_back(done, 0, sweep_.lines, all, needed, width);
        for (std::size_t i = 0; i < sweep_.lines; i += few) {
            const std::size_t lines = std::min(few, sweep_.lines - i);
            const CellRange some = common_cells(i, lines);
            turn_back(done, i, lines, {some.first, std::min(some.last, all.first)}, needed, width);
            turn_back(done, i, lines, {std::max(some.first, all.last), some.last}, needed, width);
            for (std::size_t k = i; k < i + lines; ++k) {
                const CellRange own = own_cells(k);
                turn_back(done, k, 1, {own.first, std::min(own.last, some.first)}, needed, width);
                turn_back(done, k, 1, {std::max(own.first, some.last), own.last}, needed, width);
            }
        }
    }

    // The cells that are the strip's own on every one of `lines` lines.
    CellRange common_cells(std::size_t first_line, std::size_t lines) const
    {
        const CellRange at_start = own_cells(first_line);
        const CellRange at_end = own_cells(first_line + lines - 1);
        const CellRange both{std::max(at_start.first, at_end.first), std::min(at_start.last, at_end.last)};
        return both.empty() ? CellRange{both.first, both.first} : both;
    }

    void turn_back(std::size_t done, std::size_t first_line, std::size_t lines, CellRange range,
                   CellRange needed, std::ptrdiff_t width)
    {
        if (range.empty())
            return;
        const bool eastwards = answers_.line_step > 0;
        const std::size_t lowest = eastwards ? first_line : first_line + lines - 1; // column
        const Answer* const from =
            turned_.data() + static_cast<std::ptrdiff_t>(lowest) * width + (range.first - needed.first);
        Answer* const to = answers_.first + static_cast<std::ptrdiff_t>(done + lowest) * answers_.line_step
                           + range.first * answers_.cell_step;
        transpose(kernels_, from, eastwards ? width : -width, lines, range.size(), to, answers_.cell_step);
    }

    const Kernels& kernels_;
    SweepLines sweep_;
    const LightOrder<const float>& heights_;
    const LightOrder<Answer>& answers_;
    std::vector<float> lines_m_;
    std::vector<Answer> turned_;
};

// Cuts the beams into at least `strips` strips of at most `widest` beams with about as many cells each: beams that
// enter or leave the grid on the way meet fewer. Returns the first beam of each strip and the end of the last.
std::vector<std::ptrdiff_t> strips_of_equal_work(const SweepLines& lines, std::size_t strips,
                                                 std::size_t widest)
{
    // How many lines lie before the beams have moved by `whole` cells.
    const std::ptrdiff_t least = lines.shifts[0].whole;
    const std::ptrdiff_t most = lines.shifts[lines.lines - 1].whole;
    std::vector<std::size_t> lines_before(static_cast<std::size_t>(most - least) + 2, lines.lines);
    for (std::size_t i = lines.lines; i-- > 0;)
        lines_before[static_cast<std::size_t>(lines.shifts[i].whole - least)] = i;
    const auto before = [&](std::ptrdiff_t whole) {
        return lines_before[static_cast<std::size_t>(std::clamp(whole, least, most + 1) - least)];
    };
    const auto cells = static_cast<std::ptrdiff_t>(lines.cells);
    const auto work = [&](std::ptrdiff_t beam) { // lines on which 0 <= beam + sideways * whole < cells
        return 1
               + (lines.sideways > 0 ? before(cells - beam) - before(-beam)
                                     : before(beam + 1) - before(beam - cells + 1));
    };

    std::size_t total = 0;
    for (std::ptrdiff_t beam = lines.first_beam; beam < lines.last_beam; ++beam)
        total += work(beam);
    const std::size_t share = total / strips + 1;
    std::vector<std::ptrdiff_t> bounds{lines.first_beam};
    std::size_t done = 0;
    for (std::ptrdiff_t beam = lines.first_beam; beam < lines.last_beam; ++beam) {
        const auto width = static_cast<std::size_t>(beam - bounds.back());
        if (width > 0 && (done >= share || width == widest)) {
            bounds.push_back(beam);
            done = 0;
        }
        done += work(beam);
    }
    bounds.push_back(lines.last_beam);
    return bounds;
}

SweepFront front_for(const HeightField& field, const LightFrame& frame)
{
    const std::size_t lines = frame.lines_are_rows ? field.rows() : field.columns();
    const std::size_t cells = frame.lines_are_rows ? field.columns() : field.rows();
    return {lines, cells, frame};
}

template <typename Answer>
Grid<Answer> sweep_all(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    const LightFrame frame = light_frame(light, field.cell_size_m);
    Grid<Answer> answers(field.rows(), field.columns());
    front_for(field, frame)
        .advance(in_light_order(field.heights_m, frame), in_light_order(answers.view(), frame), execution);
    return answers;
}

} // namespace

SweepFront::SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame)
    : kernels_(&kernels::active_kernels()), frame_(frame), cells_(cells)
{
    frame_.drop_m = std::min(frame_.drop_m, kSteepestDrop_m);
    const std::ptrdiff_t drift = lines == 0 ? 0 : kernels::beam_shift(frame_.lateral, lines - 1).whole;
    first_beam_ = frame_.lateral < 0.0 ? 0 : -drift;
    // One more on either side, so that every beam has neighbours.
    front_m_.assign(cells + static_cast<std::size_t>(drift) + 2, kNoShadow_m);
    next_front_m_ = front_m_;
}

SweepFront::SweepFront(std::size_t lines, std::size_t cells, const LightFrame& frame, std::string_view isa)
    : SweepFront(lines, cells, frame)
{
    kernels_ = &kernels_named(isa);
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
    const bool rows = heights.cell_step == 1;

    std::vector<BeamShift> shifts(heights.lines);
    for (std::size_t i = 0; i < shifts.size(); ++i)
        shifts[i] = kernels::beam_shift(frame_.lateral, next_line_ + i);

    SweepLines lines;
    lines.cells = cells_;
    lines.first_line = next_line_;
    lines.lines = heights.lines;
    lines.shifts = shifts.data();
    lines.sideways = frame_.lateral < 0.0 ? -1 : 1;
    lines.drop_m = static_cast<float>(frame_.drop_m);
    lines.first_beam = first_beam_;
    lines.last_beam = first_beam_ + static_cast<std::ptrdiff_t>(front_m_.size()) - 2;

    const std::size_t threads = thread_count(execution);
    const auto strips = strips_of_equal_work(lines, threads == 1 ? 1 : kStripsPerThread * threads,
                                             rows ? kMostBeamsAlongRows : kMostBeamsAlongColumns);
    for_rows(strips.size() - 1, 1, execution, [&](std::size_t i, std::size_t) {
        const auto first = strips[i] - lines.first_beam; // of the front
        const auto last = strips[i + 1] - lines.first_beam;
        std::vector<float> front(front_m_.begin() + first, front_m_.begin() + last + 2);
        std::vector<float> other = front;
        SweepLines own = lines;
        own.first_beam = strips[i];
        own.last_beam = strips[i + 1];
        own.front = front.data();
        own.other_front = other.data();
        Strip<Answer> strip(*kernels_, own, heights, answers);
        const float* newer = rows ? strip.carry_over_rows() : strip.carry_over_columns();
        std::copy_n(newer + 1, last - first, next_front_m_.begin() + first + 1);
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
    return sweep_all<Lit>(field, light, execution);
}

ShadowField shadow_heights_by_sweep(const HeightField& field, const DirectionalLight& light,
                                    const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);
    return sweep_all<float>(field, light, execution);
}

} // namespace duskline
