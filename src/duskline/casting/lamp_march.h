#pragma once

// What a ray to a lamp crosses: the march of ray_march.h where every ray has a direction of its own, and an end.
// Not installed; the public face is ray.h.
//
//        height             lamp            A crossing of height S, `passed` lines from the start and `ahead` of
//          |              .*                the lamp, shades a point over the start that lies lower than
//          |      S   .'                       S - (lamp - S) passed / ahead
//          |      |.'
//          |   .'.|                         (similar triangles). Only crossings before the lamp count. A lamp on
//          |.'    |                         a line of the grid does not count as before itself.
//          P------+-----+
//           passed  ahead
//
// Lines and cells are counted towards the lamp, and lines are what the ray crosses more of: rows for cells above
// and below the lamp, columns for those beside it. As in the parallel march every crossing is computed from the
// start and its own number.

#include <duskline/casting/shadow_march.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/light/point_light.h>
#include <duskline/terrain/ground_height.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace duskline {

/// What the ground under a ray may be like.
struct GroundBounds {
    double highest_m;
    double margin_m; ///< more than rounding can raise the surface between two samples by
};

/// A lamp as a surface counts: how far lines and cells lie before it, exactly.
class LampPlace {
public:
    LampPlace(const GridLineSurface& surface, const GridPoint& lamp)
        : line_(surface.counting().lines_are_rows ? lamp.row : lamp.column, surface.counting().lines_turned,
                surface.last_line()),
          cell_(surface.counting().lines_are_rows ? lamp.column : lamp.row, surface.counting().cells_turned,
                surface.last_cell())
    {}

    /// From a line, or cell, on to the lamp; below 0 for one beyond it.
    double from_line(std::int64_t line) const { return line_.from(line); }
    double from_cell(std::int64_t cell) const { return cell_.from(cell); }
    /// The last one before the lamp.
    std::int64_t last_line_before() const { return line_.last_before(); }
    std::int64_t last_cell_before() const { return cell_.last_before(); }

private:
    struct Coordinate {
        Coordinate(double its_place, bool is_turned, std::int64_t its_last)
            : place(its_place), turned(is_turned), last(its_last)
        {}

        // In the grid's own numbers, so that nothing is rounded twice.
        double from(std::int64_t number) const
        {
            return turned ? static_cast<double>(last - number) - place : place - static_cast<double>(number);
        }
        std::int64_t last_before() const
        {
            return turned ? last - static_cast<std::int64_t>(std::floor(place)) - 1
                          : static_cast<std::int64_t>(std::ceil(place)) - 1;
        }

        double place;
        bool turned;
        std::int64_t last;
    };

    Coordinate line_;
    Coordinate cell_;
};

/// A ray from its start to a lamp, as the marches of shadow_march.h take it.
class LampRay {
public:
    /// The lamp is `lines` and `cells` ahead of the start, lines >= cells >= 0.
    LampRay(const GridLineSurface& surface, const RayStart& start, const LampPlace& lamp, double lines,
            double cells, double lamp_m, const GroundBounds& ground)
        : surface_(surface), start_(start), lamp_(lamp), slope_(lines > 0.0 ? cells / lines : 0.0),
          lamp_m_(lamp_m), ground_(ground),
          last_line_(std::min(lamp.last_line_before(), surface.last_line())),
          last_cell_(std::min(lamp.last_cell_before(), surface.last_cell()))
    {
        if (start.line < -1 && last_line_ >= 0)
            enter();
    }

    const GridLineSurface& surface() const { return surface_; }
    double highest_m() const { return ground_.highest_m; }
    std::int64_t first_line() const { return std::max<std::int64_t>(start_.line, -1); }
    std::int64_t first_cell() const { return std::max<std::int64_t>(start_.cell, -1); }
    std::int64_t last_line() const { return last_line_; }
    std::int64_t last_cell() const { return last_cell_; }
    std::int64_t cells_after_last_line() const { return slope_ > 0.0 ? 2 : 0; }

    std::int64_t cell_at(std::int64_t line) const
    {
        return start_.cell + static_cast<std::int64_t>(start_.cell_part + slope_ * distance_to(line));
    }

    double shadow_of_line_m(std::int64_t line) const
    {
        const double distance = distance_to(line);
        const double cells = start_.cell_part + slope_ * distance;
        const auto whole = static_cast<std::int64_t>(cells);
        return shadow_m(surface_.on_line_m(line, start_.cell + whole, cells - static_cast<double>(whole)),
                        lines_passed_ + distance, lamp_.from_line(line));
    }

    /// The slope must not be 0.
    double shadow_of_cell_m(std::int64_t cell) const
    {
        const double cells = static_cast<double>(cell - start_.cell) - start_.cell_part;
        const double lines = std::min(start_.line_part + cells / slope_, kFarAway);
        const auto whole = static_cast<std::int64_t>(lines);
        return shadow_m(surface_.on_cell_m(start_.line + whole, cell, lines - static_cast<double>(whole)),
                        cells_passed_ + cells, lamp_.from_cell(cell));
    }

    /// Over a lamp below `highest_m` it rises with the distance; else it falls.
    double bound_m(double highest_m, std::int64_t from_line, std::int64_t to_line) const
    {
        const double raised_m = highest_m + ground_.margin_m;
        const bool falls = lamp_m_ >= raised_m;
        const std::int64_t line = falls ? from_line : to_line;
        const double slack = falls ? -kSlack_cells : kSlack_cells;
        const double passed = std::max(lines_passed_ + distance_to(line) + slack, 0.0);
        const double ahead = lamp_.from_line(line) - slack;
        return ahead > 0.0 ? raised_m - (lamp_m_ - raised_m) * (passed / ahead) : kNeverEnough;
    }

private:
    double distance_to(std::int64_t line) const
    {
        return static_cast<double>(line - start_.line) - start_.line_part;
    }

