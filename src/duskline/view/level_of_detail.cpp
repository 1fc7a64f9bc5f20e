#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/halved_grid.h>
#include <duskline/view/level_of_detail.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>

namespace duskline {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A level begins to turn no sooner than at this share of its end, and takes at least a sixth of its way for it.
constexpr double kMorphBegins = 0.7;
constexpr double kLeastGrowth = 1.2;

constexpr double kQuantile = 0.99;
constexpr std::size_t kMostSamples = 100000;

std::size_t block_cells(std::size_t level)
{
    return kPatchSquares << level;
}

// Blocks of so many cells over so many samples; neighbours share the samples between them.
std::size_t block_count(std::size_t samples, std::size_t cells)
{
    return samples < 2 ? samples : (samples - 2) / cells + 1;
}

// What a corner that is left out is taken for: the middle between the two it lies between, along its row, its column
// or a diagonal of the square.
float left_out_error_m(const HeightField& field, std::size_t row, std::size_t column, std::size_t step)
{
    const std::size_t up = (row / step) % 2 == 1 ? step : 0;
    const std::size_t left = (column / step) % 2 == 1 ? step : 0;
    const float before_m = field.heights_m(row - up, column - left);
    const float after_m = field.heights_m(row + up, column + left);
    return std::abs(field.heights_m(row, column) - (before_m + after_m) / 2.0f);
}

// The error that 99 of 100 of the corners stay below that a level of this step has and the next lacks.
double step_error_m(const HeightField& field, std::size_t step)
{
    const std::size_t corners = (field.rows() / step) * (field.columns() / step);
    const auto stride = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::sqrt(static_cast<double>(corners) / kMostSamples)));
    std::vector<float> errors;
    for (std::size_t i = 0; (i + 1) * step < field.rows(); i += stride)
        for (std::size_t j = (i / stride) % 2; (j + 1) * step < field.columns(); j += stride) {
            const float error_m =
                i % 2 + j % 2 > 0 ? left_out_error_m(field, i * step, j * step, step) : 0.0f;
            if (!std::isnan(error_m))
                errors.push_back(error_m);
        }
    if (errors.empty())
        return 0.0;
    const auto quantile =
        errors.begin() + static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), quantile, errors.end());
    return static_cast<double>(*quantile);
}

bool has_data(HeightRange heights)
{
    return heights.lowest_m <= heights.highest_m;
}

} // namespace

LevelOfDetail::LevelOfDetail(const HeightField& field, const Execution& execution) : field_(field)
{
    require_valid(field);
    for (std::size_t level = 0; level == 0 || blocks_.back().size() > 1; ++level) {
        const std::size_t cells = block_cells(level);
        blocks_.emplace_back(std::max<std::size_t>(1, block_count(field.rows(), cells)),
                             std::max<std::size_t>(1, block_count(field.columns(), cells)), HeightRange());
    }
    measure_errors({.threads = execution.threads});
    for_rows(blocks_[0].rows(), 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < blocks_[0].columns(); ++column)
                measure_block(row, column);
    });
    for (std::size_t level = 1; level < levels(); ++level)
        for (std::size_t row = 0; row < blocks_[level].rows(); ++row)
            for (std::size_t column = 0; column < blocks_[level].columns(); ++column)
                measure_parent(level, row, column);
    find_diagonals();
}

// What a level is wrong by adds up from the steps to it.
void LevelOfDetail::measure_errors(const Execution& execution)
{
    error_m_.assign(levels(), 0.0);
    for_rows(levels() - 1, 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t step = first; step < last; ++step)
            error_m_[step + 1] = step_error_m(field_, std::size_t{1} << step);
    });
    std::partial_sum(error_m_.begin(), error_m_.end(), error_m_.begin());
}

void LevelOfDetail::measure_block(std::size_t block_row, std::size_t block_column)
{
    HeightRange range;
    const std::size_t first_column = block_column * kPatchSquares;
    const std::size_t last_row = std::min(block_row * kPatchSquares + kPatchSquares + 1, field_.rows());
    const std::size_t columns =
        std::min(kPatchSquares + 1, field_.columns() - std::min(first_column, field_.columns()));
    for (std::size_t row = block_row * kPatchSquares; row < last_row; ++row)
        for (const float height_m : field_.heights_m.row(row).subspan(first_column, columns))
            range.include(height_m);
    blocks_[0](block_row, block_column) = range;
}

