#pragma once

#include <duskline/light/directional_light.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <type_traits>

namespace duskline {

/// A directional light in the steps of a grid. Light is followed from *line* to line: lines are rows when
/// it travels more along columns than along rows, else columns, so that it moves at most one cell sideways
/// per line.
///
///        line 0   o---o---o---o---o      the line nearest the light
///                      \                 u = u0 + lateral * v
///        line 1   o---o-\-o---o---o      height falls by drop_m per line
///                        \             .
///        line 2   o---o---o---o---o
///
/// Whichever way the light comes from, v counts lines away from the light and u counts cells along a line
/// in the grid's own order (columns eastwards or rows southwards). A terrain and light turned together by
/// quarter turns get the same lines in the same order.
struct LightFrame {
    bool lines_are_rows = true;
    bool first_line_is_index_0 = true; ///< else the light comes from the last row or column
    double lateral = 0.0;              ///< cells along the line per line away from the light, in [-1, 1]
    double drop_m = 1.0;               ///< fall of the light per line, metres; above 0
};

/// The frame of a light between the horizon and straight overhead (see `uniform_answer` for the others).
/// Light within a millionth of a cell per line (0.00006 degrees) of an axis of the grid counts as along it, or
/// the outermost line of cells would lose its shadow to a rounding error of the azimuth.
LightFrame light_frame(const DirectionalLight& light, CellSize cell_size_m);

/// A grid seen in the order of a light frame: `lines` lines of `cells` cells, with the signed distance in
/// values from one line and one cell to the next. `at(v, u)` is cell u of the v-th line from the light.
template <typename T>
struct LightOrder {
    T* first = nullptr;
    std::ptrdiff_t line_step = 0;
    std::ptrdiff_t cell_step = 0;
    std::size_t lines = 0;
    std::size_t cells = 0;

    /// Lines [first_line, first_line + line_count).
    LightOrder part(std::size_t first_line, std::size_t line_count) const
    {
        LightOrder some = *this;
        some.first += static_cast<std::ptrdiff_t>(first_line) * line_step;
        some.lines = line_count;
        return some;
    }

    /// A writable order serves wherever a read-only one is wanted.
    operator LightOrder<const T>() const requires(!std::is_const_v<T>)
    {
        return {first, line_step, cell_step, lines, cells};
    }

    T& at(std::size_t v, std::size_t u) const
    {
        return first[static_cast<std::ptrdiff_t>(v) * line_step + static_cast<std::ptrdiff_t>(u) * cell_step];
    }
};

template <typename T>
LightOrder<T> in_light_order(GridView<T> grid, const LightFrame& frame)
{
    LightOrder<T> order;
    const auto stride = static_cast<std::ptrdiff_t>(grid.row_stride());
    order.lines = frame.lines_are_rows ? grid.rows() : grid.columns();
    order.cells = frame.lines_are_rows ? grid.columns() : grid.rows();
    order.line_step = frame.lines_are_rows ? stride : 1;
    order.cell_step = frame.lines_are_rows ? 1 : stride;
    order.first = grid.data();
    if (!frame.first_line_is_index_0 && order.lines > 0) {
        order.first += static_cast<std::ptrdiff_t>(order.lines - 1) * order.line_step;
        order.line_step = -order.line_step;
    }
    return order;
}

} // namespace duskline