    // How high the shadow of a crossing lies over the start.
    double shadow_m(double surface_m, double passed, double ahead) const
    {
        if (surface_m == kNothing || !(ahead > 0.0))
            return kNothing;
        return surface_m - (lamp_m_ - surface_m) * (passed / ahead);
    }

    // Moves a start far before the first line to within a line of that: distances from there are small enough to
    // count.
    void enter()
    {
        const std::int64_t lines = -1 - start_.line;
        const auto passed = static_cast<double>(lines);
        const double cells = start_.cell_part + slope_ * passed;
        const double whole = std::floor(cells);
        start_ = {start_.line + lines, start_.cell + static_cast<std::int64_t>(whole), start_.line_part,
                  cells - whole};
        lines_passed_ = passed;
        cells_passed_ = slope_ * passed;
    }

    // Lines beyond any grid, and still a number that can be counted.
    static constexpr double kFarAway = 4e18;

    const GridLineSurface& surface_;
    RayStart start_;
    LampPlace lamp_;
    double slope_;
    double lamp_m_;
    GroundBounds ground_;
    double lines_passed_ = 0.0; // before the start, by a ray that came from afar
    double cells_passed_ = 0.0;
    std::int64_t last_line_;
    std::int64_t last_cell_;
};

/// A lamp closer than this to a line of the grid is on it: map coordinates come with a rounding error.
inline constexpr double kLampSnap_cells = 1e-9;

/// Less than this under the ground is on it: so do heights that were interpolated by another formula.
inline constexpr double kLampSunk_m = 1e-6;

inline PointLight snapped(PointLight lamp)
{
    const auto snap = [](double place) {
        const double whole = std::round(place);
        return std::abs(place - whole) < kLampSnap_cells ? whole : place;
    };
    lamp.position.row = snap(lamp.position.row);
    lamp.position.column = snap(lamp.position.column);
    return lamp;
}

/// How a ray over so many rows and columns to a lamp is counted. On a diagonal either would do; taken in turn
/// around the compass, so that quarter turns agree.
inline Counting counting_towards(double rows, double columns)
{
    const bool lines_are_rows = std::abs(rows) > std::abs(columns)
                                || (std::abs(rows) == std::abs(columns) && (rows > 0.0) == (columns > 0.0));
    return lines_are_rows ? Counting{true, rows < 0.0, columns < 0.0}
                          : Counting{false, columns < 0.0, rows < 0.0};
}

/// The rays to one lamp over one terrain of at least one cell.
class LampMarch {
public:
    LampMarch(const HeightField& field, const PointLight& lamp, HeightRange total)
        : surfaces_{surface(field, 0), surface(field, 1), surface(field, 2), surface(field, 3),
                    surface(field, 4), surface(field, 5), surface(field, 6), surface(field, 7)},
          lamp_(snapped(lamp).position), ground_{total.highest_m, kSlack_cells
                                                                      * (static_cast<double>(total.highest_m)
                                                                         - total.lowest_m)}
    {}

    const GridPoint& lamp() const { return lamp_; }

    LampRay ray_from(std::size_t row, std::size_t column) const
    {
        const double rows = lamp_.row - static_cast<double>(row);
        const double columns = lamp_.column - static_cast<double>(column);
        const GridLineSurface& seen = surfaces_[index(counting_towards(rows, columns))];
        return ray(seen, seen.start_at(row, column), rows, columns);
    }

    LampRay ray_from(double row, double column) const
    {
        const double rows = lamp_.row - row;
        const double columns = lamp_.column - column;
        const GridLineSurface& seen = surfaces_[index(counting_towards(rows, columns))];
        return ray(seen, seen.start_at(row, column), rows, columns);
    }

private:
    static std::size_t index(const Counting& counting)
    {
        return (counting.lines_are_rows ? 4U : 0U) + (counting.lines_turned ? 2U : 0U)
               + (counting.cells_turned ? 1U : 0U);
    }
    static GridLineSurface surface(const HeightField& field, std::size_t index)
    {
        return {field, {(index & 4U) != 0, (index & 2U) != 0, (index & 1U) != 0}};
    }

    LampRay ray(const GridLineSurface& seen, const RayStart& start, double rows, double columns) const
    {
        const double lines = std::abs(seen.counting().lines_are_rows ? rows : columns);
        const double cells = std::abs(seen.counting().lines_are_rows ? columns : rows);
        return {seen, start, LampPlace(seen, lamp_), lines, cells, lamp_.height_m, ground_};
    }

    std::array<GridLineSurface, 8> surfaces_;
    GridPoint lamp_;
    GroundBounds ground_;
};

/// The one answer for all cells that some lamps give: `no` under the ground. Empty for every other.
inline std::optional<Lit> uniform_answer(const HeightField& field, const PointLight& light)
{
    const GridPoint lamp = snapped(light).position;
    const auto ground_m = ground_height_m(field, lamp.row, lamp.column);
    return ground_m && lamp.height_m < *ground_m - kLampSunk_m ? std::optional(Lit::no) : std::nullopt;
}

} // namespace duskline
