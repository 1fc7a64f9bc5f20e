// Shadows by a map of silhouettes: what a ray need not look at is left out before any ray is cast.
//
//              .  ray                  A ray from P is above the ground where the ground rises towards the light
//           .'                         (T0), and it is above it where the ground falls away from the light (T2) once
//        .' T1                         it is above the edge between (T1). So only edges matter, silhouettes as the
//   P .'   /\___T2                     light sees them, and of those only the ones that stand out over the ground at
//  __o__T0/      \____                 P, and not those behind a higher one.
//
// smap_beams.cpp makes the map. The queries here go from texel to texel along NextV; every line they look at is
// compared with the ray by the code of `ray`, in double precision, so what is in shadow does not depend on the map.
//
// Why nothing is missed: what decides is the highest ground that a ray meets, seen along the light. It is a silhouette, or
// on the first line. NextV leaves out a silhouette only for ground that is surely higher: of a section between, which
// the highest does not have, of a silhouette that is looked at instead, or of the section itself, where the point is on
// or above it.
//
// V. Sakalauskas, Hybrid Terrain Shadow Ray Casting, WSCG 2008, short papers. Departs from it in this:
//
// - The light may come from anywhere: where it runs more along rows, columns are its lines.
// - A point between two lines is compared with the first one ahead even when that is White: it may be under the ground
//   between them. A point on a line is not compared with that line, or rounding would shade ground by itself.
// - A ray goes on until NextV is none. The source also stops at the border, which NextV does not leave.
// - What cannot shadow or is covered is decided as smap_beams.cpp says, and with it what is Black.

#include <duskline/casting/greatest_magnitude.h>
#include <duskline/casting/ray_cells.h>
#include <duskline/casting/ray_march.h>
#include <duskline/casting/require_place.h>
#include <duskline/casting/smap.h>
#include <duskline/casting/smap_beams.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kMostLines = std::size_t{1} << 26;

// Casting begins where building ends, on the progress bar.
constexpr double kBuilt = 0.5;

void require_lines(std::size_t lines)
{
    if (lines > kMostLines)
        throw InvalidInput("a silhouette map takes grids of at most " + std::to_string(kMostLines)
                           + " lines, got " + std::to_string(lines) + "; use a window of the grid");
}

} // namespace

// The rays of one map. Lines are counted from the light here, and towards it in a RayMarch.
class SilhouetteMap::Query {
public:
    explicit Query(const SilhouetteMap& map)
        : map_(map), march_(map.field_, map.light_, {}),
          columns_(static_cast<std::int64_t>(map.texels_.columns()))
    {}

    RayMarch::Entry entry(double row, double column) const
    {
        return march_.entry(march_.surface().start_at(row, column));
    }

    // The height of the shadow over a cell, where that is above its ground, or any above `enough_m`. Counts the
    // look-ups.
    double over_cell_m(std::size_t row, std::size_t column, double at_least_m, double enough_m,
                       std::size_t& look_ups) const
    {
        const RayStart start = march_.surface().start_at(row, column);
        const auto v = static_cast<std::size_t>(march_.last_line() - start.line);
        const std::int64_t beam =
            beam_at(static_cast<double>(map_.frame_.lines_are_rows ? column : row), static_cast<double>(v));
        return follow(start, {v, column_of(beam, v)}, at_least_m, enough_m, look_ups);
    }

    // The same over any place from which the grid's lines are not far away.
    double over_start_m(const RayStart& start, double at_least_m, double enough_m) const
    {
        const std::int64_t own = march_.last_line() - start.line;
        const std::int64_t beam = beam_at(cell_of(start), static_cast<double>(own) - start.line_part);
        std::size_t look_ups = 0;
        if (start.line_part == 0.0 && own >= 0 && own <= march_.last_line()) {
            const auto v = static_cast<std::size_t>(own);
            if (const std::int64_t x = column_of(beam, v); x >= 0 && x < columns_)
                return follow(start, {v, x}, at_least_m, enough_m, look_ups);
        }
        const auto first = first_section(beam, own - 1);
        if (!first)
            return at_least_m;
        return follow(start, *first, std::max(at_least_m, shadow_of_line_m(start, first->v)), enough_m,
                      look_ups);
    }

private:
    struct Section {
        std::size_t v;
        std::int64_t x;
    };

