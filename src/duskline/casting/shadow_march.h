#pragma once

// The plain march, for a ray of any light. Not installed; what a ray is to bring is what ParallelRay (ray_march.h)
// and LampRay (lamp_march.h) have:
//
//   surface()                            what it meets, counted towards the light; highest_m() of it
//   first_line(), first_cell()           where it starts: at or before it, and not before -1
//   last_line(), last_cell()             the last ones of the grid that it may cross
//   cell_at(line)                        the cell at or before it on that line
//   shadow_of_line_m(), .._of_cell_m()   how high the shadow of a crossing lies over its start
//   bound_m(highest, from, to)           no ground of that height can cast a higher one from between two lines
//   cells_after_last_line()              cells that may be crossed beyond the last line, at most

#include <duskline/casting/grid_line_surface.h>

#include <algorithm>

namespace duskline {

/// Raises `shadow_m` by the crossings up to and on `line`, when those up to the line before and up to `cell` have
/// been; `cell` moves on.
template <typename Ray>
void cross(const Ray& ray, std::int64_t line, std::int64_t& cell, double& shadow_m)
{
    const std::int64_t reached = std::min(ray.cell_at(line), ray.last_cell() + 1);
    for (; cell < reached; ++cell)
        if (cell < ray.last_cell())
            shadow_m = std::max(shadow_m, ray.shadow_of_cell_m(cell + 1));
    shadow_m = std::max(shadow_m, ray.shadow_of_line_m(line));
}

/// What is left after the last line.
template <typename Ray>
double last_raised(const Ray& ray, std::int64_t cell, double shadow_m)
{
    const std::int64_t last = std::min(cell + ray.cells_after_last_line(), ray.last_cell());
    while (cell < last)
        shadow_m = std::max(shadow_m, ray.shadow_of_cell_m(++cell));
    return shadow_m;
}

/// The height under which a point over the start is in shadow, when that is above `at_least_m`, and else
/// `at_least_m`; any height above `enough_m` will do for one that is.
template <typename Ray>
double shadow_height_m(const Ray& ray, double at_least_m, double enough_m)
{
    double shadow_m = at_least_m;
    std::int64_t cell = ray.first_cell();
    for (std::int64_t line = ray.first_line() + 1; line <= ray.last_line(); ++line) {
        cross(ray, line, cell, shadow_m);
        if (shadow_m > enough_m || cell > ray.surface().last_cell()
            || ray.bound_m(ray.highest_m(), line, ray.last_line()) <= shadow_m)
            return shadow_m;
    }
    return last_raised(ray, cell, shadow_m);
}

} // namespace duskline