void LevelOfDetail::measure_parent(std::size_t level, std::size_t block_row, std::size_t block_column)
{
    const Grid<HeightRange>& finer = blocks_[level - 1];
    HeightRange range;
    for (std::size_t row = 2 * block_row; row < std::min(2 * block_row + 2, finer.rows()); ++row)
        for (std::size_t column = 2 * block_column; column < std::min(2 * block_column + 2, finer.columns());
             ++column)
            range.include(finer(row, column));
    blocks_[level](block_row, block_column) = range;
}

void LevelOfDetail::find_diagonals()
{
    diagonal_m_.clear();
    for (std::size_t level = 0; level < levels(); ++level) {
        double rise_m = 0.0;
        for (const HeightRange& heights : blocks_[level].values())
            if (has_data(heights))
                rise_m = std::max(rise_m, static_cast<double>(heights.highest_m)
                                              - static_cast<double>(heights.lowest_m));
        const auto cells = static_cast<double>(block_cells(level));
        diagonal_m_.push_back(length({cells * field_.cell_size_m.x, cells * field_.cell_size_m.y, rise_m}));
    }
}

void LevelOfDetail::heights_changed(const CellRectangle& rectangle, const Execution& execution)
{
    if (rectangle.rows == 0 || rectangle.columns == 0)
        return;
    // A sample on the border of two blocks belongs to both.
    const auto first_block = [](std::size_t first) { return (first > 0 ? first - 1 : 0) / kPatchSquares; };
    std::size_t first_row = first_block(rectangle.first_row);
    std::size_t first_column = first_block(rectangle.first_column);
    std::size_t last_row = (rectangle.first_row + rectangle.rows - 1) / kPatchSquares;
    std::size_t last_column = (rectangle.first_column + rectangle.columns - 1) / kPatchSquares;
    for (std::size_t level = 0; level < levels(); ++level) {
        for (std::size_t row = first_row; row <= std::min(last_row, blocks_[level].rows() - 1); ++row)
            for (std::size_t column = first_column;
                 column <= std::min(last_column, blocks_[level].columns() - 1); ++column)
                level == 0 ? measure_block(row, column) : measure_parent(level, row, column);
        first_row /= 2;
        first_column /= 2;
        last_row /= 2;
        last_column /= 2;
    }
    find_diagonals();
    measure_errors(execution);
}

std::vector<MorphRange> LevelOfDetail::morph_ranges(double pixels_per_radian, double pixel_error) const
{
    std::vector<MorphRange> ranges;
    double finer_end_m = 0.0;
    for (std::size_t level = 0; level + 1 < levels(); ++level) {
        // Nothing that meets a finer level lies farther away than this, so nothing there has begun to turn.
        const double meets_finer_m = finer_end_m + diagonal_m_[level];
        const double wanted_m = error_m_[level + 1] * pixels_per_radian / pixel_error;
        const double end_m = std::max(wanted_m, kLeastGrowth * meets_finer_m);
        ranges.push_back({std::max(meets_finer_m, kMorphBegins * end_m), end_m});
        finer_end_m = end_m;
    }
    ranges.push_back({kInfinity, kInfinity});
    return ranges;
}

struct LevelOfDetail::Selection {
    const Vector3& eye_m;
    const Frustum& frustum;
    const std::vector<MorphRange>& ranges;
    std::vector<MeshPatch> patches;
};

std::vector<MeshPatch> LevelOfDetail::select(const Vector3& eye_m, const Frustum& frustum,
                                             const std::vector<MorphRange>& ranges) const
{
    Selection selection = {eye_m, frustum, ranges, {}};
    if (!field_.heights_m.empty())
        select_block({0, 0, static_cast<std::uint32_t>(levels() - 1)}, selection);
    return std::move(selection.patches);
}

