// The fast ray: the march of shadow_march.h, with a look at the min/max pyramid before each step. Seen from
// above, a ray that has come to a line looks at the blocks it will pass through until the far side of the
// block it stands at:
//
//      +-------+-------+
//      |       |  .    |      If the highest ground of these blocks, at most two of them beside each other,
//      |       |.      |      casts no shadow as high as the one found so far, the ray goes on from their far
//      |      .|       |      side and tries blocks twice as large; else it tries blocks half as large, and
//      |    P  |       |      at last marches one line.
//      +-------+-------+
//
// Only crossings that cannot count are left out, and the others are computed as in the plain march: the
// answers agree in every bit.
//
// Tevs, Ihrke and Seidel, Maximum mipmaps for fast, accurate, and scalable dynamic height field rendering,
// I3D 2008. Departs from it: the surface is the grid-line surface and not bilinear patches, and a ray moves
// by lines of the grid, so that no rounding decides which block it is in.

#include <duskline/casting/lamp_march.h>
#include <duskline/casting/ray.h>
#include <duskline/casting/ray_blocks.h>
#include <duskline/casting/ray_cells.h>
#include <duskline/casting/ray_march.h>
#include <duskline/casting/require_place.h>

namespace duskline {

namespace {

class FastMarch {
public:
    explicit FastMarch(const MinMaxPyramid& pyramid) : pyramid_(pyramid) {}

    // As the plain march. What is above `enough_m` may differ, as another crossing comes first.
    template <typename Ray>
    double shadow_height_m(const Ray& ray, double at_least_m, double enough_m) const
    {
        const GridLineSurface& surface = ray.surface();
        double shadow_m = at_least_m;
        std::int64_t line = ray.first_line();
        std::int64_t cell = ray.first_cell();
        std::size_t level = 0;
        while (line < ray.last_line()) {
            if (shadow_m > enough_m || cell > surface.last_cell()
                || ray.bound_m(ray.highest_m(), line, ray.last_line()) <= shadow_m)
                return shadow_m;
            if (level == 0) {
                cross(ray, ++line, cell, shadow_m);
                level = 1;
                continue;
            }
            const std::int64_t end = std::min(block_end(surface, level, line), ray.last_line());
            const std::int64_t reached = ray.cell_at(end);
            if (ray.bound_m(highest_m(surface, level, line, cell, reached), line, end) <= shadow_m) {
                line = end;
                cell = std::max(cell, reached);
                level = std::min(level + 1, pyramid_.levels());
            } else {
                --level;
            }
        }
        return last_raised(ray, cell, shadow_m);
    }

private:
    // Of the blocks ahead of `line` that hold the cells from `first` to `last`.
    double highest_m(const GridLineSurface& surface, std::size_t level, std::int64_t line, std::int64_t first,
                     std::int64_t last) const
    {
        return highest_ahead_m(surface, level, line, first, last,
                               [this](std::size_t at, std::size_t block_row, std::size_t block_column) {
                                   return pyramid_.range(at, block_row, block_column).highest_m;
                               });
    }

