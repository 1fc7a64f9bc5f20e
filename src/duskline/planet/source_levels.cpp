#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/source_levels.h>
#include <duskline/terrain/halved_grid.h>
#include <duskline/view/level_of_detail.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace duskline {

namespace {

constexpr std::size_t kRoughnessCells = 8;

// Files round the numbers of their borders.
constexpr double kBorderTolerance_cells = 0.1;

// Weights of the four cells around a place, a share t from the second to the third.
std::array<double, 4> cubic_weights(double t)
{
    return {t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (1.5 * t - 2.5), t * (0.5 + t * (2.0 - 1.5 * t)),
            t * t * (0.5 * t - 0.5)};
}

std::size_t half_of(std::size_t count)
{
    return (count + 1) / 2;
}

bool has_holes(const Grid<float>& grid)
{
    return std::ranges::any_of(grid.values(), [](float value) { return std::isnan(value); });
}

float smooth_step(float t)
{
    return t * t * (3.0f - 2.0f * t);
}

std::string degrees_words(Angle angle)
{
    return std::to_string(angle.degrees());
}

} // namespace

void require_valid(const PlanetSource& source)
{
    const double width = source.cell_width.degrees();
    const double height = source.cell_height.degrees();
    if (source.heights_m.empty())
        throw InvalidInput("a source of heights for a planet needs at least one cell");
    if (!(width > 0.0 && std::isfinite(width) && height > 0.0 && std::isfinite(height)))
        throw InvalidInput("cells of a planet's source must be above 0 degrees, got "
                           + degrees_words(source.cell_width) + " x " + degrees_words(source.cell_height));
    const double south = source.north.degrees() - static_cast<double>(source.heights_m.rows()) * height;
    const double slack = kBorderTolerance_cells * height;
    if (!(source.north.degrees() <= 90.0 + slack && south >= -90.0 - slack))
        throw InvalidInput("a planet's source must lie between latitudes -90 and 90 degrees, got "
                           + std::to_string(south) + " to " + degrees_words(source.north));
    const double round = static_cast<double>(source.heights_m.columns()) * width;
    if (!(std::isfinite(source.west.degrees()) && round <= 360.0 + kBorderTolerance_cells * width))
        throw InvalidInput("a planet's source must reach at most 360 degrees eastwards, got "
                           + std::to_string(round) + " from " + degrees_words(source.west));
}

SourceLevels::SourceLevels(PlanetSource source, const Options& options, const Execution& execution)
    : west_(source.west), north_(source.north), cell_width_(source.cell_width),
      cell_height_(source.cell_height)
{
    require_valid(source);
    const auto rows = static_cast<double>(source.heights_m.rows());
    const auto columns = static_cast<double>(source.heights_m.columns());
    goes_round_ = columns * cell_width_.degrees() > 360.0 - cell_width_.degrees() / 2.0;
    reaches_poles_ = goes_round_ && rows * cell_height_.degrees() > 180.0 - cell_height_.degrees() / 2.0;
    heights_m_.push_back(std::move(source.heights_m));
    for (const float height_m : heights_m_[0].values())
        range_.include(height_m);
    measure_weights(options.border_cells);
    measure_roughness(options.sea);
    add_coarser_levels();
    measure_relief(options.sea);
    for_rows(levels(), 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t level = first; level < last; ++level)
            if (has_holes(heights_m_[level]))
                heights_m_[level] = with_holes_filled({heights_m_[level].view(), {}});
    });
}

