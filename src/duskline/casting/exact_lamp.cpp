// Exact shadows of a lamp: the front of exact.cpp in the frame of beams that all come from one point.
//
// Away from the lamp, wedge by wedge (two across rows, two across columns), a ray keeps two numbers for ever:
//
//      lamp *                        b = cells sideways / lines from the lamp      where it goes
//          /|`.                      g = height over the lamp / lines from it      how steeply
//         / |  `.     line 1
//        /  |    `.                  Straight lines stay straight, and the higher g is the higher shadow. The front
//       /   |      `.  line 2        is the highest g of all lines passed, for every b; exact.cpp's brackets and
//      b=-1 b=0    b=1               candidates hold it, in units between beams 1/N apart.
//
// N is a power of two and above the lines from the lamp, so that a unit holds one sample of a line at most; where the
// lamp is too far for that, every unit is cut in half. What is left open by the brackets is decided by the crossings
// of its ray with the candidates, by the formula of the march itself (lamp_march.h): the answers are the ray's.
//
// Wedges and strips of neighbouring beams are in lamp_wedge.h, the front over a strip in lamp_front.h. Strips know
// nothing of each other; how many there are depends on the grid alone.
//
// The projective frame for light from a point is that of shadow volumes and of perspective shadow maps; the envelope
// by a sweep is exact.cpp's (Reif and Sen 1988). Brackets and candidates, and cutting units in half, are ours.

#include <duskline/casting/exact.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/lamp_front.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace duskline {

namespace {

using kernels::Kernels;

// A strip's way through its wedge: rows as they lie, columns turned into lines block by block.
template <typename Answer>
class LampStripWalk {
public:
    LampStripWalk(const LampCast& cast, const LampWedge& wedge, const LampStrip& strip,
                  const LightOrder<Answer>& answers)
        : kernels_(cast.kernels), heights_(wedge.heights), answers_(answers), front_(cast, wedge, strip)
    {}

    void walk()
    {
        if (heights_.cell_step == 1) {
            for (std::size_t line = 0; line < heights_.lines; ++line) {
                const auto v = static_cast<std::ptrdiff_t>(line);
                front_.carry(v, heights_.first + v * heights_.line_step,
                             answers_.first + v * answers_.line_step);
            }
            return;
        }
        for (std::size_t done = 0; done < heights_.lines; done += kLinesPerBlock)
            walk_block(done, std::min(kLinesPerBlock, heights_.lines - done));
    }

private:
    void walk_block(std::size_t done, std::size_t lines)
    {
        const auto first_line = static_cast<std::ptrdiff_t>(done);
        const CellRange at_start = front_.needed_cells(first_line);
        const CellRange at_end = front_.needed_cells(first_line + static_cast<std::ptrdiff_t>(lines) - 1);
        const CellRange needed{std::min(at_start.first, at_end.first), std::max(at_start.last, at_end.last)};
        if (needed.empty())
            return;
        const auto width = static_cast<std::ptrdiff_t>(needed.size());
        lines_m_.resize(needed.size() * kLinesPerBlock);
        turned_.resize(needed.size() * kLinesPerBlock);
        first_own_.assign(needed.size(), 0);
        end_own_.assign(needed.size(), 0);

        const bool eastwards = heights_.line_step > 0;
        const std::size_t lowest = eastwards ? 0 : lines - 1;
        const float* const from = heights_.first
                                  + static_cast<std::ptrdiff_t>(done + lowest) * heights_.line_step
                                  + needed.first * heights_.cell_step;
        kernels_.transpose_floats(from, heights_.cell_step, needed.size(), lines,
                                  lines_m_.data() + static_cast<std::ptrdiff_t>(lowest) * width,
                                  eastwards ? width : -width, kernels::RowsFirst::read);
        for (std::size_t i = 0; i < lines; ++i) {
            const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) * width - needed.first;
            own_[i] = front_.carry(first_line + static_cast<std::ptrdiff_t>(i), lines_m_.data() + at,
                                   turned_.data() + at);
        }
        note_own_lines(lines, needed);
        turn_back(done, lines, needed);
    }

    // Which lines of the block are the strip's own at every cell: those from `first_own_` to before `end_own_`.
    void note_own_lines(std::size_t lines, CellRange needed)
    {
        const auto fill = [&](std::vector<std::uint8_t>& of_cell, std::size_t i, std::size_t value) {
            std::fill(of_cell.begin() + (std::max(own_[i].first, needed.first) - needed.first),
                      of_cell.begin() + (std::max(own_[i].last, needed.first) - needed.first),
                      static_cast<std::uint8_t>(value));
        };
        for (std::size_t i = 0; i < lines; ++i)
            if (!own_[i].empty())
                fill(end_own_, i, i + 1);
        for (std::size_t i = lines; i-- > 0;)
            if (!own_[i].empty())
                fill(first_own_, i, i);
    }

