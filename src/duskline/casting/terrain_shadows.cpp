// Shadows kept up to date, for suns that move and ground that changes.
//
// What an edit can change lies on the beams over it, from its first line to where the shadow of its highest ground,
// old or new, sinks under the lowest ground there is. To cast it, the front starts as many lines before as the
// highest ground there is may throw a shadow:
//
//        light       first line of the front       edit       end of its shadows
//      ------->      |---- may shade the edit ----|xxxx|---- may be shaded ----|
//                    `-------------- beams over the edit, a few to spare ------'
//
// The front decides what is close by the crossings of the ray march itself, so that it does not matter where it
// starts and what other beams there are: the same bytes.

#include <duskline/casting/exact_front.h>
#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/terrain_shadows.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kBlock = 64;

// Lines and beams to spare: a change reaches the crossings one cell around it, and beams lie between cells.
constexpr std::size_t kSpareLines = 2;
constexpr std::ptrdiff_t kSpareBeams = 3;

// Rows of at most kBlock cells. The lowest and highest of each column first, which the compiler does many at a time.
HeightRange range_of(GridView<const float> heights_m)
{
    constexpr HeightRange none;
    std::array<float, kBlock> lowest_m;
    std::array<float, kBlock> highest_m;
    lowest_m.fill(none.lowest_m);
    highest_m.fill(none.highest_m);
    for (std::size_t y = 0; y < heights_m.rows(); ++y) {
        const float* const row_m = heights_m.row(y).data();
        for (std::size_t x = 0; x < heights_m.columns(); ++x) { // NaN is neither below nor above anything
            lowest_m[x] = row_m[x] < lowest_m[x] ? row_m[x] : lowest_m[x];
            highest_m[x] = row_m[x] > highest_m[x] ? row_m[x] : highest_m[x];
        }
    }
    return {std::ranges::min(lowest_m), std::ranges::max(highest_m)};
}

double greatest_magnitude_m(const HeightRange& range)
{
    return range.lowest_m > range.highest_m ? 0.0
                                            : std::max(std::abs(range.lowest_m), std::abs(range.highest_m));
}

// Lines on which ground of one height may shade ground of another, at most `most`.
std::size_t lines_shaded(float high_m, float low_m, double drop_m, std::size_t most)
{
    const double over_m = static_cast<double>(high_m) - static_cast<double>(low_m);
    if (!(over_m > 0.0)) // or nothing of either kind
        return 0;
    return static_cast<std::size_t>(std::min(std::ceil(over_m / drop_m), static_cast<double>(most)));
}

// A rectangle in the numbers of a light's frame, ends included.
struct RectangleInFrame {
    std::size_t first_line;
    std::size_t last_line;
    std::ptrdiff_t first_cell;
    std::ptrdiff_t last_cell;
};

RectangleInFrame in_frame(const CellRectangle& rectangle, const LightFrame& frame, std::size_t lines)
{
    const bool rows = frame.lines_are_rows;
    const std::size_t first = rows ? rectangle.first_row : rectangle.first_column;
    const std::size_t last = first + (rows ? rectangle.rows : rectangle.columns) - 1;
    const std::size_t first_cell = rows ? rectangle.first_column : rectangle.first_row;
    const std::size_t last_cell = first_cell + (rows ? rectangle.columns : rectangle.rows) - 1;
    return {frame.first_line_is_index_0 ? first : lines - 1 - last,
            frame.first_line_is_index_0 ? last : lines - 1 - first, static_cast<std::ptrdiff_t>(first_cell),
            static_cast<std::ptrdiff_t>(last_cell)};
}

// The part of the grid to cast when heights up to highest_there_m have changed in a rectangle.
BeamPart part_to_cast(const BeamPart& all, const CellRectangle& rectangle, const LightFrame& frame,
                      HeightRange total, float highest_there_m)
{
    const std::size_t lines = all.last_line;
    const RectangleInFrame changed = in_frame(rectangle, frame, lines);
    const std::size_t before =
        kSpareLines + lines_shaded(total.highest_m, total.lowest_m, frame.drop_m, lines);
    const std::size_t after =
        kSpareLines + lines_shaded(highest_there_m, total.lowest_m, frame.drop_m, lines);
    BeamPart part;
    part.first_line = changed.first_line - std::min(changed.first_line, before);
    part.first_answered = changed.first_line;
    part.last_line = std::min(changed.last_line + 1 + after, lines);

    const std::ptrdiff_t least = kernels::beam_shift(frame.lateral, changed.first_line).whole;
    const std::ptrdiff_t most = kernels::beam_shift(frame.lateral, changed.last_line + 1).whole;
    const bool towards_higher = sideways_of(frame) > 0;
    const std::ptrdiff_t first_beam = changed.first_cell + (towards_higher ? -most : least);
    const std::ptrdiff_t last_beam = changed.last_cell + 1 + (towards_higher ? -least : most);
    part.first_beam = std::clamp(first_beam - kSpareBeams, all.first_beam, all.last_beam - 1);
    part.last_beam = std::clamp(last_beam + kSpareBeams, part.first_beam + 1, all.last_beam);
    return part;
}

