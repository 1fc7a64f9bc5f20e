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

#include <duskline/casting/grid_line_surface.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_march.h>
#include <duskline/terrain/height_field.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace duskline {

/// The rays of one light over one terrain of at least one cell.
class RayMarch {
public:
    RayMarch(const HeightField& field, const DirectionalLight& light, HeightRange total)
        : RayMarch(field, light_frame(light, field.cell_size_m), total)
    {}

    const GridLineSurface& surface() const { return surface_; }
    std::int64_t last_line() const { return surface_.last_line(); }
    std::int64_t last_cell() const { return surface_.last_cell(); }
    bool cells_turned() const { return surface_.counting().cells_turned; }
    double highest_m() const { return highest_m_; }
    double slope() const { return slope_; }

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
        return surface_.on_line_m(line, start.cell + whole, cells - static_cast<double>(whole))
               - drop_m_ * distance;
    }

    /// The same for the line through all cells numbered `cell`; the slope must not be 0.
    double shadow_of_cell_m(const RayStart& start, std::int64_t cell) const
    {
        const double distance = (static_cast<double>(cell - start.cell) - start.cell_part) / slope_;
        const double lines = std::min(start.line_part + distance, kFarAway);
        const auto whole = static_cast<std::int64_t>(lines);
        return surface_.on_cell_m(start.line + whole, cell, lines - static_cast<double>(whole))
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
    double shadow_height_m(const RayStart& start, double at_least_m, double enough_m) const;

private:
    RayMarch(const HeightField& field, const LightFrame& frame, HeightRange total)
        : surface_(field, {frame.lines_are_rows, frame.first_line_is_index_0, frame.lateral > 0.0}),
          slope_(std::abs(frame.lateral)), drop_m_(frame.drop_m), highest_m_(total.highest_m),
          margin_m_(kSlack_cells * (static_cast<double>(total.highest_m) - total.lowest_m))
    {}

    // Lines beyond any grid, and still a number that can be counted.
    static constexpr double kFarAway = 4e18;

    GridLineSurface surface_;
    double slope_;
    double drop_m_;
    double highest_m_;
    double margin_m_;
};

/// A ray of parallel light, as the marches of shadow_march.h take it.
class ParallelRay {
public:
    ParallelRay(const RayMarch& march, const RayStart& start) : march_(march), start_(start) {}

    const GridLineSurface& surface() const { return march_.surface(); }
    double highest_m() const { return march_.highest_m(); }
    std::int64_t first_line() const { return std::max<std::int64_t>(start_.line, -1); }
    std::int64_t first_cell() const { return std::max<std::int64_t>(start_.cell, -1); }
    std::int64_t last_line() const { return march_.last_line(); }
    std::int64_t last_cell() const { return march_.last_cell(); }
    std::int64_t cell_at(std::int64_t line) const
    {
        return march_.cell_after(start_, march_.distance_to(start_, line));
    }
    double shadow_of_line_m(std::int64_t line) const { return march_.shadow_of_line_m(start_, line); }
    double shadow_of_cell_m(std::int64_t cell) const { return march_.shadow_of_cell_m(start_, cell); }
    double bound_m(double highest_m, std::int64_t from_line, std::int64_t) const
    {
        return march_.bound_m(highest_m, march_.distance_to(start_, from_line));
    }
    /// Beyond the last line there is nothing but a crossing at its very end that rounding put behind it.
    std::int64_t cells_after_last_line() const { return march_.slope() > 0.0 ? 1 : 0; }

private:
    const RayMarch& march_;
    RayStart start_;
};

inline double RayMarch::shadow_height_m(const RayStart& start, double at_least_m, double enough_m) const
{
    return duskline::shadow_height_m(ParallelRay(*this, start), at_least_m, enough_m);
}

} // namespace duskline
