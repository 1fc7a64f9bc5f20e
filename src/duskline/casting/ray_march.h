#pragma once

// What the plain ray and the fast ray share: where a ray crosses the lines of the grid, and how high the
// surface lies there. Not installed; the public face is ray.h.
//
// Lines and cells are those of the light frame (light_frame.h), but counted *towards* the light here, both of
// them: from a start a ray moves on by one line and `slope` cells, 0 to 1, at a time, and climbs drop_m.
//
//           o-----o-----o--x--o   line 2           x: crossings with lines
//           |     |     | /   |                    +: crossings with the lines between cells of equal number
//           |     |     +     |
//           o-----o----x|-----o   line 1
//           |     |   / |     |
//           |     |  /  |     |
//           o-----o-P---o-----o   line 0, the start P on it not counted
//        cell 0   1     2     3
//
// Every crossing is computed from the start and its own number, so that no error adds up along the ray, and
// whoever leaves crossings out finds the same bits at the others. Distances are measured from the start's own
// cell: moving terrain and start together changes nothing. Counting towards the light makes turned and
// mirrored terrains the same terrain.

#include <duskline/casting/light_frame.h>
#include <duskline/terrain/height_field.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace duskline {

/// Lower than any surface: there is nothing. And higher than any.
inline constexpr double kNothing = -std::numeric_limits<double>::infinity();
inline constexpr double kNeverEnough = std::numeric_limits<double>::infinity();

/// Cells by which rounding may move a crossing, generously. A ray this close to a sample counts as on it
/// where the next one is missing: a light a millionth of a degree off the axis must not leave the outermost
/// row of cells, or the one beside a hole, without shadow.
inline constexpr double kSlack_cells = 1e-6;

/// Where a ray starts: the cell at or before it, and the fraction of the way to the next, in [0, 1).
struct RayStart {
    std::int64_t line = 0;
    std::int64_t cell = 0;
    double line_part = 0.0;
    double cell_part = 0.0;
};

/// The rays of one light over one terrain of at least one cell.
class RayMarch {
public:
    RayMarch(const HeightField& field, const DirectionalLight& light, HeightRange total)
        : RayMarch(field, light_frame(light, field.cell_size_m), total)
    {}

    std::int64_t last_line() const { return last_line_; }
    std::int64_t last_cell() const { return last_cell_; }
    /// Whether lines are rows, and which numbers run against the grid's own.
    bool lines_are_rows() const { return lines_are_rows_; }
    bool lines_turned() const { return lines_turned_; }
    bool cells_turned() const { return cells_turned_; }

    RayStart start_at(std::size_t row, std::size_t column) const
    {
        const auto line = static_cast<std::int64_t>(lines_are_rows_ ? row : column);
        const auto cell = static_cast<std::int64_t>(lines_are_rows_ ? column : row);
        return {lines_turned_ ? last_line_ - line : line, cells_turned_ ? last_cell_ - cell : cell, 0.0, 0.0};
    }

    /// Any place whose coordinates have whole parts that fit.
    RayStart start_at(double row, double column) const
    {
        const auto [line, line_part] = split(lines_are_rows_ ? row : column, lines_turned_, last_line_);
        const auto [cell, cell_part] = split(lines_are_rows_ ? column : row, cells_turned_, last_cell_);
        return {line, cell, line_part, cell_part};
    }

    /// A start moved along its ray by a whole number of lines, and the climb of the ray until there.
    struct Entry {
        RayStart start;
        double drop_m;
    };

    /// A start from which the grid's lines are not far away: the start itself, or, for one before the first
    /// line, where its ray comes to within a line of that. Distances from there are small enough to count.
    Entry entry(const RayStart& start) const
    {
        if (start.line >= -1)
            return {start, 0.0};
        const std::int64_t lines = -1 - start.line;
        const auto ahead = static_cast<double>(lines);
        const double cells = start.cell_part + slope_ * ahead;
        const double whole = std::floor(cells);
        return {{start.line + lines, start.cell + static_cast<std::int64_t>(whole), start.line_part,
                 cells - whole},
                drop_m_ * ahead};
    }

    /// Lines from the start to a line; below 0 for one behind it.
    double distance_to(const RayStart& start, std::int64_t line) const
    {
        return static_cast<double>(line - start.line) - start.line_part;
    }

    /// The cell at or before the ray after `distance` lines.
    std::int64_t cell_after(const RayStart& start, double distance) const
    {
        return start.cell + static_cast<std::int64_t>(start.cell_part + slope_ * distance);
    }

    /// How high the shadow of the surface where it crosses `line` lies over the start.
    double shadow_of_line_m(const RayStart& start, std::int64_t line) const
    {
        const double distance = distance_to(start, line);
        const double cells = start.cell_part + slope_ * distance;
        const auto whole = static_cast<std::int64_t>(cells);
        return surface_on_line_m(line, start.cell + whole, cells - static_cast<double>(whole))
               - drop_m_ * distance;
    }

    /// The same for the line through all cells numbered `cell`; the slope must not be 0.
    double shadow_of_cell_m(const RayStart& start, std::int64_t cell) const
    {
        const double distance = (static_cast<double>(cell - start.cell) - start.cell_part) / slope_;
        const double lines = std::min(start.line_part + distance, kFarAway);
        const auto whole = static_cast<std::int64_t>(lines);
        return surface_on_cell_m(start.line + whole, cell, lines - static_cast<double>(whole))
               - drop_m_ * distance;
    }

