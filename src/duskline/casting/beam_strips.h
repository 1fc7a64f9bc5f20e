#pragma once

// How a caster that carries something along beams of light goes through a grid: in bands of neighbouring beams, one
// to a thread, cut into strips; and where lines are columns of the grid, block by block turned into rows in cache.
// Not installed.

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/terrain/height_field.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace duskline {

/// Beams that a thread carries on at a time, at most. Rows stream by themselves. Columns are turned into rows: a
/// band of beams as wide as its answers stay in the second-level cache, cut into strips whose turned heights do.
inline constexpr std::size_t kMostBeamsAlongRows = 8192;
inline constexpr std::size_t kMostBeamsInBand = 2048;
inline constexpr std::size_t kMostBeamsInStrip = 512;

/// Bands for each of several threads. More would share the work out better among busy ones, but narrow bands of
/// rows stream badly.
inline constexpr std::size_t kBandsPerThread = 1;

/// Columns turned at a time.
inline constexpr std::size_t kLinesPerBlock = 128;

/// Neighbouring beams that one thread carries over all lines, cut into strips: the first beam of each strip, and
/// the end of the last.
using Band = std::vector<std::ptrdiff_t>;

/// Cuts the beams into bands with about as many cells each, since beams that enter or leave the grid on the way meet
/// fewer: at least one to each thread, or `most` when that is less. `along_rows`: cells of a line lie side by side in
/// memory, and a band is one strip.
std::vector<Band> bands_for_threads(const kernels::StripLines& lines, std::size_t threads, bool along_rows,
                                    std::size_t most = std::numeric_limits<std::size_t>::max());

/// Where the beams of a light stand over each of some lines.
std::vector<kernels::BeamShift> beam_shifts(double lateral, std::size_t first_line, std::size_t lines);

/// Lines of `cells` cells, one for each shift, under the beams [first_beam, last_beam) of light that moves sideways by
/// `lateral` cells a line. Keeps a view of the shifts; where the heights are is for a walk to say.
kernels::StripLines lines_under_beams(std::size_t cells, std::size_t first_line,
                                      const std::vector<kernels::BeamShift>& shifts, double lateral,
                                      std::ptrdiff_t first_beam, std::ptrdiff_t last_beam);

inline std::uint8_t* as_bytes(Lit* lit)
{
    return reinterpret_cast<std::uint8_t*>(lit);
}

/// Cells of a line, [first, last).
struct CellRange {
    std::ptrdiff_t first;
    std::ptrdiff_t last;

    bool empty() const { return first >= last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// The way of a band through a grid, all strips of it over some lines before any goes on. `Carry` is called with a
/// strip and some lines of it, cells side by side, and with where their answers go:
/// `carry(std::size_t strip, const StripLines&, Answer* answers, std::ptrdiff_t answer_step)`, the answers laid out
/// as the heights are. `kLinesBefore` lines before the first are there to be read as well, but before the very
/// first of the grid.
template <typename Answer, std::size_t kLinesBefore, typename Carry>
class BandWalk {
public:
    BandWalk(const kernels::Kernels& kernels, const kernels::StripLines& lines, const Band& band,
             const LightOrder<const float>& heights, const LightOrder<Answer>& answers,
             std::size_t unanswered_lines, Carry carry)
        : kernels_(kernels), lines_(lines), band_(band), heights_(heights), answers_(answers),
          unanswered_lines_(unanswered_lines), carry_(std::move(carry))
    {}

    void walk()
    {
        if (heights_.cell_step == 1) {
            for (std::size_t k = 0; k + 1 < band_.size(); ++k) {
                kernels::StripLines strip = strip_lines(k);
                strip.heights = heights_.first;
                strip.line_step = heights_.line_step;
                strip.first_cell = 0;
                carry_(k, strip, answers_.first, answers_.line_step);
            }
            return;
        }
        const kernels::StripLines all = lines_;
        for (std::size_t done = 0; done < all.lines; done += kLinesPerBlock) {
            lines_.first_line = all.first_line + done;
            lines_.lines = std::min(kLinesPerBlock, all.lines - done);
            lines_.shifts = all.shifts + done;
            walk_block(done);
        }
    }

private:
    kernels::StripLines strip_lines(std::size_t k) const
    {
        kernels::StripLines strip = lines_;
        strip.first_beam = band_[k];
        strip.last_beam = band_[k + 1];
        return strip;
    }

    // The cells on line i of the block whose beams are [first_beam, last_beam).
    CellRange cells_of(std::ptrdiff_t first_beam, std::ptrdiff_t last_beam, std::size_t i) const
    {
        const std::ptrdiff_t moved = lines_.sideways * lines_.shifts[i].whole;
        const auto cells = static_cast<std::ptrdiff_t>(lines_.cells);
        return {std::clamp<std::ptrdiff_t>(first_beam + moved, 0, cells),
                std::clamp<std::ptrdiff_t>(last_beam + moved, 0, cells)};
    }

    CellRange own_cells(std::size_t i) const { return cells_of(band_.front(), band_.back(), i); }

    // The cells that beams meet anywhere in the block, and two more on either side.
    CellRange cells_met(std::ptrdiff_t first_beam, std::ptrdiff_t last_beam) const
    {
        const CellRange at_start = cells_of(first_beam, last_beam, 0);
        const CellRange at_end = cells_of(first_beam, last_beam, lines_.lines - 1);
        return {
            std::max<std::ptrdiff_t>(std::min(at_start.first, at_end.first) - 2, 0),
            std::min(std::max(at_start.last, at_end.last) + 2, static_cast<std::ptrdiff_t>(lines_.cells))};
    }

    // Room for so many values and a little more, an odd number of cache lines: the beginnings of lines that follow
    // each other fall into different sets of the cache.
    template <typename T>
    static std::ptrdiff_t padded(std::size_t values)
    {
        constexpr std::size_t in_a_cache_line = 64 / sizeof(T);
        const std::size_t cache_lines = (values + in_a_cache_line - 1) / in_a_cache_line;
        return static_cast<std::ptrdiff_t>((cache_lines | 1U) * in_a_cache_line);
    }

    template <typename T>
    static void make_room(Grid<T>& lines, std::size_t count, std::ptrdiff_t width)
    {
        if (const std::size_t values = count * static_cast<std::size_t>(width); values > lines.size())
            lines = Grid<T>(1, values);
    }

    // `kLinesPerBlock` columns of the grid: turned into lines, carried over, and the answers turned back.
    void walk_block(std::size_t done)
    {
        const CellRange met = cells_met(band_.front(), band_.back());
        const std::ptrdiff_t answers_width = padded<Answer>(met.size());
        make_room(turned_, kLinesPerBlock, answers_width);
        const std::size_t before = std::min(done, kLinesBefore);
        const CellRange all = common_cells(0, lines_.lines);
        std::ptrdiff_t turned = all.first;
        for (std::size_t k = 0; k + 1 < band_.size(); ++k) {
            const CellRange needed = cells_met(band_[k], band_[k + 1]);
            const std::ptrdiff_t width = padded<float>(needed.size());
            make_room(lines_m_, kLinesPerBlock + kLinesBefore, width);
            turn_heights(done - before, lines_.lines + before, needed, width);

            kernels::StripLines strip = strip_lines(k);
            strip.heights = lines_m_.data() + static_cast<std::ptrdiff_t>(before) * width;
            strip.line_step = width;
            strip.first_cell = static_cast<std::size_t>(needed.first);
            carry_(k, strip, turned_.data() + (needed.first - met.first), answers_width);
            // Answers that are complete go back while they are in the cache.
            const std::ptrdiff_t answered = answered_until(k, turned, all);
            turn_back(done, 0, lines_.lines, {turned, answered}, met, answers_width);
            turned = answered;
        }
        turn_sides_back(done, all, met, answers_width);
    }

    // The end of the cells that are answered on all lines once strip k is carried over them: whole squares of a
    // transpose, unless they are the last.
    std::ptrdiff_t answered_until(std::size_t k, std::ptrdiff_t turned, CellRange all) const
    {
        if (k + 2 == band_.size())
            return all.last;
        constexpr std::ptrdiff_t square = 16;
        const std::ptrdiff_t last = std::min(cells_of(band_[k], band_[k + 1], 0).last,
                                             cells_of(band_[k], band_[k + 1], lines_.lines - 1).last);
        return turned + std::max<std::ptrdiff_t>(std::min(last, all.last) - turned, 0) / square * square;
    }

    // From the lowest column on, whichever way the light goes.
    void turn_heights(std::size_t first_line, std::size_t lines, CellRange needed, std::ptrdiff_t width)
    {
        const bool eastwards = heights_.line_step > 0;
        const std::size_t lowest = eastwards ? 0 : lines - 1;
        const float* const from = heights_.first
                                  + static_cast<std::ptrdiff_t>(first_line + lowest) * heights_.line_step
                                  + needed.first * heights_.cell_step;
        float* const to = lines_m_.data() + static_cast<std::ptrdiff_t>(lowest) * width;
        kernels_.transpose_floats(from, heights_.cell_step, needed.size(), lines, to,
                                  eastwards ? width : -width, kernels::RowsFirst::read);
    }

    // Beside the rectangle `all` that is the band's own on all lines: only its own cells may be written, slanted
    // edges of the band, in smaller rectangles and the rest line by line. The thinner the rectangles, the more
    // they hold, but the less of a cache line is written at a time.
    void turn_sides_back(std::size_t done, CellRange all, CellRange needed, std::ptrdiff_t width)
    {
        constexpr std::size_t few = 16;
        for (std::size_t i = 0; i < lines_.lines; i += few) {
            const std::size_t lines = std::min(few, lines_.lines - i);
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

    // The cells that are the band's own on every one of `lines` lines.
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
        if (done + first_line < unanswered_lines_) {
            const std::size_t unanswered = std::min(lines, unanswered_lines_ - done - first_line);
            first_line += unanswered;
            lines -= unanswered;
        }
        if (range.empty() || lines == 0)
            return;
        const bool eastwards = answers_.line_step > 0;
        const std::size_t lowest = eastwards ? first_line : first_line + lines - 1; // column
        const Answer* const from =
            turned_.data() + static_cast<std::ptrdiff_t>(lowest) * width + (range.first - needed.first);
        Answer* const to = answers_.first + static_cast<std::ptrdiff_t>(done + lowest) * answers_.line_step
                           + range.first * answers_.cell_step;
        transpose_answers(from, eastwards ? width : -width, lines, range.size(), to, answers_.cell_step);
    }

    void transpose_answers(const Lit* from, std::ptrdiff_t from_stride, std::size_t rows, std::size_t columns,
                           Lit* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_bytes(reinterpret_cast<const std::uint8_t*>(from), from_stride, rows, columns,
                                 as_bytes(to), to_stride, kernels::RowsFirst::written);
    }

    void transpose_answers(const float* from, std::ptrdiff_t from_stride, std::size_t rows,
                           std::size_t columns, float* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_floats(from, from_stride, rows, columns, to, to_stride,
                                  kernels::RowsFirst::written);
    }

    const kernels::Kernels& kernels_;
    kernels::StripLines lines_;
    const Band& band_;
    const LightOrder<const float>& heights_;
    const LightOrder<Answer>& answers_;
    std::size_t unanswered_lines_;
    Carry carry_;
    Grid<float> lines_m_;
    Grid<Answer> turned_;
};

/// Walks a band through all of its lines (see BandWalk). Whatever `carry` answers on the first `unanswered_lines` of
/// them is not turned back to columns; along rows it must not answer there.
template <std::size_t kLinesBefore, typename Answer, typename Carry>
void walk_band(const kernels::Kernels& kernels, const kernels::StripLines& lines, const Band& band,
               const LightOrder<const float>& heights, const LightOrder<Answer>& answers, Carry carry,
               std::size_t unanswered_lines = 0)
{
    BandWalk<Answer, kLinesBefore, Carry>(kernels, lines, band, heights, answers, unanswered_lines,
                                          std::move(carry))
        .walk();
}

/// All cells of a field by a front that is fed line by line: SweepFront, StriderFront.
template <typename Front, typename Answer>
Grid<Answer> advance_over_all(const HeightField& field, const DirectionalLight& light,
                              const Execution& execution)
{
    const LightFrame frame = light_frame(light, field.cell_size_m);
    Grid<Answer> answers(field.rows(), field.columns());
    const auto heights = in_light_order(field.heights_m, frame);
    Front(heights.lines, heights.cells, frame)
        .advance(heights, in_light_order(answers.view(), frame), execution);
    return answers;
}

} // namespace duskline
