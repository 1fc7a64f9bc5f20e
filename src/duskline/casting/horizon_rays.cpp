#include <duskline/casting/horizon_rays.h>
#include <duskline/casting/ray_blocks.h>

#include <algorithm>
#include <cmath>

namespace duskline {

namespace {

// Light at 45 degrees falls by as many metres per line as lines are apart.
LightFrame frame_along(Angle azimuth, CellSize cell_size_m)
{
    return light_frame({.azimuth = azimuth, .altitude = Angle::from_degrees(45.0)}, cell_size_m);
}

// A level ray: what RayMarch calls the shadow of a crossing is then the surface itself.
DirectionalLight level_light(Angle azimuth)
{
    return {.azimuth = azimuth, .altitude = Angle::from_degrees(0.0)};
}

HeightRange range_within(double greatest_m)
{
    return {-static_cast<float>(greatest_m), static_cast<float>(greatest_m)};
}

} // namespace

TiltedPlane plane_along(const DirectionalLight& light, CellSize cell_size_m)
{
    const Vector3 towards = direction_towards(light);
    const double level = std::hypot(towards.x, towards.y);
    const double rise = level > 0.0 ? towards.z / (level * level) : 0.0;
    return {.rise_per_row_m = -rise * towards.y * cell_size_m.y,
            .rise_per_column_m = rise * towards.x * cell_size_m.x};
}

HorizonRays::HorizonRays(const HeightField& field, const TiltedMaxima& maxima, double greatest_m,
                         Angle azimuth, double lowest_tangent, double highest_tangent)
    : field_(field), maxima_(maxima), march_(field, level_light(azimuth), range_within(greatest_m)),
      lowest_tangent_(lowest_tangent), highest_tangent_(highest_tangent), highest_m_(greatest_m)
{
    const LightFrame frame = frame_along(azimuth, field.cell_size_m);
    metres_per_line_ = frame.drop_m;
    slope_ = std::abs(frame.lateral);
    lowest_rise_ = lowest_tangent * metres_per_line_;
    highest_rise_ = highest_tangent * metres_per_line_;
    const double along = frame.first_line_is_index_0 ? -1.0 : 1.0; // towards the light
    const double across = -frame.lateral;
    plane_rise_ = frame.lines_are_rows ? maxima.plane().at(along, across) : maxima.plane().at(across, along);
    margin_m_ = maxima.rounding_m() + kSlack_cells * 2.0 * greatest_m;
}

double HorizonRays::tangent(std::size_t row, std::size_t column, std::int64_t& hint) const
{
    Search search;
    search.start = march_.surface().start_at(row, column);
    search.ground_m = field_.heights_m(row, column);
    search.ground_over_plane_m =
        search.ground_m - maxima_.plane().at(static_cast<double>(row), static_cast<double>(column));
    search.rise = lowest_rise_;
    follow(search, hint);
    if (search.rise >= highest_rise_)
        return highest_tangent_;
    return search.rise > lowest_rise_ ? search.rise / metres_per_line_ : lowest_tangent_;
}

void HorizonRays::follow(Search& search, std::int64_t& hint) const
{
    if (hint > 0 && search.start.line + hint <= march_.last_line())
        raise_to_line(search, search.start.line + hint);
    std::int64_t line = search.start.line;
    std::int64_t cell = search.start.cell;
    std::size_t level = TiltedMaxima::kFirstLevel;
    while (line < march_.last_line()) {
        if (search.rise >= highest_rise_ || cell > march_.last_cell() || is_over_everything(search, line))
            return;
        const std::int64_t end = block_end(march_.surface(), level, line);
        const std::int64_t reached = march_.cell_after(search.start, march_.distance_to(search.start, end));
        if (is_under(search, level, line, end, cell, reached)) {
            line = end;
            cell = std::max(cell, reached);
            if (level < maxima_.last_level() && is_border_above(march_.surface(), level, line))
                ++level;
        } else if (level > TiltedMaxima::kFirstLevel) {
            --level;
        } else {
            cross_lines(search, line, end, cell, hint);
            line = end;
        }
    }
    if (slope_ > 0.0 && cell < march_.last_cell()) // at the very end, where rounding may have put it
        raise_to_cell(search, cell + 1);
}

void HorizonRays::cross_lines(Search& search, std::int64_t line, std::int64_t end, std::int64_t& cell,
                              std::int64_t& hint) const
{
    while (line < end && search.rise < highest_rise_) {
        const double before = search.rise;
        ++line;
        const double distance = march_.distance_to(search.start, line);
        const std::int64_t reached =
            std::min(march_.cell_after(search.start, distance), march_.last_cell() + 1);
        for (; cell < reached; ++cell)
            if (cell < march_.last_cell())
                raise_to_cell(search, cell + 1);
        raise_to_line(search, line);
        if (search.rise > before)
            hint = line - search.start.line;
    }
}

void HorizonRays::raise_to_line(Search& search, std::int64_t line) const
{
    const double distance = march_.distance_to(search.start, line);
    const double over_m = march_.shadow_of_line_m(search.start, line) - search.ground_m;
    if (over_m > search.rise * distance)
        search.rise = over_m / distance;
}

void HorizonRays::raise_to_cell(Search& search, std::int64_t cell) const
{
    const double distance = static_cast<double>(cell - search.start.cell) / slope_;
    const double over_m = march_.shadow_of_cell_m(search.start, cell) - search.ground_m;
    if (over_m > search.rise * distance)
        search.rise = over_m / distance;
}

// Whether the blocks between two lines stay under the ray.
bool HorizonRays::is_under(const Search& search, std::size_t level, std::int64_t line, std::int64_t end,
                           std::int64_t first_cell, std::int64_t last_cell) const
{
    const double highest_m =
        highest_ahead_m(march_.surface(), level, line, first_cell, last_cell,
                        [this](std::size_t at, std::size_t block_row, std::size_t block_column) {
                            return maxima_.highest_m(at, block_row, block_column);
                        });
    const double rise = search.rise - plane_rise_; // over the plane
    const double nearest = march_.distance_to(search.start, line) - kSlack_cells;
    const double farthest = march_.distance_to(search.start, end) + kSlack_cells;
    return highest_m + margin_m_ <= search.ground_over_plane_m + rise * (rise > 0.0 ? nearest : farthest);
}

bool HorizonRays::is_over_everything(const Search& search, std::int64_t line) const
{
    const double distance = march_.distance_to(search.start, line) - kSlack_cells;
    return highest_m_ + margin_m_ <= search.ground_m + search.rise * distance;
}

} // namespace duskline
