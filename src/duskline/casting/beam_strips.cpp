#include <duskline/casting/beam_strips.h>

namespace duskline {

std::vector<kernels::BeamShift> beam_shifts(double lateral, std::size_t first_line, std::size_t lines)
{
    std::vector<kernels::BeamShift> shifts(lines);
    for (std::size_t i = 0; i < lines; ++i)
        shifts[i] = kernels::beam_shift(lateral, first_line + i);
    return shifts;
}

namespace {

// Strips of about the same width.
Band cut_into_strips(std::ptrdiff_t first_beam, std::ptrdiff_t last_beam, std::size_t widest)
{
    const auto beams = static_cast<std::size_t>(last_beam - first_beam);
    const std::size_t strips = (beams + widest - 1) / widest;
    Band band;
    for (std::size_t k = 0; k <= strips; ++k)
        band.push_back(first_beam + static_cast<std::ptrdiff_t>(beams * k / strips));
    return band;
}

std::vector<Band> bands_of_equal_work(const kernels::StripLines& lines, std::size_t bands, bool along_rows)
{
    const std::size_t widest = along_rows ? kMostBeamsAlongRows : kMostBeamsInBand;
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
    const std::size_t share = total / bands + 1;
    std::vector<Band> cut;
    std::ptrdiff_t first = lines.first_beam;
    std::size_t done = 0;
    const auto end_band = [&](std::ptrdiff_t last) {
        cut.push_back(cut_into_strips(first, last, along_rows ? widest : kMostBeamsInStrip));
        first = last;
        done = 0;
    };
    for (std::ptrdiff_t beam = lines.first_beam; beam < lines.last_beam; ++beam) {
        const auto width = static_cast<std::size_t>(beam - first);
        if (width > 0 && (done >= share || width == widest))
            end_band(beam);
        done += work(beam);
    }
    end_band(lines.last_beam);
    return cut;
}

} // namespace

std::vector<Band> bands_for_threads(const kernels::StripLines& lines, std::size_t threads, bool along_rows,
                                    std::size_t most)
{
    return bands_of_equal_work(lines, threads == 1 ? 1 : std::min(kBandsPerThread * threads, most),
                               along_rows);
}

kernels::StripLines lines_under_beams(std::size_t cells, std::size_t first_line,
                                      const std::vector<kernels::BeamShift>& shifts, double lateral,
                                      std::ptrdiff_t first_beam, std::ptrdiff_t last_beam)
{
    kernels::StripLines lines;
    lines.cells = cells;
    lines.first_line = first_line;
    lines.lines = shifts.size();
    lines.shifts = shifts.data();
    lines.sideways = lateral < 0.0 ? -1 : 1;
    lines.first_beam = first_beam;
    lines.last_beam = last_beam;
    return lines;
}

} // namespace duskline
