// Shadows by marching one cell at a time along the ray's direction.
//
//        o     o     o     o     o           P      the cell that asks
//                           .x               x      where the march looks, one cell apart
//        o     o     x.'     o     o         (x)    the sample that is nearest to it, or the four around it
//               .x.'
//        P . '   o     o     o     o
//
// Under parallel light the steps are the same for every cell: so many rows and columns on, and so much climb. So a
// step is taken for some neighbouring cells of a row at a time, which the compiler turns into SIMD, and the march
// ends when none of them can be shaded any more. Under a lamp every cell has a direction of its own.
//
// Sources: "Fast Computation of Terrain Shadow Maps" (gamedev.net) and a note on pregenerated shadow maps that adds
// rounding and normalising. Departs from both: heights are compared in metres and double precision, steps are
// counted from the cell itself and not added up, the ray ends at the border sample and not one before it, and a
// height equal to the ray's leaves the cell lit, as for every other caster.

#include <duskline/casting/lamp_march.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/line_march.h>
#include <duskline/casting/ray_cells.h>
#include <duskline/execution/for_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace duskline {

namespace {

// What a march looks at: the sample so many lines and cells from its own, both counted towards the light, and
// shares of the way to the next ones. A part of 0 asks for nothing of the next.
struct Look {
    std::ptrdiff_t lines = 0;
    std::ptrdiff_t cells = 0;
    double line_part = 0.0;
    double cell_part = 0.0;
};

struct NearestSample {
    static Look at(double lines, double cells)
    {
        return {static_cast<std::ptrdiff_t>(std::round(lines)),
                static_cast<std::ptrdiff_t>(std::round(cells)), 0.0, 0.0};
    }
};

struct BilinearSurface {
    static Look at(double lines, double cells)
    {
        const Split line = split(lines);
        const Split cell = split(cells);
        return {line.whole, cell.whole, line.part, cell.part};
    }

private:
    struct Split {
        std::ptrdiff_t whole;
        double part;
    };

    // A hair beside a sample counts as on it, or light along an axis would leave the outermost cells unshaded.
    static Split split(double place)
    {
        const double nearest = std::round(place);
        if (std::abs(place - nearest) <= kSlack_cells)
            return {static_cast<std::ptrdiff_t>(nearest), 0.0};
        const double whole = std::floor(place);
        return {static_cast<std::ptrdiff_t>(whole), place - whole};
    }
};

struct Offset {
    std::ptrdiff_t rows;
    std::ptrdiff_t columns;
};

Offset in_grid(const Counting& counting, std::ptrdiff_t lines, std::ptrdiff_t cells)
{
    const std::ptrdiff_t along = counting.lines_turned ? -lines : lines;
    const std::ptrdiff_t across = counting.cells_turned ? -cells : cells;
    return counting.lines_are_rows ? Offset{along, across} : Offset{across, along};
}

// The samples that a look needs, relative to a cell: the nearest one to the cell, and the steps to the others.
struct Samples {
    Samples(const Counting& counting, const Look& look)
        : first(in_grid(counting, look.lines, look.cells)),
          next_line(in_grid(counting, look.line_part > 0.0 ? 1 : 0, 0)),
          next_cell(in_grid(counting, 0, look.cell_part > 0.0 ? 1 : 0)), line_part(look.line_part),
          cell_part(look.cell_part)
    {}

    bool is_one() const { return line_part == 0.0 && cell_part == 0.0; }
    Offset last() const
    {
        return {first.rows + next_line.rows + next_cell.rows,
                first.columns + next_line.columns + next_cell.columns};
    }

    Offset first;
    Offset next_line;
    Offset next_cell;
    double line_part;
    double cell_part;
};

// The height between four samples; NaN where one of them is. `next_line` and `next_cell` are distances in memory.
double between(const float* first, std::ptrdiff_t next_line, std::ptrdiff_t next_cell, double line_part,
               double cell_part)
{
    const auto mix = [](double a, double b, double part) { return a + (b - a) * part; };
    return mix(mix(first[0], first[next_cell], cell_part),
               mix(first[next_line], first[next_line + next_cell], cell_part), line_part);
}

// What no look finds more than, rounding between samples included.
double highest_surface_m(const HeightField& field)
{
    const HeightRange range = height_range(field);
    return range.highest_m + kSlack_cells * (static_cast<double>(range.highest_m) - range.lowest_m);
}

// Places of the grid that are in it and stay in it with an offset.
struct Range {
    Range(std::size_t size, std::ptrdiff_t a, std::ptrdiff_t b)
        : first(std::max<std::ptrdiff_t>(-std::min(a, b), 0)),
          last(static_cast<std::ptrdiff_t>(size) - std::max<std::ptrdiff_t>(std::max(a, b), 0))
    {}

