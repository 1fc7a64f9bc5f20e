#pragma once

// How a lamp sees the grid: four wedges of lines, and the beams between which their cells lie. Not installed.
//
//      lamp *            b = cells sideways / lines from the lamp, -1 to 1 in a wedge. A strip is a part of its
//          /|`.          units, the spaces between neighbouring beams.
//         / |  `.
//      b=-1 0   1
//
// Places and heights are kept about a reference beam and a plane through the lamp that meet the terrain in its
// middle, so that a lamp a million cells away costs no digits: any beam and any plane through the lamp will do.

#include <duskline/casting/beam_strips.h>
#include <duskline/casting/lamp_march.h>
#include <duskline/terrain/height_field.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace duskline {

/// Beams stand this much closer than samples, so that rounding never puts two into a unit.
inline constexpr double kBeamSpare = 1.001;

/// A quarter of the grid: the lines beyond a lamp, nearest first.
struct LampWedge {
    bool lines_are_rows;
    std::ptrdiff_t first_index; // of the first line, among rows or columns
    std::ptrdiff_t direction;   // 1 when indices rise away from the lamp, else -1
    std::ptrdiff_t index_count; // rows or columns of the grid
    LightOrder<const float> heights;
    double lamp_index;
    double lamp_cell;

    // Beams and heights about a reference in the middle of the wedge.
    double reference_line = 0.0;
    double reference_cell = 0.0;
    double lean = 0.0; // cells sideways per line
    double reference_m = 0.0;
    double climb_m = 0.0; // of the plane, per line

    // b of the outermost beams
    double lowest_b = 0.0;
    double highest_b = 0.0;

    std::ptrdiff_t index_of(std::ptrdiff_t line) const { return first_index + direction * line; }
    double distance(std::ptrdiff_t line) const
    {
        return std::abs(static_cast<double>(index_of(line)) - lamp_index);
    }
    double centre(double line) const { return reference_cell + lean * (line - reference_line); }
    double plane_m(double line) const { return reference_m + climb_m * (line - reference_line); }

    /// A sample over the plane, or NaN; the line before the first one counts too.
    double over_m(std::ptrdiff_t line, std::ptrdiff_t cell) const
    {
        const std::ptrdiff_t index = index_of(line);
        if (index < 0 || index >= index_count || cell < 0
            || cell >= static_cast<std::ptrdiff_t>(heights.cells))
            return std::numeric_limits<double>::quiet_NaN();
        return heights.first[line * heights.line_step + cell * heights.cell_step]
               - plane_m(static_cast<double>(line));
    }

    /// Whether the march, too, counts lines this way from a cell to the lamp.
    bool owns(std::ptrdiff_t line, std::ptrdiff_t cell) const
    {
        const double lines = lamp_index - static_cast<double>(index_of(line));
        const double cells = lamp_cell - static_cast<double>(cell);
        return lines_are_rows ? counting_towards(lines, cells).lines_are_rows
                              : !counting_towards(cells, lines).lines_are_rows;
    }

    /// The cells of a line that it owns: neighbours all.
    CellRange own_cells(std::ptrdiff_t line) const;
};

/// Neighbouring units of a wedge: [first, last), where `beams` are from b = 0 to 1.
struct LampStrip {
    double beams;
    std::int64_t first;
    std::int64_t last;
    bool is_first;
    bool is_last;
};

/// The lines on one side of the lamp; none when no cell is theirs.
LampWedge wedge_of(const HeightField& field, const GridPoint& lamp, bool lines_are_rows, bool rising);

/// The strips of a wedge, as many as its longest line asks for.
std::vector<LampStrip> strips_of(const LampWedge& wedge);

} // namespace duskline
