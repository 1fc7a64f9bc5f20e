#pragma once

// The surface that every ray meets: straight from sample to sample along the lines of the grid, and seen from the
// ray, with lines and cells counted towards the light. Not installed.

#include <duskline/terrain/height_field.h>

#include <cmath>
#include <cstddef>
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

/// One of the eight ways to count a grid: whether lines are rows or columns, and which numbers run against the
/// grid's own.
struct Counting {
    bool lines_are_rows = true;
    bool lines_turned = false;
    bool cells_turned = false;
};

/// The surface of a terrain, its samples counted in one of the eight ways.
class GridLineSurface {
public:
    GridLineSurface(const HeightField& field, const Counting& counting) : counting_(counting)
    {
        const bool rows = counting.lines_are_rows;
        const auto stride = static_cast<std::ptrdiff_t>(field.heights_m.row_stride());
        const std::ptrdiff_t line_step = rows ? stride : 1;
        const std::ptrdiff_t cell_step = rows ? 1 : stride;
        last_line_ = static_cast<std::int64_t>(rows ? field.rows() : field.columns()) - 1;
        last_cell_ = static_cast<std::int64_t>(rows ? field.columns() : field.rows()) - 1;
        line_step_ = counting.lines_turned ? -line_step : line_step;
        cell_step_ = counting.cells_turned ? -cell_step : cell_step;
        first_ = field.heights_m.data();
        if (!field.heights_m.empty())
            first_ += (counting.lines_turned ? last_line_ * line_step : 0)
                      + (counting.cells_turned ? last_cell_ * cell_step : 0);
    }

    const Counting& counting() const { return counting_; }
    std::int64_t last_line() const { return last_line_; }
    std::int64_t last_cell() const { return last_cell_; }

    RayStart start_at(std::size_t row, std::size_t column) const
    {
        const auto line = static_cast<std::int64_t>(counting_.lines_are_rows ? row : column);
        const auto cell = static_cast<std::int64_t>(counting_.lines_are_rows ? column : row);
        return {counting_.lines_turned ? last_line_ - line : line,
                counting_.cells_turned ? last_cell_ - cell : cell, 0.0, 0.0};
    }

    /// Any place whose coordinates have whole parts that fit.
    RayStart start_at(double row, double column) const
    {
        const auto [line, line_part] =
            split(counting_.lines_are_rows ? row : column, counting_.lines_turned, last_line_);
        const auto [cell, cell_part] =
            split(counting_.lines_are_rows ? column : row, counting_.cells_turned, last_cell_);
        return {line, cell, line_part, cell_part};
    }

    /// The surface on a line, a share `t` of the way from a cell to the next.
    double on_line_m(std::int64_t line, std::int64_t cell, double t) const
    {
        if (cell < 0 || cell >= last_cell_)
            return between(sample(line, cell), sample(line, cell + 1), t);
        const float* nearer = first_ + line * line_step_ + cell * cell_step_;
        return between(nearer[0], nearer[cell_step_], t);
    }

    /// The same on the line through all cells of that number, from a line to the next.
    double on_cell_m(std::int64_t line, std::int64_t cell, double t) const
    {
        if (line < 0 || line >= last_line_)
            return between(sample(line, cell), sample(line + 1, cell), t);
        const float* nearer = first_ + line * line_step_ + cell * cell_step_;
        return between(nearer[0], nearer[line_step_], t);
    }

private:
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

    Counting counting_;
    const float* first_ = nullptr;
    std::ptrdiff_t line_step_ = 0;
    std::ptrdiff_t cell_step_ = 0;
    std::int64_t last_line_ = 0;
    std::int64_t last_cell_ = 0;
};

} // namespace duskline