    /// No ground up to `highest_m` can cast a higher shadow than this from a crossing `distance` lines or
    /// more away, rounding included: of the crossing's place, and of the surface between two samples.
    double bound_m(double highest_m, double distance) const
    {
        return highest_m + margin_m_ - drop_m_ * (std::max(distance, 0.0) - kSlack_cells);
    }

    /// The height under which a point over the start is in shadow, when that is above `at_least_m`, and else
    /// `at_least_m`; any height above `enough_m` will do for one that is.
    double shadow_height_m(const RayStart& start, double at_least_m, double enough_m) const
    {
        double shadow_m = at_least_m;
        std::int64_t cell = std::max<std::int64_t>(start.cell, -1);
        for (std::int64_t line = std::max<std::int64_t>(start.line, -1) + 1; line <= last_line_; ++line) {
            cross(start, line, cell, shadow_m);
            if (shadow_m > enough_m || cell > last_cell_
                || bound_m(highest_m_, distance_to(start, line)) <= shadow_m)
                return shadow_m;
        }
        return last_raised(start, cell, shadow_m);
    }

    /// Raises `shadow_m` by the crossings up to and on `line`, when those up to the line before and up to
    /// `cell` have been; `cell` moves on.
    void cross(const RayStart& start, std::int64_t line, std::int64_t& cell, double& shadow_m) const
    {
        const std::int64_t reached = std::min(cell_after(start, distance_to(start, line)), last_cell_ + 1);
        for (; cell < reached; ++cell)
            if (cell < last_cell_)
                shadow_m = std::max(shadow_m, shadow_of_cell_m(start, cell + 1));
        shadow_m = std::max(shadow_m, shadow_of_line_m(start, line));
    }

    /// After the last line: a crossing at its very end that rounding put behind it.
    double last_raised(const RayStart& start, std::int64_t cell, double shadow_m) const
    {
        return slope_ > 0.0 && cell < last_cell_ ? std::max(shadow_m, shadow_of_cell_m(start, cell + 1))
                                                 : shadow_m;
    }

private:
    RayMarch(const HeightField& field, const LightFrame& frame, HeightRange total)
        : lines_are_rows_(frame.lines_are_rows), lines_turned_(frame.first_line_is_index_0),
          cells_turned_(frame.lateral > 0.0), slope_(std::abs(frame.lateral)), drop_m_(frame.drop_m),
          highest_m_(total.highest_m),
          margin_m_(kSlack_cells * (static_cast<double>(total.highest_m) - total.lowest_m))
    {
        const auto order = in_light_order(field.heights_m, frame);
        last_line_ = static_cast<std::int64_t>(order.lines) - 1;
        last_cell_ = static_cast<std::int64_t>(order.cells) - 1;
        line_step_ = -order.line_step;
        cell_step_ = cells_turned_ ? -order.cell_step : order.cell_step;
        first_ = order.first;
        if (!field.heights_m.empty())
            first_ += last_line_ * order.line_step + (cells_turned_ ? last_cell_ * order.cell_step : 0);
    }

    struct Split {
        std::int64_t whole;
        double part;
    };

    // The fraction stays exact, whichever way the cells are counted.
    static Split split(double coordinate, bool turned, std::int64_t last)
    {
        const double whole = turned ? std::ceil(coordinate) : std::floor(coordinate);
        const auto cell = static_cast<std::int64_t>(whole);
        return {turned ? last - cell : cell, std::abs(coordinate - whole)};
    }

    // The surface a share `t` of the way from one sample to the next. A missing sample hides what is between.
    static double between(float a, float b, double t)
    {
        const double height_m = a + (static_cast<double>(b) - a) * t;
        return std::isnan(height_m) ? beside_hole(a, b, t) : height_m;
    }

    static double beside_hole(float a, float b, double t)
    {
        if (t <= kSlack_cells && !std::isnan(a))
            return a;
        if (t >= 1.0 - kSlack_cells && !std::isnan(b))
            return b;
        return kNothing;
    }

    // Beyond the border nothing is known.
    float sample(std::int64_t line, std::int64_t cell) const
    {
        if (line < 0 || line > last_line_ || cell < 0 || cell > last_cell_)
            return std::numeric_limits<float>::quiet_NaN();
        return first_[line * line_step_ + cell * cell_step_];
    }

    double surface_on_line_m(std::int64_t line, std::int64_t cell, double t) const
    {
        if (cell < 0 || cell >= last_cell_)
            return between(sample(line, cell), sample(line, cell + 1), t);
        const float* nearer = first_ + line * line_step_ + cell * cell_step_;
        return between(nearer[0], nearer[cell_step_], t);
    }

    double surface_on_cell_m(std::int64_t line, std::int64_t cell, double t) const
    {
        if (line < 0 || line >= last_line_)
            return between(sample(line, cell), sample(line + 1, cell), t);
        const float* nearer = first_ + line * line_step_ + cell * cell_step_;
        return between(nearer[0], nearer[line_step_], t);
    }

    // Lines beyond any grid, and still a number that can be counted.
    static constexpr double kFarAway = 4e18;

    bool lines_are_rows_;
    bool lines_turned_;
    bool cells_turned_;
    double slope_;
    double drop_m_;
    double highest_m_;
    double margin_m_;
    const float* first_ = nullptr;
    std::ptrdiff_t line_step_ = 0;
    std::ptrdiff_t cell_step_ = 0;
    std::int64_t last_line_ = 0;
    std::int64_t last_cell_ = 0;
};

} // namespace duskline