// Steps (kings' moves) to the nearest cell without data, or beyond the border, in two passes.
void SourceLevels::measure_weights(std::size_t border_cells)
{
    const Grid<float>& heights_m = heights_m_[0];
    if (reaches_poles_ && !has_holes(heights_m))
        return;
    const auto rows = static_cast<std::ptrdiff_t>(heights_m.rows());
    const auto columns = static_cast<std::ptrdiff_t>(heights_m.columns());
    const auto full = static_cast<float>(border_cells + 1);
    Grid<float> steps(heights_m.rows(), heights_m.columns());
    std::ranges::transform(heights_m.values(), steps.values().begin(),
                           [&](float height_m) { return std::isnan(height_m) ? 0.0f : full; });
    const auto steps_at = [&](std::ptrdiff_t row, std::ptrdiff_t column) {
        if (row < 0 || row >= rows)
            return reaches_poles_ ? full : 0.0f;
        if (goes_round_)
            column = (column + columns) % columns;
        if (column < 0 || column >= columns)
            return 0.0f;
        return steps(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    };
    const auto visit = [&](std::ptrdiff_t row, std::ptrdiff_t column, std::ptrdiff_t back) {
        float& here = steps(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
        for (std::ptrdiff_t aside = -1; aside <= 1; ++aside)
            here = std::min(here, steps_at(row + back, column + aside) + 1.0f);
        here = std::min(here, steps_at(row, column + back) + 1.0f);
    };
    for (std::ptrdiff_t row = 0; row < rows; ++row)
        for (std::ptrdiff_t column = 0; column < columns; ++column)
            visit(row, column, -1);
    for (std::ptrdiff_t row = rows; row-- > 0;)
        for (std::ptrdiff_t column = columns; column-- > 0;)
            visit(row, column, 1);
    for (float& value : steps.values())
        value = smooth_step(std::min(1.0f, value / full));
    weights_.push_back(std::move(steps));
}

// The root mean square, over blocks of cells, of a cell's height less the mean of the four around it.
void SourceLevels::measure_roughness(bool sea)
{
    const Grid<float>& heights_m = heights_m_[0];
    const auto ground_m = [&](std::size_t row, std::size_t column) {
        return sea ? std::max(0.0f, heights_m(row, column)) : heights_m(row, column);
    };
    roughness_m_ = Grid<float>((heights_m.rows() - 1) / kRoughnessCells + 1,
                               (heights_m.columns() - 1) / kRoughnessCells + 1, 0.0f);
    Grid<float> counts(roughness_m_.rows(), roughness_m_.columns(), 0.0f);
    for (std::size_t row = 1; row + 1 < heights_m.rows(); ++row)
        for (std::size_t column = 1; column + 1 < heights_m.columns(); ++column) {
            const float around_m = (ground_m(row - 1, column) + ground_m(row + 1, column)
                                    + ground_m(row, column - 1) + ground_m(row, column + 1))
                                   / 4.0f;
            const float off_m = ground_m(row, column) - around_m;
            if (std::isnan(off_m))
                continue;
            roughness_m_(row / kRoughnessCells, column / kRoughnessCells) += off_m * off_m;
            counts(row / kRoughnessCells, column / kRoughnessCells) += 1.0f;
        }
    std::ranges::transform(
        roughness_m_.values(), counts.values(), roughness_m_.values().begin(),
        [](float sum, float count) { return count > 0.0f ? std::sqrt(sum / count) : 0.0f; });
}

// Up to blocks that hold all; round the globe only as long as blocks close the ring.
void SourceLevels::add_coarser_levels()
{
    while (heights_m_.back().rows() > 1 && heights_m_.back().columns() > 1
           && !(goes_round_ && heights_m_.back().columns() % 2 == 1)) {
        heights_m_.push_back(halved(heights_m_.back().view()));
        if (!weights_.empty())
            weights_.push_back(halved(weights_.back().view()));
    }
}

namespace {

// The ranges of blocks of two by two.
Grid<HeightRange> joined(const Grid<HeightRange>& fine)
{
    Grid<HeightRange> coarse(half_of(fine.rows()), half_of(fine.columns()), HeightRange());
    for (std::size_t row = 0; row < fine.rows(); ++row)
        for (std::size_t column = 0; column < fine.columns(); ++column)
            coarse(row / 2, column / 2).include(fine(row, column));
    return coarse;
}

// The greatest difference of heights within two blocks of any block.
float steepest_m(const Grid<HeightRange>& blocks)
{
    float steepest_m = 0.0f;
    for (std::size_t row = 0; row < blocks.rows(); ++row)
        for (std::size_t column = 0; column < blocks.columns(); ++column) {
            HeightRange around;
            for (std::size_t y = row - std::min<std::size_t>(row, 2); y < std::min(row + 3, blocks.rows());
                 ++y)
                for (std::size_t x = column - std::min<std::size_t>(column, 2);
                     x < std::min(column + 3, blocks.columns()); ++x)
                    around.include(blocks(y, x));
            steepest_m = std::max(steepest_m, around.highest_m - around.lowest_m);
        }
    return steepest_m;
}

} // namespace

// A mean and the cells it is made of lie within the range of the blocks around, but for what cubics overshoot.
void SourceLevels::measure_relief(bool sea)
{
    Grid<HeightRange> ranges(heights_m_[0].rows(), heights_m_[0].columns(), HeightRange());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const float height_m = heights_m_[0].values()[i];
        ranges.values()[i].include(sea ? std::max(height_m, 0.0f) : height_m);
    }
    relief_below_m_.assign(levels(), 0.0f);
    for (std::size_t level = 1; level < levels(); ++level) {
        ranges = joined(ranges);
        relief_below_m_[level] = (1.0f + kCubicOvershoot) * steepest_m(ranges);
    }
}

float SourceLevels::greatest_roughness_m() const
{
    return std::ranges::max(roughness_m_.values());
}

std::size_t SourceLevels::level_of_spacing(double spacing_m, const Globe& globe) const
{
    std::size_t level = 0;
    for (double block_m = 2.0 * cell_m(globe); level + 1 < levels() && block_m <= spacing_m; block_m *= 2.0)
        ++level;
    return level;
}

// Counted from the centre of the first cell.
bool SourceLevels::find_cell(const LonLat& place, Cell& cell) const
{
    const auto rows = static_cast<double>(heights_m_[0].rows());
    const auto columns = static_cast<double>(heights_m_[0].columns());
    const double east_deg = wrapped_to_circle(place.longitude - west_).degrees();
    cell = {(north_ - place.latitude).degrees() / cell_height_.degrees() - 0.5,
            east_deg / cell_width_.degrees() - 0.5};
    const bool in_rows = reaches_poles_ || (cell.row >= -0.5 && cell.row <= rows - 0.5);
    return in_rows && (goes_round_ || cell.column <= columns - 0.5);
}

namespace {

// The same place among blocks of 2^level cells.
double among_blocks(double cell, std::size_t level)
{
    return (cell + 0.5) / static_cast<double>(std::size_t{1} << level) - 0.5;
}

// The four cells around a place, along rows or columns.
using Taps = std::array<std::size_t, 4>;

Taps clamped_taps(std::ptrdiff_t first, std::size_t count)
{
    Taps taps = {};
    for (std::ptrdiff_t i = 0; i < 4; ++i)
        taps[static_cast<std::size_t>(i)] = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(first + i, 0, static_cast<std::ptrdiff_t>(count) - 1));
    return taps;
}

// Round the globe; `first` lies between -count and 2 count.
Taps ring_taps(std::ptrdiff_t first, std::size_t count)
{
    const auto ring = static_cast<std::ptrdiff_t>(count);
    std::ptrdiff_t cell = first < 0 ? first + ring : first;
    Taps taps = {};
    for (std::size_t& tap : taps) {
        tap = static_cast<std::size_t>(cell % ring);
        cell = tap + 1 == count ? 0 : static_cast<std::ptrdiff_t>(tap) + 1;
    }
    return taps;
}

} // namespace

