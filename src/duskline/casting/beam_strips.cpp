#include <duskline/casting/beam_strips.h>

namespace duskline {

std::vector<kernels::BeamShift> beam_shifts(double lateral, std::size_t first_line, std::size_t lines)
{
    std::vector<kernels::BeamShift> shifts(lines);
    for (std::size_t i = 0; i < lines; ++i)
        shifts[i] = kernels::beam_shift(lateral, first_line + i);
    return shifts;
}

std::vector<std::ptrdiff_t> strips_of_equal_work(const kernels::StripLines& lines, std::size_t strips,
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

} // namespace duskline