std::size_t cells_of(const BeamPart& part, const LightFrame& frame, std::size_t cells)
{
    std::size_t sum = 0;
    const auto end = static_cast<std::ptrdiff_t>(cells);
    for (std::size_t v = part.first_line; v < part.last_line; ++v) {
        const std::ptrdiff_t moved = sideways_of(frame) * kernels::beam_shift(frame.lateral, v).whole;
        sum += static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(part.last_beam + moved, 0, end)
                                        - std::clamp<std::ptrdiff_t>(part.first_beam + moved, 0, end));
    }
    return sum;
}

// As `uniform_mask`, into a mask that is there.
void answer_all(GridView<const float> heights_m, Lit answer, GridView<Lit> mask)
{
    for (std::size_t y = 0; y < heights_m.rows(); ++y)
        std::ranges::transform(heights_m.row(y), mask.row(y).begin(), [answer](float height_m) {
            return std::isnan(height_m) ? Lit::unknown : answer;
        });
}

void require_inside(const CellRectangle& rectangle, const HeightField& field)
{
    const auto fits = [](std::size_t first, std::size_t count, std::size_t there) {
        return first <= there && count <= there - first;
    };
    if (!fits(rectangle.first_row, rectangle.rows, field.rows())
        || !fits(rectangle.first_column, rectangle.columns, field.columns()))
        throw InvalidInput("changed heights must lie in the grid of " + std::to_string(field.rows()) + " x "
                           + std::to_string(field.columns()) + " cells, got " + std::to_string(rectangle.rows)
                           + " x " + std::to_string(rectangle.columns) + " from row "
                           + std::to_string(rectangle.first_row) + ", column "
                           + std::to_string(rectangle.first_column));
}

} // namespace

TerrainShadows::TerrainShadows(const HeightField& field, const Execution& execution)
    : field_((require_valid(field), field)),
      blocks_((field.rows() + kBlock - 1) / kBlock, (field.columns() + kBlock - 1) / kBlock),
      mask_(field.rows(), field.columns(), Lit::unknown)
{
    measure_blocks(0, blocks_.rows(), 0, blocks_.columns(), execution);
}

const ShadowMask& TerrainShadows::cast(const DirectionalLight& light, const Execution& execution)
{
    require_valid(light);
    sun_.reset(); // until the mask is whole
    if (const auto answer = uniform_answer(light))
        answer_all(field_.heights_m, *answer, mask_.view());
    else if (!mask_.empty())
        cast_exact_part(field_, light, greatest_magnitude_m(total_),
                        all_beams(field_, light_frame(light, field_.cell_size_m)), mask_.view(), execution,
                        kernels::active_kernels());
    sun_ = light;
    return mask_;
}

std::size_t TerrainShadows::heights_changed(const CellRectangle& rectangle, const Execution& execution)
{
    require_inside(rectangle, field_);
    if (rectangle.rows == 0 || rectangle.columns == 0)
        return 0;
    HeightRange there = touched_blocks_range(rectangle);
    measure_blocks(rectangle.first_row / kBlock, (rectangle.first_row + rectangle.rows - 1) / kBlock + 1,
                   rectangle.first_column / kBlock,
                   (rectangle.first_column + rectangle.columns - 1) / kBlock + 1,
                   {.threads = execution.threads});
    there.include(touched_blocks_range(rectangle));
    if (!sun_)
        return 0;

    const DirectionalLight light = *sun_;
    if (const auto answer = uniform_answer(light)) {
        const auto [row, column, rows, columns] = rectangle;
        answer_all(field_.heights_m.window(row, column, rows, columns), *answer,
                   mask_.view().window(row, column, rows, columns));
        return rows * columns;
    }
    sun_.reset(); // until the mask is whole again
    const LightFrame frame = light_frame(light, field_.cell_size_m);
    const BeamPart part = part_to_cast(all_beams(field_, frame), rectangle, frame, total_, there.highest_m);
    cast_exact_part(field_, light, greatest_magnitude_m(total_), part, mask_.view(), execution,
                    kernels::active_kernels());
    sun_ = light;
    return cells_of(part, frame, frame.lines_are_rows ? field_.columns() : field_.rows());
}

HeightRange TerrainShadows::touched_blocks_range(const CellRectangle& rectangle) const
{
    HeightRange range;
    for (std::size_t y = rectangle.first_row / kBlock; y * kBlock < rectangle.first_row + rectangle.rows; ++y)
        for (std::size_t x = rectangle.first_column / kBlock;
             x * kBlock < rectangle.first_column + rectangle.columns; ++x)
            range.include(blocks_(y, x));
    return range;
}

void TerrainShadows::measure_blocks(std::size_t first_row, std::size_t last_row, std::size_t first_column,
                                    std::size_t last_column, const Execution& execution)
{
    for_rows(last_row - first_row, 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first_row + first; y < first_row + last; ++y)
            for (std::size_t x = first_column; x < last_column; ++x)
                blocks_(y, x) = range_of(field_.heights_m.window(
                    y * kBlock, x * kBlock, std::min(kBlock, field_.rows() - y * kBlock),
                    std::min(kBlock, field_.columns() - x * kBlock)));
    });
    total_ = HeightRange();
    for (const HeightRange& block : blocks_.values())
        total_.include(block);
}

} // namespace duskline