    const MinMaxPyramid& pyramid_;
};

} // namespace

TerrainRays::TerrainRays(const HeightField& field, const Execution& execution) : field_(field)
{
    require_valid(field);
    pyramid_ = MinMaxPyramid(field, execution);
}

double TerrainRays::shadow_height_m(double row, double column, const DirectionalLight& light) const
{
    require_place(row, column);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return *answer == Lit::no ? -kNothing : kNothing;
    if (field_.heights_m.empty())
        return kNothing;

    const RayMarch march(field_, light, pyramid_.total());
    const auto entry = march.entry(march.surface().start_at(row, column));
    return FastMarch(pyramid_).shadow_height_m(ParallelRay(march, entry.start), kNothing, kNeverEnough)
           - entry.drop_m;
}

bool TerrainRays::is_shadowed(const GridPoint& point, const DirectionalLight& light) const
{
    require_height(point);
    require_place(point.row, point.column);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return *answer == Lit::no && point.height_m < kNeverEnough;
    if (field_.heights_m.empty())
        return false;
    // As shadow_height_m, but any shadow above the point will do.
    const RayMarch march(field_, light, pyramid_.total());
    const auto entry = march.entry(march.surface().start_at(point.row, point.column));
    const double height_m = point.height_m + entry.drop_m;
    return FastMarch(pyramid_).shadow_height_m(ParallelRay(march, entry.start), height_m, height_m)
           > height_m;
}

ShadowMask TerrainRays::cast(const DirectionalLight& light, const Execution& execution) const
{
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field_, *answer);
    const RayMarch march(field_, light, pyramid_.total());
    const FastMarch fast(pyramid_);
    return mask_by_rays(field_, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        return fast.shadow_height_m(ParallelRay(march, march.surface().start_at(row, column)), ground_m,
                                    ground_m);
    });
}

ShadowField TerrainRays::shadow_heights(const DirectionalLight& light, const Execution& execution) const
{
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_shadow_heights(field_, *answer);
    const RayMarch march(field_, light, pyramid_.total());
    const FastMarch fast(pyramid_);
    return shadow_heights_by_rays(field_, execution, [&](std::size_t row, std::size_t column) {
        return fast.shadow_height_m(ParallelRay(march, march.surface().start_at(row, column)), kNothing,
                                    kNeverEnough);
    });
}

double TerrainRays::shadow_height_m(double row, double column, const PointLight& light) const
{
    require_place(row, column);
    require_valid(light);
    if (field_.heights_m.empty())
        return kNothing;
    if (uniform_answer(field_, light))
        return -kNothing;
    const LampMarch march(field_, light, pyramid_.total());
    return FastMarch(pyramid_).shadow_height_m(march.ray_from(row, column), kNothing, kNeverEnough);
}

bool TerrainRays::is_shadowed(const GridPoint& point, const PointLight& light) const
{
    require_height(point);
    return point.height_m < shadow_height_m(point.row, point.column, light);
}

ShadowMask TerrainRays::cast(const PointLight& light, const Execution& execution) const
{
    require_valid(light);
    if (const auto answer = uniform_answer(field_, light))
        return uniform_mask(field_, *answer);
    const LampMarch march(field_, light, pyramid_.total());
    const FastMarch fast(pyramid_);
    return mask_by_rays(field_, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        return fast.shadow_height_m(march.ray_from(row, column), ground_m, ground_m);
    });
}

ShadowField TerrainRays::shadow_heights(const PointLight& light, const Execution& execution) const
{
    require_valid(light);
    if (const auto answer = uniform_answer(field_, light))
        return uniform_shadow_heights(field_, *answer);
    const LampMarch march(field_, light, pyramid_.total());
    const FastMarch fast(pyramid_);
    return shadow_heights_by_rays(field_, execution, [&](std::size_t row, std::size_t column) {
        return fast.shadow_height_m(march.ray_from(row, column), kNothing, kNeverEnough);
    });
}

ShadowMask cast_by_fast_ray(const HeightField& field, const DirectionalLight& light,
                            const Execution& execution)
{
    return TerrainRays(field, {.threads = execution.threads}).cast(light, execution);
}

ShadowField shadow_heights_by_fast_ray(const HeightField& field, const DirectionalLight& light,
                                       const Execution& execution)
{
    return TerrainRays(field, {.threads = execution.threads}).shadow_heights(light, execution);
}

ShadowMask cast_by_fast_ray(const HeightField& field, const PointLight& light, const Execution& execution)
{
    return TerrainRays(field, {.threads = execution.threads}).cast(light, execution);
}

ShadowField shadow_heights_by_fast_ray(const HeightField& field, const PointLight& light,
                                       const Execution& execution)
{
    return TerrainRays(field, {.threads = execution.threads}).shadow_heights(light, execution);
}

} // namespace duskline
