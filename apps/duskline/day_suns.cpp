#include "day_suns.h"

#include "date_options.h"
#include "exit_code.h"
#include "option_values.h"
#include "raster_site.h"

#include <duskline/light/day.h>
#include <duskline/products/day_cycle.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Light";
constexpr std::size_t kMostMaps = 9999;

TimeSpan daylight_of(const DaySunOptions& options, const SunView& view)
{
    const SunDay day = sun_day(*options.date, options.utc_offset.value_or(std::chrono::minutes(0)),
                               view.place, view.options);
    const std::vector<TimeSpan> spans = daylight_spans(day.midnights, view);
    if (spans.empty())
        throw UsageError(fmt::format("the sun does not rise over {} on {}: choose another day, or times by "
                                     "--from and --to",
                                     in_words(view.place), in_words(*options.date)));
    return {spans.front().from, spans.back().to};
}

ChosenLight light_at(UtcTime time, const DaySuns& day)
{
    ChosenLight chosen;
    chosen.time = DateTime{time, day.utc_offset};
    chosen.place = day.view.place;
    chosen.sun = sun_position(time, day.view.place, day.view.options);
    chosen.light = sunlight(*chosen.sun, day.view.true_to_grid_north);
    return chosen;
}

bool is_up(const ChosenLight& chosen, bool soft)
{
    const double radius_deg = soft ? chosen.light.angular_diameter.degrees() / 2.0 : 0.0;
    return chosen.light.altitude.degrees() + radius_deg > 0.0;
}

void require_some_sun(const DaySuns& day, bool soft, Report& report)
{
    const auto up = std::ranges::count_if(day.suns, [&](const auto& sun) { return is_up(sun, soft); });
    if (up == 0)
        throw UsageError(fmt::format("the sun is down at all {} times from {} to {}", day.suns.size(),
                                     to_iso8601({day.span.from, day.utc_offset}),
                                     to_iso8601({day.span.to, day.utc_offset})));
    const std::size_t down = day.suns.size() - static_cast<std::size_t>(up);
    if (down > 0)
        report.warn(fmt::format("the sun is down at {} of {} times: those maps have no sunlight", down,
                                day.suns.size()));
}

} // namespace

void add_day_sun_options(CLI::App& app, DaySunOptions& options)
{
    add_date_option(app, "--date", "spread maps over the daylight of this day: 2026-06-21", options.date);
    add_time_option(app, "--from", "or from this time, 2026-06-21T06:00-10:00, which has the first map,",
                    options.from);
    add_time_option(app, "--to", "to this one, which has the last", options.to);
    app.add_option_function<std::string>(
           "-n,--maps",
           [&options](const std::string& typed) {
               options.maps = parse_count("--maps", typed, 1);
               if (options.maps > kMostMaps)
                   throw UsageError(
                       fmt::format("--maps must be at most {}, got {}", kMostMaps, options.maps));
           },
           "how many maps, in even steps of time")
        ->type_name("N")
        ->default_str("24")
        ->group(kGroup);
    add_utc_offset_option(app, "of the clock that times are told by: -10:00; else that of --from, else UTC",
                          options.utc_offset);
    add_sun_view_options(app, options.sunlight);
}

void require_possible(const DaySunOptions& options)
{
    const bool between = options.from || options.to;
    if (options.date && between)
        throw UsageError("give --date, or --from and --to, not both");
    if (!options.date && !between)
        throw UsageError("give the day: --date 2026-06-21, or --from 2026-06-21T06:00-10:00 --to "
                         "2026-06-21T19:00-10:00");
    if (between && !(options.from && options.to))
        throw UsageError("--from and --to need each other");
    if (between && !(options.to->utc > options.from->utc))
        throw UsageError(fmt::format("--to {} is not after --from {}", to_iso8601(*options.to),
                                     to_iso8601(*options.from)));
    if (between && options.maps < 2)
        throw UsageError("--maps must be at least 2 between two times, which have a map each; for one moment "
                         "there is duskline shadow --time");
}

DaySuns choose_day_suns(const DaySunOptions& options, bool soft, const HeightFile& file, Report& report)
{
    DaySuns day;
    day.view = choose_sun_view(options.sunlight, light_site(file.ground()), soft ? Limb::upper : Limb::centre,
                               report);
    day.dark_outside = options.date.has_value();
    day.utc_offset =
        options.utc_offset.value_or(options.from ? options.from->utc_offset : std::chrono::minutes(0));
    day.span = options.date ? daylight_of(options, day.view) : TimeSpan{options.from->utc, options.to->utc};
    for (const UtcTime time :
         evenly_spread(day.span, options.maps, options.date ? Spread::middles : Spread::ends))
        day.suns.push_back(light_at(time, day));
    require_some_sun(day, soft, report);
    return day;
}

} // namespace duskline::cli