    bool holds(std::ptrdiff_t place) const { return place >= first && place < last; }

    std::ptrdiff_t first;
    std::ptrdiff_t last;
};

// ---------------------------------------------------------------------------------------------------------
// Parallel light

struct Step {
    Samples samples;
    Range rows;
    Range columns;
    double climb_m;
};

// All steps of a light that land in the grid from some cell.
template <typename LookUp>
std::vector<Step> steps_towards(const DirectionalLight& light, const HeightField& field)
{
    const LightFrame frame = light_frame(light, field.cell_size_m);
    const Counting counting{frame.lines_are_rows, frame.first_line_is_index_0, frame.lateral > 0.0};
    const double slope = std::abs(frame.lateral);
    const double lines_per_step = 1.0 / std::sqrt(1.0 + slope * slope);
    std::vector<Step> steps;
    for (double number = 1.0;; ++number) {
        const double lines = number * lines_per_step;
        const Samples samples(counting, LookUp::at(lines, lines * slope));
        const Step step{samples, Range(field.rows(), samples.first.rows, samples.last().rows),
                        Range(field.columns(), samples.first.columns, samples.last().columns),
                        frame.drop_m * lines};
        if (step.rows.first >= step.rows.last || step.columns.first >= step.columns.last)
            return steps;
        steps.push_back(step);
    }
}

// What the steps of one light find from neighbouring cells of a row.
class RowMarch {
public:
    static constexpr std::size_t kCells = 64;
    using Shadows = std::array<double, kCells>;

    RowMarch(const HeightField& field, const std::vector<Step>& steps)
        : field_(field), steps_(steps), highest_m_(highest_surface_m(field))
    {}

    // Raises `shadow_m`, one for each of `count` cells from (row, column) on, to the shadow heights over them where
    // those are higher. Goes no further once every one is above `enough_m`, which may be null.
    void raise(std::size_t row, std::size_t column, std::size_t count, const double* enough_m,
               Shadows& shadow_m) const
    {
        constexpr std::size_t kBetweenLooks = 8;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const Step& step = steps_[i];
            if (!step.rows.holds(static_cast<std::ptrdiff_t>(row)))
                return; // nor is any later one
            if (i % kBetweenLooks == 0 && is_settled(step, count, enough_m, shadow_m))
                return;
            take(step, row, column, count, shadow_m);
        }
    }

private:
    // No ground can raise a cell that the ray left below the highest of all, or that is in shadow already.
    bool is_settled(const Step& step, std::size_t count, const double* enough_m,
                    const Shadows& shadow_m) const
    {
        const double most_m = highest_m_ - step.climb_m;
        bool settled = true;
        for (std::size_t i = 0; i < count; ++i)
            settled &= most_m <= shadow_m[i] || (enough_m != nullptr && shadow_m[i] > enough_m[i]);
        return settled;
    }

    void take(const Step& step, std::size_t row, std::size_t column, std::size_t count,
              Shadows& shadow_m) const
    {
        const Samples& samples = step.samples;
        const auto stride = static_cast<std::ptrdiff_t>(field_.heights_m.row_stride());
        const auto own = static_cast<std::ptrdiff_t>(column);
        const std::ptrdiff_t from = std::max(step.columns.first, own) - own;
        const std::ptrdiff_t to = std::min(step.columns.last - own, static_cast<std::ptrdiff_t>(count));
        if (from >= to)
            return;
        const float* const first = field_.heights_m.data()
                                   + (static_cast<std::ptrdiff_t>(row) + samples.first.rows) * stride + own
                                   + samples.first.columns;
        const std::ptrdiff_t next_line = samples.next_line.rows * stride + samples.next_line.columns;
        const std::ptrdiff_t next_cell = samples.next_cell.rows * stride + samples.next_cell.columns;
        double* const shadow = shadow_m.data();
        const auto raise_to = [&](std::ptrdiff_t i, double height_m) {
            const double cast_m = height_m - step.climb_m;
            shadow[i] = cast_m > shadow[i] ? cast_m : shadow[i]; // not for NaN
        };
        if (samples.is_one())
            for (std::ptrdiff_t i = from; i < to; ++i)
                raise_to(i, first[i]);
        else
            for (std::ptrdiff_t i = from; i < to; ++i)
                raise_to(i, between(first + i, next_line, next_cell, samples.line_part, samples.cell_part));
    }