    double follow(const RayStart& start, Section section, double shadow_m, double enough_m,
                  std::size_t& look_ups) const
    {
        SilhouetteTexel texel = texel_at(section);
        while (texel.has_next() && !(shadow_m > enough_m)) {
            const auto next = static_cast<std::size_t>(texel.next_v());
            section = {next, section.x + map_.lines_[next].shift - map_.lines_[section.v].shift};
            shadow_m = std::max(shadow_m, shadow_of_line_m(start, next));
            ++look_ups;
            texel = texel_at(section);
        }
        return shadow_m;
    }

    SilhouetteTexel texel_at(const Section& section) const
    {
        return map_.texels_(section.v, static_cast<std::size_t>(section.x));
    }

    double shadow_of_line_m(const RayStart& start, std::size_t v) const
    {
        return march_.shadow_of_line_m(start, march_.last_line() - static_cast<std::int64_t>(v));
    }

    // In the grid's own order.
    double cell_of(const RayStart& start) const
    {
        const double cell = static_cast<double>(start.cell) + start.cell_part;
        return march_.cells_turned() ? static_cast<double>(march_.last_cell()) - cell : cell;
    }

    std::int64_t beam_at(double cell, double v) const
    {
        return static_cast<std::int64_t>(std::floor(cell - map_.frame_.lateral * v));
    }

    std::int64_t column_of(std::int64_t beam, std::size_t v) const { return beam + map_.lines_[v].shift + 1; }

    // Where a beam first meets the grid, from line `from` on towards the light.
    std::optional<Section> first_section(std::int64_t beam, std::int64_t from) const
    {
        const auto& lines = map_.lines_;
        // Towards the light shifts only ever fall, or only ever rise: the beam comes in over one side.
        const auto entered = std::ranges::partition_point(lines, [&](const SilhouetteLineFacts& line) {
            const std::int64_t x = beam + line.shift + 1;
            return map_.frame_.lateral < 0.0 ? x >= 0 : x < columns_;
        });
        const std::int64_t v = std::min<std::int64_t>(from, entered - lines.begin() - 1);
        if (v < 0)
            return std::nullopt;
        const Section section{static_cast<std::size_t>(v), column_of(beam, static_cast<std::size_t>(v))};
        return section.x >= 0 && section.x < columns_ ? std::optional(section) : std::nullopt;
    }

    const SilhouetteMap& map_;
    RayMarch march_;
    std::int64_t columns_;
};

SilhouetteMap::SilhouetteMap(const HeightField& field, const DirectionalLight& light,
                             const SilhouetteMapOptions& options, const Execution& execution)
    : field_(field), light_(light)
{
    require_valid(field);
    require_valid(light);
    uniform_ = uniform_answer(light);
    if (uniform_)
        return;
    frame_ = light_frame(light, field.cell_size_m);
    if (field.heights_m.empty())
        return;
    const LightOrder<const float> heights = in_light_order(field.heights_m, frame_);
    require_lines(heights.lines);
    const float greatest_m = greatest_magnitude_m(kernels::active_kernels(), field, execution);
    const SilhouetteMargins margins = silhouette_margins(frame_.drop_m, greatest_m);
    rise_m_ = margins.rise_m;
    fall_m_ = margins.fall_m;
    lines_ = silhouette_lines(frame_, heights.lines, greatest_m);
    texels_ = silhouette_texels({heights, lines_, margins, options}, execution);
}