namespace {

// The four blocks of the next finer level that a block is made of, whether or not they are in the grid.
std::array<MeshPatch, 4> quarters(const MeshPatch& block)
{
    const auto half = static_cast<std::uint32_t>(block_cells(block.level) / 2);
    const std::uint32_t level = block.level - 1;
    return {MeshPatch{block.row, block.column, level}, MeshPatch{block.row, block.column + half, level},
            MeshPatch{block.row + half, block.column, level},
            MeshPatch{block.row + half, block.column + half, level}};
}

} // namespace

bool LevelOfDetail::is_there(const MeshPatch& block) const
{
    const std::size_t cells = block_cells(block.level);
    const Grid<HeightRange>& ranges = blocks_[block.level];
    return block.row / cells < ranges.rows() && block.column / cells < ranges.columns()
           && has_data(ranges(block.row / cells, block.column / cells));
}

void LevelOfDetail::select_block(const MeshPatch& block, Selection& selection) const
{
    if (!is_there(block))
        return;
    const Box box = box_of(block);
    if (!selection.frustum.may_see(box))
        return;
    if (block.level == 0 || !(distance_m(selection.eye_m, box) < selection.ranges[block.level - 1].end_m)) {
        selection.patches.push_back(block);
        return;
    }
    for (const MeshPatch& quarter : quarters(block))
        select_block(quarter, selection);
}

std::vector<MeshPatch> LevelOfDetail::patches_of(std::size_t level,
                                                 const std::function<bool(const Box&)>& wanted) const
{
    if (level >= levels())
        throw InvalidInput("there are levels of detail 0 to " + std::to_string(levels() - 1) + ", got "
                           + std::to_string(level));
    std::vector<MeshPatch> patches;
    std::vector<MeshPatch> to_look_at = {{0, 0, static_cast<std::uint32_t>(levels() - 1)}};
    while (!to_look_at.empty()) {
        const MeshPatch block = to_look_at.back();
        to_look_at.pop_back();
        if (!is_there(block) || !wanted(box_of(block)))
            continue;
        if (block.level == level)
            patches.push_back(block);
        else
            std::ranges::copy(quarters(block), std::back_inserter(to_look_at));
    }
    return patches;
}

Box LevelOfDetail::box_of(const MeshPatch& patch) const
{
    const std::size_t cells = block_cells(patch.level);
    const HeightRange heights = blocks_[patch.level](patch.row / cells, patch.column / cells);
    const auto last = [&](std::size_t first, std::size_t samples) {
        return static_cast<double>(std::min(first + cells, samples - 1));
    };
    const Vector3 north_west =
        position_m({static_cast<double>(patch.row), static_cast<double>(patch.column), heights.highest_m},
                   field_.cell_size_m);
    const Vector3 south_east =
        position_m({last(patch.row, field_.rows()), last(patch.column, field_.columns()), heights.lowest_m},
                   field_.cell_size_m);
    return {{north_west.x, south_east.y, south_east.z}, {south_east.x, north_west.y, north_west.z}};
}

namespace {

void fill_from_coarser(Grid<float>& heights_m, const Grid<float>& coarser_m)
{
    for (std::size_t row = 0; row < heights_m.rows(); ++row)
        for (std::size_t column = 0; column < heights_m.columns(); ++column)
            if (std::isnan(heights_m(row, column)))
                heights_m(row, column) = coarser_m(row / 2, column / 2);
}

void fill_holes(Grid<float>& heights_m)
{
    const auto values = heights_m.values();
    if (std::ranges::none_of(values, [](float height_m) { return std::isnan(height_m); }))
        return;
    if (heights_m.size() <= 1) {
        std::ranges::fill(values, 0.0f);
        return;
    }
    Grid<float> coarser_m = halved(heights_m.view());
    fill_holes(coarser_m);
    fill_from_coarser(heights_m, coarser_m);
}

} // namespace

Grid<float> with_holes_filled(const HeightField& field)
{
    Grid<float> heights_m(field.rows(), field.columns());
    for (std::size_t row = 0; row < field.rows(); ++row)
        std::ranges::copy(field.heights_m.row(row), heights_m.row(row).begin());
    fill_holes(heights_m);
    return heights_m;
}

} // namespace duskline
