#include <duskline/casting/casters.h>
#include <duskline/casting/visible_fraction.h>
#include <duskline/execution/for_rows.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/products/day_cycle.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kRowsAtOnce = 64;

template <typename From, typename ToByte>
Grid<std::uint8_t> bytes_of(const Grid<From>& values, const Execution& execution, const ToByte& to_byte)
{
    Grid<std::uint8_t> bytes(values.rows(), values.columns());
    for_rows(values.rows(), kRowsAtOnce, {.threads = execution.threads, .progress = {}},
             [&](std::size_t first, std::size_t last) {
                 for (std::size_t y = first; y < last; ++y)
                     std::ranges::transform(values.row(y), bytes.row(y).begin(), to_byte);
             });
    return bytes;
}

} // namespace

std::vector<UtcTime> evenly_spread(const TimeSpan& span, std::size_t count, Spread spread)
{
    const std::size_t least = spread == Spread::ends ? 2 : 1;
    if (count < least)
        throw InvalidInput("at least " + std::to_string(least) + " moments can be spread over this span, got "
                           + std::to_string(count));
    if (!(span.to > span.from))
        throw InvalidInput("moments can be spread over a span of time only that ends after it begins");
    const auto steps = static_cast<double>(spread == Spread::ends ? count - 1 : count);
    const double offset = spread == Spread::ends ? 0.0 : 0.5;
    std::vector<UtcTime> times;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = (static_cast<double>(i) + offset) / steps;
        times.push_back(
            span.from
            + std::chrono::microseconds(std::llround(share * static_cast<double>(span.length().count()))));
    }
    return times;
}

Blend blend_at(std::span<const UtcTime> times, UtcTime now)
{
    if (times.empty())
        throw InvalidInput("there are no maps to blend");
    const auto after = std::ranges::upper_bound(times, now);
    if (after == times.begin())
        return {0, 0, 0.0};
    const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end())
        return {first, first, 0.0};
    const std::chrono::duration<double> since = now - times[first];
    const std::chrono::duration<double> step = *after - times[first];
    return {first, first + 1, since / step};
}

DayMaps::DayMaps(const HeightField& field, NormalField normals, const DayMapOptions& options,
                 const Execution& execution)
    : field_(field), normals_(std::move(normals)), options_(options), shadows_(field, execution)
{
    const bool fits = normals_.rows() == field.rows() && normals_.columns() == field.columns();
    if (options_.light && !fits)
        throw InvalidInput("normals must have the terrain's rows and columns");
    if (!(options_.model.ambient >= 0.0 && options_.model.ambient <= 1.0))
        throw InvalidInput("ambient light of day maps must be from 0 to 1, got "
                           + std::to_string(options_.model.ambient));
}

Grid<std::uint8_t> DayMaps::map(const DirectionalLight& sun, const Execution& execution)
{
    return options_.light ? lit_map(sun, execution) : shadow_map(sun, execution);
}

Grid<std::uint8_t> DayMaps::shadow_map(const DirectionalLight& sun, const Execution& execution)
{
    if (options_.soft)
        return bytes_of(visible_fraction(field_, sun, caster_named("exact"), execution), execution,
                        light_sample<std::uint8_t>);
    return bytes_of(shadows_.cast(sun, execution), execution, [](Lit lit) {
        constexpr std::uint8_t light = 255;
        constexpr std::uint8_t shadow = 0;
        return lit == Lit::yes ? light : lit == Lit::no ? shadow : kNoDataInShadowMap;
    });
}

Grid<std::uint8_t> DayMaps::lit_map(const DirectionalLight& sun, const Execution& execution)
{
    VisibleFraction seen;
    MapLight light = {.source = sun, .strength = 1.0 - options_.model.ambient};
    if (options_.soft) {
        seen = visible_fraction(field_, sun, caster_named("exact"), execution);
        light.lit = GridView<const float>(seen.view());
    } else {
        light.lit = shadows_.cast(sun, execution).view();
    }
    const LightMap map = light_map(field_, normals_, {&light, 1}, options_.model,
                                   {.threads = execution.threads, .progress = {}});
    return bytes_of(map.channels.front(), execution, light_sample<std::uint8_t>);
}

} // namespace duskline
