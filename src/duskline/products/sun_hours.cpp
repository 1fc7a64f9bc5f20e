// Time in the sun, by masks of suns that each stand for a stretch of time.
//
//        dark        dark        lit         lit         a cell under four suns
//     |-----x-----|-----x-----|-----x-----|-----x-----|  their stretches, the suns in the middle
//                       |<--->^
//                       bisection: first light is here somewhere, and without it where the stretches meet
//
// Masks are so cheap that more of them are the way to better hours (sun_course.h makes them dense where shadows move
// fast); rays pay only for single changes that somebody asks for to the second: first and last light.

#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/geometry/vector.h>
#include <duskline/products/sun_hours.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

constexpr std::size_t kRowsAtOnce = 16;

// Of the time between two suns, found by halving it five times.
constexpr int kHalvings = 5;

std::uint32_t whole_seconds(const TimeSpan& span, UtcTime since)
{
    const auto from = std::chrono::round<seconds>(span.from - since);
    const auto to = std::chrono::round<seconds>(span.to - since);
    return static_cast<std::uint32_t>((to - from).count());
}

// Casts one sun after the other and hands each mask to `take`, row by row.
template <typename Take>
void cast_each(TerrainShadows& shadows, std::span<const SunSample> suns, const Execution& execution,
               const Take& take)
{
    const Execution quiet = {.threads = execution.threads, .progress = {}};
    for (std::size_t i = 0; i < suns.size(); ++i) {
        const ShadowMask& mask = shadows.cast(suns[i].light, quiet);
        for_rows(mask.rows(), kRowsAtOnce, quiet, [&](std::size_t first, std::size_t last) {
            for (std::size_t y = first; y < last; ++y)
                take(i, y, mask.row(y));
        });
        if (execution.progress
            && !execution.progress(static_cast<double>(i + 1) / static_cast<double>(suns.size())))
            throw Cancelled();
    }
}

void add_where_lit(std::span<const Lit> lit, std::uint32_t more, std::span<std::uint32_t> sum)
{
    for (std::size_t x = 0; x < lit.size(); ++x)
        sum[x] += lit[x] == Lit::yes ? more : 0U;
}

// The light on the straight way from one to another, at a share of it.
DirectionalLight between(const DirectionalLight& from, const DirectionalLight& to, double share)
{
    const Vector3 way = normalized(direction_towards(from) * (1.0 - share) + direction_towards(to) * share);
    return {.azimuth = Angle::from_radians(std::atan2(way.x, way.y)),
            .altitude = Angle::from_radians(std::asin(std::clamp(way.z, -1.0, 1.0)))};
}

double hours_between(UtcTime from, UtcTime to)
{
    return std::chrono::duration<double, std::chrono::hours::period>(to - from).count();
}

void require_in_order(std::span<const SunSample> suns)
{
    const auto out_of_order = [](const SunSample& a, const SunSample& b) { return b.span.from < a.span.to; };
    if (std::ranges::adjacent_find(suns, out_of_order) != suns.end())
        throw InvalidInput("the stretches of the suns of a course must follow one another");
}

} // namespace

void add_sunlight(TerrainShadows& shadows, std::span<const SunSample> suns, SunSeconds& sum,
                  const Execution& execution)
{
    if (suns.empty())
        return;
    if (sum.rows() != shadows.mask().rows() || sum.columns() != shadows.mask().columns())
        throw InvalidInput("sums of sunlight must have the terrain's rows and columns");
    const UtcTime since = suns.front().span.from;
    cast_each(shadows, suns, execution, [&](std::size_t sun, std::size_t y, std::span<const Lit> lit) {
        add_where_lit(lit, whole_seconds(suns[sun].span, since), sum.row(y));
    });
}

SunCourse::SunCourse(const HeightField& field, std::vector<SunSample> suns, const Execution& execution)
    : field_(field), suns_(std::move(suns)), shadows_(field, execution),
      seconds_(field.rows(), field.columns(), 0U), first_(field.rows(), field.columns(), kNever),
      last_(field.rows(), field.columns(), kNever)
{
    if (suns_.size() >= kNever)
        throw InvalidInput("a course may have at most " + std::to_string(kNever - 1) + " suns, got "
                           + std::to_string(suns_.size()));
    require_in_order(suns_);
}

