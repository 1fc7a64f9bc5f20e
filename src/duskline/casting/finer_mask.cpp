// The mask of finer cells.
//
//      +-------+-------+
//      | 0   0 | 0   1 |      o  centres of cells, whose answers are known
//      |   o   |   o   |      0, 1  finer cells: here every one gets a ray, for the cells
//      | 0   0 | 1   1 |            do not all agree with their neighbours
//      +-------+-------+

#include <duskline/casting/finer_mask.h>
#include <duskline/casting/ray.h>
#include <duskline/execution/for_rows.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/refined.h>
#include <duskline/terrain/require_same_size.h>

#include <cmath>
#include <string>
#include <vector>

namespace duskline {

namespace {

constexpr std::size_t kRowsPerPiece = 4;

void require_sizes(const HeightField& field, const ShadowMask& mask, const HeightField& finer)
{
    require_same_size("the mask", mask, field);
    if (finer.rows() < field.rows() || finer.columns() < field.columns())
        throw InvalidInput("finer cells must be at least as many as those of the terrain, "
                           + size_text(field.rows(), field.columns()) + ", got "
                           + size_text(finer.rows(), finer.columns()));
}

template <typename Light>
ShadowMask cast_finer(const HeightField& field, const ShadowMask& mask, const Light& light,
                      const HeightField& finer, const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    require_sizes(field, mask, finer);
    const TerrainRays rays(field, {.threads = execution.threads});
    const auto answer_at = [&](const GridPoint& point) {
        const auto ground_m = ground_height_m(field, point.row, point.column);
        const double height_m = ground_m.value_or(point.height_m); // at the border and beside holes
        return rays.is_shadowed({point.row, point.column, height_m}, light) ? Lit::no : Lit::yes;
    };
    const std::vector<FinerPlace> columns = finer_places(finer.columns(), field.columns());
    ShadowMask result(finer.rows(), finer.columns());
    for_rows(finer.rows(), kRowsPerPiece, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y) {
            const FinerPlace down = finer_place(y, finer.rows(), field.rows());
            for (std::size_t x = 0; x < finer.columns(); ++x) {
                const FinerPlace& across = columns[x];
                const float height_m = finer.heights_m(y, x);
                if (std::isnan(height_m))
                    result(y, x) = Lit::unknown;
                else if (!has_other_neighbour(mask, down.nearest, across.nearest))
                    result(y, x) = mask(down.nearest, across.nearest);
                else
                    result(y, x) = answer_at({down.place, across.place, height_m});
            }
        }
    });
    return result;
}

} // namespace

ShadowMask finer_mask(const HeightField& field, const ShadowMask& mask, const DirectionalLight& light,
                      const HeightField& finer, const Execution& execution)
{
    return cast_finer(field, mask, light, finer, execution);
}

ShadowMask finer_mask(const HeightField& field, const ShadowMask& mask, const PointLight& light,
                      const HeightField& finer, const Execution& execution)
{
    return cast_finer(field, mask, light, finer, execution);
}

} // namespace duskline
