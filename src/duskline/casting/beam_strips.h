#pragma once

// How a caster that carries something along beams of light goes through a grid: strip by strip of neighbouring
// beams, and where lines are columns of the grid, block by block turned into rows in cache. Not installed.

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace duskline {

/// Beams in a strip at most: few enough that the columns of a strip stay in the translation look-aside buffer
/// and its turned block in the second-level cache. Rows stream by themselves.
inline constexpr std::size_t kMostBeamsAlongRows = 8192;
inline constexpr std::size_t kMostBeamsAlongColumns = 512;

/// Strips for each of several threads. More would share the work out better among busy ones, but narrow strips of
/// rows stream badly.
inline constexpr std::size_t kStripsPerThread = 1;

/// Columns turned at a time.
inline constexpr std::size_t kLinesPerBlock = 64;

/// Cuts the beams into at least `strips` strips of at most `widest` beams with about as many cells each: beams
/// that enter or leave the grid on the way meet fewer. Returns the first beam of each strip and the end of the
/// last.
std::vector<std::ptrdiff_t> strips_of_equal_work(const kernels::StripLines& lines, std::size_t strips,
                                                 std::size_t widest);

/// Where the beams of a light stand over each of some lines.
std::vector<kernels::BeamShift> beam_shifts(double lateral, std::size_t first_line, std::size_t lines);

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

/// One strip's way through a grid. `Carry` is called with some lines of the strip, cells side by side, and with
/// where their answers go: `carry(const StripLines&, Answer* answers, std::ptrdiff_t answer_step)`, the answers
/// laid out as the heights are. `kLinesBefore` lines before the first are there to be read as well, but before
/// the very first of the grid.
template <typename Answer, std::size_t kLinesBefore, typename Carry>
class StripWalk {
public:
    StripWalk(const kernels::Kernels& kernels, kernels::StripLines strip,
              const LightOrder<const float>& heights, const LightOrder<Answer>& answers, Carry carry)
        : kernels_(kernels), strip_(strip), heights_(heights), answers_(answers), carry_(std::move(carry))
    {}

    void walk()
    {
        if (heights_.cell_step == 1) {
            strip_.heights = heights_.first;
            strip_.line_step = heights_.line_step;
            strip_.first_cell = 0;
            carry_(strip_, answers_.first, answers_.line_step);
            return;
        }
        const kernels::StripLines all = strip_;
        for (std::size_t done = 0; done < all.lines; done += kLinesPerBlock) {
            strip_.first_line = all.first_line + done;
            strip_.lines = std::min(kLinesPerBlock, all.lines - done);
            strip_.shifts = all.shifts + done;
            walk_block(done);
        }
    }

private:
    // The cells that are the strip's own on line i of the block.
    CellRange own_cells(std::size_t i) const
    {
        const std::ptrdiff_t moved = strip_.sideways * strip_.shifts[i].whole;
        const auto cells = static_cast<std::ptrdiff_t>(strip_.cells);
        return {std::clamp<std::ptrdiff_t>(strip_.first_beam + moved, 0, cells),
                std::clamp<std::ptrdiff_t>(strip_.last_beam + moved, 0, cells)};
    }

    // `kLinesPerBlock` columns of the grid: turned into lines, carried over, and the answers turned back.
    void walk_block(std::size_t done)
    {
        const CellRange at_start = own_cells(0);
        const CellRange at_end = own_cells(strip_.lines - 1);
        const auto cells = static_cast<std::ptrdiff_t>(strip_.cells);
        const CellRange needed{std::max<std::ptrdiff_t>(std::min(at_start.first, at_end.first) - 2, 0),
                               std::min(std::max(at_start.last, at_end.last) + 2, cells)};

        const std::size_t before = std::min(done, kLinesBefore);
        const auto width = static_cast<std::ptrdiff_t>(needed.size());
        lines_m_.resize(needed.size() * (kLinesPerBlock + kLinesBefore));
        turned_.resize(needed.size() * kLinesPerBlock);
        turn_heights(done - before, strip_.lines + before, needed, width);

        strip_.heights = lines_m_.data() + static_cast<std::ptrdiff_t>(before) * width;
        strip_.line_step = width;
        strip_.first_cell = static_cast<std::size_t>(needed.first);
        carry_(strip_, turned_.data(), width);
        turn_answers_back(done, needed, width);
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
                                  eastwards ? width : -width);
    }

    // Only the strip's own cells may be written, a slanted band of the block: the rectangle that all its lines
    // have in common as one, what is left at both sides in smaller rectangles, the rest line by line.
    // The thinner the rectangles, the more of the band they hold, but the less of a cache line is written at
    // a time.
    void turn_answers_back(std::size_t done, CellRange needed, std::ptrdiff_t width)
    {
        constexpr std::size_t few = 16;
        const CellRange all = common_cells(0, strip_.lines);
        turn_back(done, 0, strip_.lines, all, needed, width);
        for (std::size_t i = 0; i < strip_.lines; i += few) {
            const std::size_t lines = std::min(few, strip_.lines - i);
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
        transpose_answers(from, eastwards ? width : -width, lines, range.size(), to, answers_.cell_step);
    }

    void transpose_answers(const Lit* from, std::ptrdiff_t from_stride, std::size_t rows, std::size_t columns,
                           Lit* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_bytes(reinterpret_cast<const std::uint8_t*>(from), from_stride, rows, columns,
                                 as_bytes(to), to_stride);
    }

    void transpose_answers(const float* from, std::ptrdiff_t from_stride, std::size_t rows,
                           std::size_t columns, float* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_floats(from, from_stride, rows, columns, to, to_stride);
    }

    const kernels::Kernels& kernels_;
    kernels::StripLines strip_;
    const LightOrder<const float>& heights_;
    const LightOrder<Answer>& answers_;
    Carry carry_;
    std::vector<float> lines_m_;
    std::vector<Answer> turned_;
};

/// Walks a strip through all of its lines (see StripWalk).
template <std::size_t kLinesBefore, typename Answer, typename Carry>
void walk_strip(const kernels::Kernels& kernels, const kernels::StripLines& strip,
                const LightOrder<const float>& heights, const LightOrder<Answer>& answers, Carry carry)
{
    StripWalk<Answer, kLinesBefore, Carry>(kernels, strip, heights, answers, std::move(carry)).walk();
}

} // namespace duskline