    const HeightField& field_;
    const std::vector<Step>& steps_;
    double highest_m_;
};

// Calls `march(row, column, count)` for all cells, some neighbours of a row at a time.
template <typename March>
void for_parts_of_rows(const HeightField& field, const Execution& execution, const March& march)
{
    for_rows(field.rows(), 4, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < field.columns(); column += RowMarch::kCells)
                march(row, column, std::min(RowMarch::kCells, field.columns() - column));
    });
}

template <typename LookUp>
ShadowMask cast(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);

    const std::vector<Step> steps = steps_towards<LookUp>(light, field);
    const RowMarch march(field, steps);
    ShadowMask mask(field.rows(), field.columns());
    for_parts_of_rows(field, execution, [&](std::size_t row, std::size_t column, std::size_t count) {
        const auto ground = field.heights_m.row(row).subspan(column, count);
        RowMarch::Shadows ground_m{};
        std::ranges::transform(ground, ground_m.begin(), [](float height_m) {
            return std::isnan(height_m) ? kNeverEnough : static_cast<double>(height_m);
        });
        RowMarch::Shadows shadow_m = ground_m;
        march.raise(row, column, count, ground_m.data(), shadow_m);
        for (std::size_t i = 0; i < count; ++i)
            mask(row, column + i) = std::isnan(ground[i])        ? Lit::unknown
                                    : ground_m[i] >= shadow_m[i] ? Lit::yes
                                                                 : Lit::no;
    });
    return mask;
}

template <typename LookUp>
ShadowField shadow_heights(const HeightField& field, const DirectionalLight& light,
                           const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field, *answer);

    const std::vector<Step> steps = steps_towards<LookUp>(light, field);
    const RowMarch march(field, steps);
    ShadowField shadows(field.rows(), field.columns());
    for_parts_of_rows(field, execution, [&](std::size_t row, std::size_t column, std::size_t count) {
        const auto ground = field.heights_m.row(row).subspan(column, count);
        RowMarch::Shadows shadow_m{};
        std::ranges::transform(ground, shadow_m.begin(), [](float height_m) {
            return std::isnan(height_m) ? kNeverEnough : kNothing; // asks for nothing
        });
        march.raise(row, column, count, nullptr, shadow_m);
        for (std::size_t i = 0; i < count; ++i)
            shadows(row, column + i) = std::isnan(ground[i]) ? std::numeric_limits<float>::quiet_NaN()
                                                             : shadow_height_as_float(shadow_m[i]);
    });
    return shadows;
}

// ---------------------------------------------------------------------------------------------------------
// Lamps

// The marches to one lamp over one terrain.
template <typename LookUp>
class MarchToLamp {
public:
    MarchToLamp(const HeightField& field, const PointLight& lamp)
        : field_(field), lamp_(snapped(lamp).position), highest_m_(highest_surface_m(field))
    {}

