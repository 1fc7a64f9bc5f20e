// The ground between samples, on a finer grid.
//
//      a---------b      The cell nearest to a finer cell's centre x is s; of the four samples around x those
//      |   x     |      that are missing take its value. Then the value is bilinear between them:
//      |         |      first along both rows, then between those.
//      s---------d

#include <duskline/execution/for_rows.h>
#include <duskline/terrain/refined.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 16;

float value_or(float value, float other)
{
    return std::isnan(value) ? other : value;
}

float between(float a, float b, float t)
{
    return a + (b - a) * t;
}

float value_at(GridView<const float> values, const FinerPlace& down, const FinerPlace& across)
{
    const float own = values(down.nearest, across.nearest);
    if (std::isnan(own))
        return own;
    const auto sample = [&](std::size_t row, std::size_t column) {
        return value_or(values(row, column), own);
    };
    const float upper =
        between(sample(down.before, across.before), sample(down.before, across.after), across.t);
    const float lower =
        between(sample(down.after, across.before), sample(down.after, across.after), across.t);
    return between(upper, lower, down.t);
}

void require_finer(const char* what, std::size_t wanted, std::size_t least)
{
    if (wanted < least)
        throw InvalidInput(std::string("a finer grid must have at least ") + std::to_string(least) + " "
                           + what + ", got " + std::to_string(wanted));
}

} // namespace

FinerPlace finer_place(std::size_t finer_cell, std::size_t finer_cells, std::size_t cells)
{
    assert(finer_cell < finer_cells && cells > 0);
    // Whole numbers, counted from the border in cells over this denominator: nothing is rounded twice.
    const std::size_t denominator = 2 * finer_cells;
    const std::size_t numerator = (2 * finer_cell + 1) * cells;
    const double place = static_cast<double>(numerator) / static_cast<double>(denominator) - 0.5;
    if (numerator < finer_cells)
        return {place, 0, 0, 0, 0.0f};
    const std::size_t before = (numerator - finer_cells) / denominator;
    if (before + 1 >= cells)
        return {place, cells - 1, cells - 1, cells - 1, 0.0f};
    const auto rest = static_cast<double>((numerator - finer_cells) % denominator);
    const auto t = static_cast<float>(rest / static_cast<double>(denominator));
    return {place, before, before + 1, t > 0.5f ? before + 1 : before, t};
}

std::vector<FinerPlace> finer_places(std::size_t finer_cells, std::size_t cells)
{
    std::vector<FinerPlace> places(finer_cells);
    for (std::size_t cell = 0; cell < finer_cells; ++cell)
        places[cell] = finer_place(cell, finer_cells, cells);
    return places;
}

Grid<float> refined(GridView<const float> values, std::size_t rows, std::size_t columns,
                    const Execution& execution)
{
    require_finer("rows", rows, values.rows());
    require_finer("columns", columns, values.columns());
    if (values.empty())
        return Grid<float>(rows, columns, std::numeric_limits<float>::quiet_NaN());
    const std::vector<FinerPlace> across = finer_places(columns, values.columns());
    Grid<float> result(rows, columns);
    for_rows(rows, kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y) {
            const FinerPlace down = finer_place(y, rows, values.rows());
            const auto out = result.row(y);
            for (std::size_t x = 0; x < columns; ++x)
                out[x] = value_at(values, down, across[x]);
        }
    });
    return result;
}

Terrain refined(const HeightField& field, std::size_t rows, std::size_t columns, const Execution& execution)
{
    require_valid(field);
    const auto share = [](std::size_t cells, std::size_t finer_cells) {
        return finer_cells == 0 ? 1.0 : static_cast<double>(cells) / static_cast<double>(finer_cells);
    };
    return {refined(field.heights_m, rows, columns, execution),
            {field.cell_size_m.x * share(field.columns(), columns),
             field.cell_size_m.y * share(field.rows(), rows)}};
}

NormalField refined(const NormalField& normals, std::size_t rows, std::size_t columns,
                    const Execution& execution)
{
    const Execution quiet{.threads = execution.threads};
    NormalField result = {refined(normals.east.view(), rows, columns, quiet),
                          refined(normals.north.view(), rows, columns, quiet),
                          refined(normals.up.view(), rows, columns, quiet)};
    for_rows(rows, kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                float& east = result.east(y, x);
                float& north = result.north(y, x);
                float& up = result.up(y, x);
                const float scale = 1.0f / std::sqrt(east * east + north * north + up * up);
                east *= scale;
                north *= scale;
                up *= scale;
            }
    });
    return result;
}

} // namespace duskline