    void turn_back(std::size_t done, std::size_t lines, CellRange needed)
    {
        const auto width = static_cast<std::ptrdiff_t>(needed.size());
        tile_.resize(needed.size() * kLinesPerBlock);
        transpose(turned_.data(), width, lines, needed.size(), tile_.data(),
                  static_cast<std::ptrdiff_t>(kLinesPerBlock));
        for (std::size_t cell = 0; cell < needed.size(); ++cell) {
            const Answer* const from = tile_.data() + cell * kLinesPerBlock;
            Answer* const to = answers_.first + static_cast<std::ptrdiff_t>(done) * answers_.line_step
                               + (needed.first + static_cast<std::ptrdiff_t>(cell)) * answers_.cell_step;
            for (std::ptrdiff_t i = first_own_[cell]; i < end_own_[cell]; ++i)
                to[i * answers_.line_step] = from[i];
        }
    }

    void transpose(const Lit* from, std::ptrdiff_t from_stride, std::size_t rows, std::size_t columns,
                   Lit* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_bytes(reinterpret_cast<const std::uint8_t*>(from), from_stride, rows, columns,
                                 as_bytes(to), to_stride, kernels::RowsFirst::written);
    }
    void transpose(const float* from, std::ptrdiff_t from_stride, std::size_t rows, std::size_t columns,
                   float* to, std::ptrdiff_t to_stride) const
    {
        kernels_.transpose_floats(from, from_stride, rows, columns, to, to_stride,
                                  kernels::RowsFirst::written);
    }

    const Kernels& kernels_;
    const LightOrder<const float>& heights_;
    LightOrder<Answer> answers_;
    LampFront front_;
    std::vector<float> lines_m_;
    std::vector<Answer> turned_;
    std::vector<Answer> tile_;
    std::array<CellRange, kLinesPerBlock> own_;
    std::vector<std::uint8_t> first_own_;
    std::vector<std::uint8_t> end_own_;
};

template <typename Answer>
LightOrder<Answer> answers_of(const LampWedge& wedge, Grid<Answer>& answers)
{
    LightFrame frame;
    frame.lines_are_rows = wedge.lines_are_rows;
    frame.first_line_is_index_0 = wedge.direction > 0;
    const auto order = in_light_order(answers.view(), frame);
    return order.part(order.lines - wedge.heights.lines, wedge.heights.lines);
}

// The cell right under the lamp is in no wedge, and nothing is above it but its own ground.
template <typename Answer>
void answer_under_lamp(const HeightField& field, const GridPoint& lamp, Grid<Answer>& answers)
{
    if (lamp.row != std::floor(lamp.row) || lamp.column != std::floor(lamp.column) || lamp.row < 0.0
        || lamp.column < 0.0 || lamp.row >= static_cast<double>(field.rows())
        || lamp.column >= static_cast<double>(field.columns()))
        return;
    const auto row = static_cast<std::size_t>(lamp.row);
    const auto column = static_cast<std::size_t>(lamp.column);
    const bool is_known = !std::isnan(field.heights_m(row, column));
    if constexpr (std::is_same_v<Answer, Lit>)
        answers(row, column) = is_known ? Lit::yes : Lit::unknown;
    else
        answers(row, column) =
            is_known ? static_cast<float>(kNothing) : std::numeric_limits<float>::quiet_NaN();
}

template <typename Answer>
Grid<Answer> cast_all(const HeightField& field, const PointLight& light, const Execution& execution,
                      const Kernels& kernels)
{
    Grid<Answer> answers(field.rows(), field.columns());
    if (answers.empty())
        return answers;
    const LampMarch march(field, light, {}); // asked for single crossings only
    const LampCast cast{march, kernels};
    struct Task {
        std::size_t wedge;
        LampStrip strip;
    };
    std::vector<LampWedge> wedges;
    std::vector<Task> tasks;
    for (const bool lines_are_rows : {true, false})
        for (const bool rising : {true, false}) {
            wedges.push_back(wedge_of(field, march.lamp(), lines_are_rows, rising));
            for (const LampStrip& strip : strips_of(wedges.back()))
                tasks.push_back({wedges.size() - 1, strip});
        }
    answer_under_lamp(field, march.lamp(), answers);
    for_rows(tasks.size(), 1, execution, [&](std::size_t i, std::size_t) {
        const LampWedge& wedge = wedges[tasks[i].wedge];
        LampStripWalk<Answer>(cast, wedge, tasks[i].strip, answers_of(wedge, answers)).walk();
    });
    return answers;
}

} // namespace

ShadowMask cast_by_exact(const HeightField& field, const PointLight& light, const Execution& execution)
{
    return cast_by_exact(field, light, execution, kernels::active_kernels().isa);
}

ShadowMask cast_by_exact(const HeightField& field, const PointLight& light, const Execution& execution,
                         std::string_view isa)
{
    require_valid(field);
    require_valid(light);
    const Kernels& kernels = kernels::kernels_named(isa);
    if (const auto answer = uniform_answer(field, light))
        return uniform_mask(field, *answer);
    return cast_all<Lit>(field, light, execution, kernels);
}

ShadowField shadow_heights_by_exact(const HeightField& field, const PointLight& light,
                                    const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(field, light))
        return uniform_shadow_heights(field, *answer);
    return cast_all<float>(field, light, execution, kernels::active_kernels());
}

} // namespace duskline