    // As shadow_height_m of shadow_march.h.
    double shadow_height_m(std::size_t row, std::size_t column, double at_least_m, double enough_m) const
    {
        const double rows = lamp_.row - static_cast<double>(row);
        const double columns = lamp_.column - static_cast<double>(column);
        const Counting counting = counting_towards(rows, columns);
        const double lines = std::abs(counting.lines_are_rows ? rows : columns);
        const double cells = std::abs(counting.lines_are_rows ? columns : rows);
        const double distance = std::sqrt(lines * lines + cells * cells);
        double shadow_m = at_least_m;
        for (double passed = 1.0; passed < distance; ++passed) {
            const double share = passed / distance;
            const Samples samples(counting, LookUp::at(lines * share, cells * share));
            if (!is_in_grid(samples, row, column))
                break;
            const double cast_m = cast_from(height_m(samples, row, column), passed, distance - passed);
            shadow_m = cast_m > shadow_m ? cast_m : shadow_m; // not for NaN
            if (shadow_m > enough_m || is_above_all(passed, distance - passed, shadow_m))
                break;
        }
        return shadow_m;
    }

private:
    bool is_in_grid(const Samples& samples, std::size_t row, std::size_t column) const
    {
        const Offset last = samples.last();
        return Range(field_.rows(), samples.first.rows, last.rows).holds(static_cast<std::ptrdiff_t>(row))
               && Range(field_.columns(), samples.first.columns, last.columns)
                      .holds(static_cast<std::ptrdiff_t>(column));
    }

    double height_m(const Samples& samples, std::size_t row, std::size_t column) const
    {
        const auto stride = static_cast<std::ptrdiff_t>(field_.heights_m.row_stride());
        const float* const first = field_.heights_m.data()
                                   + (static_cast<std::ptrdiff_t>(row) + samples.first.rows) * stride
                                   + static_cast<std::ptrdiff_t>(column) + samples.first.columns;
        return between(first, samples.next_line.rows * stride + samples.next_line.columns,
                       samples.next_cell.rows * stride + samples.next_cell.columns, samples.line_part,
                       samples.cell_part);
    }

    // How high the shadow of a height lies over the start, from similar triangles (lamp_march.h).
    double cast_from(double height_m, double passed, double ahead) const
    {
        return height_m - (lamp_.height_m - height_m) * (passed / ahead);
    }

    // Under a lamp above all ground the ray only rises.
    bool is_above_all(double passed, double ahead, double shadow_m) const
    {
        return lamp_.height_m >= highest_m_ && cast_from(highest_m_, passed, ahead) <= shadow_m;
    }

    const HeightField& field_;
    GridPoint lamp_;
    double highest_m_;
};

template <typename LookUp>
ShadowMask cast(const HeightField& field, const PointLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(field, light))
        return uniform_mask(field, *answer);

    const MarchToLamp<LookUp> march(field, light);
    return mask_by_rays(field, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        return march.shadow_height_m(row, column, ground_m, ground_m);
    });
}

template <typename LookUp>
ShadowField shadow_heights(const HeightField& field, const PointLight& light, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(field, light))
        return uniform_shadow_heights(field, *answer);

    const MarchToLamp<LookUp> march(field, light);
    return shadow_heights_by_rays(field, execution, [&](std::size_t row, std::size_t column) {
        return march.shadow_height_m(row, column, kNothing, kNeverEnough);
    });
}

} // namespace

ShadowMask cast_by_line_march(const HeightField& field, const DirectionalLight& light,
                              const Execution& execution)
{
    return cast<NearestSample>(field, light, execution);
}

ShadowMask cast_by_line_march_bilinear(const HeightField& field, const DirectionalLight& light,
                                       const Execution& execution)
{
    return cast<BilinearSurface>(field, light, execution);
}

ShadowField shadow_heights_by_line_march(const HeightField& field, const DirectionalLight& light,
                                         const Execution& execution)
{
    return shadow_heights<NearestSample>(field, light, execution);
}

ShadowField shadow_heights_by_line_march_bilinear(const HeightField& field, const DirectionalLight& light,
                                                  const Execution& execution)
{
    return shadow_heights<BilinearSurface>(field, light, execution);
}

ShadowMask cast_by_line_march(const HeightField& field, const PointLight& light, const Execution& execution)
{
    return cast<NearestSample>(field, light, execution);
}

ShadowMask cast_by_line_march_bilinear(const HeightField& field, const PointLight& light,
                                       const Execution& execution)
{
    return cast<BilinearSurface>(field, light, execution);
}

ShadowField shadow_heights_by_line_march(const HeightField& field, const PointLight& light,
                                         const Execution& execution)
{
    return shadow_heights<NearestSample>(field, light, execution);
}

ShadowField shadow_heights_by_line_march_bilinear(const HeightField& field, const PointLight& light,
                                                  const Execution& execution)
{
    return shadow_heights<BilinearSurface>(field, light, execution);
}

} // namespace duskline