// The values around a place, as a function of row and column 0 to 3 of them. Over a pole rows go on on the other side.
template <typename Visit>
void SourceLevels::visit_around(const Grid<float>& grid, const Cell& cell, const Visit& visit) const
{
    const auto top = static_cast<std::ptrdiff_t>(std::floor(cell.row)) - 1;
    const auto left = static_cast<std::ptrdiff_t>(std::floor(cell.column)) - 1;
    const auto rows = static_cast<std::ptrdiff_t>(grid.rows());
    const Taps columns = goes_round_ ? ring_taps(left, grid.columns()) : clamped_taps(left, grid.columns());
    if (reaches_poles_ && (top < 0 || top + 3 >= rows)) {
        const Taps across = ring_taps(left + static_cast<std::ptrdiff_t>(grid.columns() / 2), grid.columns());
        for (std::ptrdiff_t i = 0; i < 4; ++i) {
            const std::ptrdiff_t row = top + i;
            const std::ptrdiff_t folded = row < 0 ? -1 - row : (row >= rows ? 2 * rows - 1 - row : row);
            const auto inside = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(folded, 0, rows - 1));
            visit(static_cast<std::size_t>(i), grid.row(inside).data(), folded == row ? columns : across);
        }
        return;
    }
    const Taps lines = clamped_taps(top, grid.rows());
    for (std::size_t i = 0; i < 4; ++i)
        visit(i, grid.row(lines[i]).data(), columns);
}

double SourceLevels::cubic(const Grid<float>& grid, const Cell& cell) const
{
    const auto down = cubic_weights(cell.row - std::floor(cell.row));
    const auto across = cubic_weights(cell.column - std::floor(cell.column));
    double sum = 0.0;
    visit_around(grid, cell, [&](std::size_t i, const float* row, const Taps& taps) {
        double row_sum = 0.0;
        for (std::size_t j = 0; j < 4; ++j)
            row_sum += across[j] * static_cast<double>(row[taps[j]]);
        sum += down[i] * row_sum;
    });
    return sum;
}

double SourceLevels::linear(const Grid<float>& grid, const Cell& cell) const
{
    const double down = cell.row - std::floor(cell.row);
    const double across = cell.column - std::floor(cell.column);
    const std::array<double, 4> weights = {0.0, 1.0 - down, down, 0.0};
    double sum = 0.0;
    visit_around(grid, cell, [&](std::size_t i, const float* row, const Taps& taps) {
        sum += weights[i]
               * ((1.0 - across) * static_cast<double>(row[taps[1]])
                  + across * static_cast<double>(row[taps[2]]));
    });
    return sum;
}

SourceSample SourceLevels::at(const LonLat& place, std::size_t level, bool with_roughness) const
{
    Cell cell = {};
    if (!find_cell(place, cell))
        return {};
    const Cell block = {among_blocks(cell.row, level), among_blocks(cell.column, level)};
    SourceSample sample;
    sample.weight = weights_.empty() ? 1.0 : linear(weights_[level], block);
    if (!(sample.weight > 0.0))
        return {};
    sample.height_m = cubic(heights_m_[level], block);
    if (!with_roughness)
        return sample;
    const auto rough = [](double at) { return (at + 0.5) / kRoughnessCells - 0.5; };
    sample.roughness_m = linear(roughness_m_, {rough(cell.row), rough(cell.column)});
    return sample;
}

} // namespace duskline