void SunCourse::cast(const Execution& execution)
{
    if (suns_.empty())
        return;
    const UtcTime since = suns_.front().span.from;
    cast_each(shadows_, suns_, execution, [&](std::size_t sun, std::size_t y, std::span<const Lit> lit) {
        add_where_lit(lit, whole_seconds(suns_[sun].span, since), seconds_.row(y));
        const auto first = first_.row(y);
        const auto last = last_.row(y);
        const auto now = static_cast<std::uint16_t>(sun);
        for (std::size_t x = 0; x < lit.size(); ++x) {
            first[x] = lit[x] == Lit::yes ? std::min(first[x], now) : first[x];
            last[x] = lit[x] == Lit::yes ? now : last[x];
        }
    });
}

// When a cell that is dark under one sun and lit under a neighbouring one changes.
UtcTime SunCourse::change_of_light(std::size_t row, std::size_t column, std::size_t dark, std::size_t lit,
                                   const TerrainRays& rays) const
{
    const GridPoint cell = {static_cast<double>(row), static_cast<double>(column),
                            static_cast<double>(field_.heights_m(row, column))};
    double dark_share = 0.0; // of the way from the dark sun to the lit one
    double lit_share = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = (dark_share + lit_share) / 2.0;
        const bool is_dark = rays.is_shadowed(cell, between(suns_[dark].light, suns_[lit].light, middle));
        (is_dark ? dark_share : lit_share) = middle;
    }
    const double share = (dark_share + lit_share) / 2.0;
    const microseconds way = suns_[lit].time - suns_[dark].time;
    return suns_[dark].time + microseconds(std::llround(share * static_cast<double>(way.count())));
}

// From first light to last; the cell is lit at some time.
TimeSpan SunCourse::light_of(std::size_t row, std::size_t column, const TerrainRays* rays) const
{
    const std::size_t first = first_(row, column);
    const std::size_t last = last_(row, column);
    TimeSpan light = {suns_[first].span.from, suns_[last].span.to};
    if (rays != nullptr && first > 0 && suns_[first - 1].span.to == light.from)
        light.from = change_of_light(row, column, first - 1, first, *rays);
    if (rays != nullptr && last + 1 < suns_.size() && suns_[last + 1].span.from == light.to)
        light.to = change_of_light(row, column, last + 1, last, *rays);
    return light;
}

SunTimes SunCourse::times(std::size_t first_row, std::size_t row_count, UtcTime origin,
                          const TerrainRays* rays, const Execution& execution) const
{
    if (first_row > field_.rows() || row_count > field_.rows() - first_row)
        throw InvalidInput("rows of a course must lie within its " + std::to_string(field_.rows()) + ", got "
                           + std::to_string(row_count) + " from " + std::to_string(first_row));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    SunTimes result = {{row_count, field_.columns(), nan},
                       {row_count, field_.columns(), nan},
                       {row_count, field_.columns(), nan}};
    const auto answer = [&](std::size_t y, std::size_t x) {
        const std::size_t row = first_row + y;
        if (std::isnan(field_.heights_m(row, x)))
            return;
        double hours = static_cast<double>(seconds_(row, x)) / 3600.0;
        if (first_(row, x) != kNever) {
            const TimeSpan light = light_of(row, x, rays);
            hours += hours_between(light.from, suns_[first_(row, x)].span.from)
                     + hours_between(suns_[last_(row, x)].span.to, light.to);
            result.first(y, x) = static_cast<float>(hours_between(origin, light.from));
            result.last(y, x) = static_cast<float>(hours_between(origin, light.to));
        }
        result.hours(y, x) = static_cast<float>(hours);
    };
    for_rows(row_count, 1, execution, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            for (std::size_t x = 0; x < field_.columns(); ++x)
                answer(y, x);
    });
    return result;
}

} // namespace duskline