bool SilhouetteMap::is_shadowed(const GridPoint& point) const
{
    require_height(point);
    require_place(point.row, point.column);
    if (uniform_)
        return *uniform_ == Lit::no && point.height_m < kNeverEnough;
    if (texels_.empty())
        return false;
    const Query query(*this);
    const auto [start, climb_m] = query.entry(point.row, point.column);
    const double height_m = point.height_m + climb_m;
    return query.over_start_m(start, height_m, height_m) > height_m;
}

double SilhouetteMap::shadow_height_m(double row, double column) const
{
    require_place(row, column);
    if (uniform_)
        return *uniform_ == Lit::no ? kNeverEnough : kNothing;
    if (texels_.empty())
        return kNothing;
    const Query query(*this);
    const auto [start, climb_m] = query.entry(row, column);
    return query.over_start_m(start, kNothing, kNeverEnough) - climb_m;
}

ShadowMask SilhouetteMap::cast(const Execution& execution) const
{
    if (uniform_)
        return uniform_mask(field_, *uniform_);
    const Query query(*this);
    return mask_by_rays(field_, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        std::size_t look_ups = 0;
        return query.over_cell_m(row, column, ground_m, ground_m, look_ups);
    });
}

ShadowField SilhouetteMap::shadow_heights(const Execution& execution) const
{
    if (uniform_)
        return uniform_shadow_heights(field_, *uniform_);
    const Query query(*this);
    return shadow_heights_by_rays(field_, execution, [&](std::size_t row, std::size_t column) {
        std::size_t look_ups = 0;
        return query.over_cell_m(row, column, kNothing, kNeverEnough, look_ups);
    });
}

SilhouetteStatistics SilhouetteMap::statistics(const Execution& execution) const
{
    SilhouetteStatistics statistics;
    std::vector<std::size_t> look_ups(field_.rows());
    std::vector<std::size_t> cells(field_.rows());
    if (!uniform_) {
        const Query query(*this);
        mask_by_rays(field_, execution, [&](std::size_t row, std::size_t column, double ground_m) {
            ++cells[row];
            return query.over_cell_m(row, column, ground_m, ground_m, look_ups[row]);
        });
    }
    statistics.texels = texels_.size();
    statistics.black = static_cast<std::size_t>(
        std::ranges::count_if(texels_.values(), [](SilhouetteTexel texel) { return texel.is_black(); }));
    statistics.cells = std::accumulate(cells.begin(), cells.end(), std::size_t{0});
    statistics.look_ups = std::accumulate(look_ups.begin(), look_ups.end(), std::size_t{0});
    return statistics;
}

ShadowMask cast_by_smap(const HeightField& field, const DirectionalLight& light, const Execution& execution)
{
    return SilhouetteMap(field, light, {}, part_of(execution, 0.0, kBuilt))
        .cast(part_of(execution, kBuilt, 1.0));
}

ShadowField shadow_heights_by_smap(const HeightField& field, const DirectionalLight& light,
                                   const Execution& execution)
{
    return SilhouetteMap(field, light, {}, part_of(execution, 0.0, kBuilt))
        .shadow_heights(part_of(execution, kBuilt, 1.0));
}

ShadowMask cast_by_full_scan(const HeightField& field, const DirectionalLight& light,
                             const Execution& execution)
{
    require_valid(field);
    require_valid(light);
    if (const auto answer = uniform_answer(light))
        return uniform_mask(field, *answer);
    const RayMarch march(field, light, {});
    return mask_by_rays(field, execution, [&](std::size_t row, std::size_t column, double ground_m) {
        const RayStart start = march.surface().start_at(row, column);
        double shadow_m = ground_m;
        for (std::int64_t line = start.line + 1; line <= march.last_line() && shadow_m <= ground_m; ++line) {
            if (march.cell_after(start, march.distance_to(start, line)) > march.last_cell())
                break;
            shadow_m = std::max(shadow_m, march.shadow_of_line_m(start, line));
        }
        return shadow_m;
    });
}

} // namespace duskline
