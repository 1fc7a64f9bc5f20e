#include <duskline/casting/lamp_wedge.h>

#include <algorithm>
#include <cmath>

namespace duskline {

namespace {

// Beams between b = 0 and 1 at least.
constexpr double kFewestBeams = 16.0;

// Cells on a strip's longest line.
constexpr std::size_t kCellsPerStrip = 1024;

// The mean of what is known on a line; 0 when nothing is.
double mean_m(const LampWedge& wedge, std::size_t line)
{
    double sum_m = 0.0;
    std::size_t count = 0;
    for (std::size_t cell = 0; cell < wedge.heights.cells; ++cell)
        if (const float height_m = wedge.heights.at(line, cell); !std::isnan(height_m)) {
            sum_m += height_m;
            ++count;
        }
    return count == 0 ? 0.0 : sum_m / static_cast<double>(count);
}

// Puts the reference beam and plane through the middle of the wedge, and finds its outermost beams.
void aim(LampWedge& wedge, double lamp_m)
{
    const std::size_t middle = wedge.heights.lines / 2;
    const auto last_line = static_cast<std::ptrdiff_t>(wedge.heights.lines) - 1;
    const double last_cell = static_cast<double>(wedge.heights.cells) - 1.0;
    const double distance = wedge.distance(static_cast<std::ptrdiff_t>(middle));
    wedge.reference_line = static_cast<double>(middle);
    const double beside = std::clamp(wedge.lamp_cell, 0.0, last_cell) - wedge.lamp_cell;
    wedge.lean = std::clamp(beside / distance, -1.0, 1.0);
    wedge.reference_cell = wedge.lamp_cell + wedge.lean * distance;
    wedge.reference_m = mean_m(wedge, middle);
    wedge.climb_m = (wedge.reference_m - lamp_m) / distance;

    const double nearest = wedge.distance(0);
    const double farthest = wedge.distance(last_line);
    const double first = 0.0 - wedge.lamp_cell;
    const double last = last_cell - wedge.lamp_cell;
    wedge.lowest_b = std::max(-1.0, std::min(first / nearest, first / farthest));
    wedge.highest_b = std::min(1.0, std::max(last / nearest, last / farthest));
}

} // namespace

CellRange LampWedge::own_cells(std::ptrdiff_t line) const
{
    const auto cells = static_cast<double>(heights.cells);
    const auto last = static_cast<std::ptrdiff_t>(heights.cells);
    const double far = distance(line);
    const auto clamped = [&](double cell) {
        return static_cast<std::ptrdiff_t>(std::clamp(cell, 0.0, cells));
    };
    CellRange own{clamped(std::ceil(lamp_cell - far) - 1.0), clamped(std::floor(lamp_cell + far) + 2.0)};
    while (own.first < own.last && !owns(line, own.first))
        ++own.first;
    while (own.first < own.last && !owns(line, own.last - 1))
        --own.last;
    return {own.first, std::min(own.last, last)};
}
LampWedge wedge_of(const HeightField& field, const GridPoint& lamp, bool lines_are_rows, bool rising)
{
    LightFrame frame;
    frame.lines_are_rows = lines_are_rows;
    frame.first_line_is_index_0 = rising;
    const auto order = in_light_order(field.heights_m, frame);
    const auto count = static_cast<std::ptrdiff_t>(order.lines);
    LampWedge wedge{};
    wedge.lines_are_rows = lines_are_rows;
    wedge.direction = rising ? 1 : -1;
    wedge.index_count = count;
    wedge.lamp_index = lines_are_rows ? lamp.row : lamp.column;
    wedge.lamp_cell = lines_are_rows ? lamp.column : lamp.row;
    const double beyond = rising ? std::floor(wedge.lamp_index) + 1.0 : std::ceil(wedge.lamp_index) - 1.0;
    wedge.first_index = static_cast<std::ptrdiff_t>(
        std::clamp(beyond, rising ? 0.0 : -1.0, static_cast<double>(rising ? count : count - 1)));
    const std::ptrdiff_t skipped = rising ? wedge.first_index : count - 1 - wedge.first_index;
    wedge.heights = order.part(static_cast<std::size_t>(skipped), static_cast<std::size_t>(count - skipped));
    if (wedge.heights.lines == 0)
        return wedge;
    aim(wedge, lamp.height_m);
    if (!(wedge.lowest_b <= wedge.highest_b))
        wedge.heights.lines = 0;
    return wedge;
}

std::vector<LampStrip> strips_of(const LampWedge& wedge)
{
    if (wedge.heights.lines == 0)
        return {};
    double beams = kFewestBeams;
    while (wedge.distance(0) * kBeamSpare > beams)
        beams *= 2.0;
    const auto first = static_cast<std::int64_t>(std::floor((wedge.lowest_b - wedge.lean) * beams));
    const auto last = static_cast<std::int64_t>(std::ceil((wedge.highest_b - wedge.lean) * beams)) + 1;
    const double longest =
        std::min(static_cast<double>(wedge.heights.cells),
                 (wedge.highest_b - wedge.lowest_b)
                     * wedge.distance(static_cast<std::ptrdiff_t>(wedge.heights.lines) - 1));
    const auto count = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(longest) / static_cast<std::int64_t>(kCellsPerStrip), 1, last - first);
    std::vector<LampStrip> strips;
    for (std::int64_t i = 0; i < count; ++i)
        strips.push_back({beams, first + (last - first) * i / count, first + (last - first) * (i + 1) / count,
                          i == 0, i + 1 == count});
    return strips;
}

} // namespace duskline
