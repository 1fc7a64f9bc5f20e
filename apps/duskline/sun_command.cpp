#include "command.h"
#include "date_options.h"
#include "exit_code.h"
#include "help_page.h"
#include "light_options.h"
#include "raster_site.h"
#include "report.h"
#include "run_options.h"

#include <duskline/light/day.h>
#include <duskline/raster_io/read_height_field.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace duskline::cli {
namespace {

struct SunCommandOptions {
    std::string raster; // empty: none
    std::vector<std::string> open_options;
    SunlightOptions sunlight;
    std::optional<CalendarDate> date;
    std::optional<std::chrono::minutes> utc_offset;
    RunOptions run;
};

void add_raster(CLI::App& app, SunCommandOptions& options)
{
    app.add_option("INPUT", options.raster,
                   "elevation model whose centre is the place, and whose north counts");
    app.add_option("--oo", options.open_options, "open option of the input's GDAL driver; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group("Input");
}

void add_date(CLI::App& app, SunCommandOptions& options)
{
    add_date_option(app, "--date", "only sunrise, noon and sunset of this day: 2026-06-21", options.date);
    add_utc_offset_option(app, "of the clock that times are told by: -10:00; else that of --time, else UTC",
                          options.utc_offset);
}

std::string name_of(SunDayKind kind)
{
    switch (kind) {
    case SunDayKind::polar_day:
        return "polar_day";
    case SunDayKind::polar_night:
        return "polar_night";
    case SunDayKind::rises_or_sets:
        break;
    }
    return "rises_or_sets";
}

// Where the sun is at one moment, for a place and, with a raster, its grid.
void report_position(const ChosenLight& chosen, const std::string& raster, Report& report)
{
    const SunPosition& sun = *chosen.sun;
    report.line(
        fmt::format("azimuth     {:10.4f}  degrees clockwise from true north", sun.azimuth.degrees()));
    if (!raster.empty())
        report.line(fmt::format("            {:10.4f}  degrees clockwise from the north of {}",
                                chosen.light.azimuth.degrees(), raster));
    report.line(fmt::format("altitude    {:10.4f}  degrees above the horizontal, {:.4f} of it refraction",
                            sun.apparent_altitude().degrees(), sun.refraction.degrees()));
    report.line(fmt::format("disc        {:10.4f}  degrees across", sun.angular_diameter.degrees()));
    report.field("time", to_iso8601(*chosen.time));
    report.field("time_utc", to_iso8601({chosen.time->utc}));
    report.field("azimuth_deg", sun.azimuth.degrees());
    if (!raster.empty())
        report.field("grid_azimuth_deg", chosen.light.azimuth.degrees());
    report.field("altitude_deg", sun.apparent_altitude().degrees());
    report.field("geometric_altitude_deg", sun.geometric_altitude.degrees());
    report.field("refraction_deg", sun.refraction.degrees());
    report.field("angular_diameter_deg", sun.angular_diameter.degrees());
    report.field("distance_au", sun.distance_au);
    report.field("equation_of_time_min", equation_of_time_min(chosen.time->utc));
}

// A crossing of the horizon with where it happens.
void report_crossing(const std::string& name, const std::optional<UtcTime>& time, const Place& place,
                     std::chrono::minutes utc_offset, Report& report, nlohmann::ordered_json& day)
{
    if (!time) {
        day[name] = nullptr;
        return;
    }
    const double azimuth = sun_position(*time, place).azimuth.degrees();
    const std::string text = to_iso8601({*time, utc_offset});
    report.line(fmt::format("{:<11} {}  azimuth {:.1f}", name, text, azimuth));
    day[name] = text;
    day[name + "_azimuth_deg"] = azimuth;
}

void report_day(const SunDay& sun, const Place& place, std::chrono::minutes utc_offset, Report& report)
{
    nlohmann::ordered_json day;
    day["kind"] = name_of(sun.kind);
    report_crossing("sunrise", sun.sunrise, place, utc_offset, report, day);
    const std::string noon = to_iso8601({sun.noon, utc_offset});
    report.line(fmt::format("noon        {}  altitude {:.1f}", noon, sun.noon_altitude.degrees()));
    day["noon"] = noon;
    day["noon_altitude_deg"] = sun.noon_altitude.degrees();
    report_crossing("sunset", sun.sunset, place, utc_offset, report, day);
    const auto minutes = std::chrono::round<std::chrono::minutes>(sun.daylight).count();
    const char* remark = sun.kind == SunDayKind::polar_day     ? "  (polar day: the sun does not set)"
                         : sun.kind == SunDayKind::polar_night ? "  (polar night: the sun does not rise)"
                                                               : "";
    report.line(fmt::format("daylight    {} h {:02} min{}", minutes / 60, minutes % 60, remark));
    day["daylight_s"] = std::chrono::duration<double>(sun.daylight).count();
    report.field("day", day);
}

void require_time_or_date(const SunCommandOptions& options)
{
    if (options.sunlight.time && options.date)
        throw UsageError("give --time or --date, not both");
    if (!options.sunlight.time && !options.date)
        throw UsageError("give --time such as 2026-06-21T18:30-10:00, or --date such as 2026-06-21");
}

LightSite site_of(const SunCommandOptions& options, Report& report)
{
    if (options.raster.empty() && !options.sunlight.at)
        throw UsageError(
            "give the place the sun is seen from: --at LON,LAT such as -155.47,19.82, or a raster");
    if (options.raster.empty())
        return {};
    const HeightFile file(options.raster, {.open_options = options.open_options});
    report.field("input", options.raster);
    return light_site(file.ground());
}

void run_sun(const SunCommandOptions& options)
{
    require_time_or_date(options);
    Report report("sun", options.run);
    const LightSite site = site_of(options, report);
    SunlightOptions sunlight = options.sunlight;
    sunlight.at = choose_place(options.sunlight, site, report);
    const Place& place = *sunlight.at;
    report.field("longitude_deg", place.longitude.degrees());
    report.field("latitude_deg", place.latitude.degrees());

    const DateTime time = options.sunlight.time.value_or(DateTime{});
    const std::chrono::minutes utc_offset = options.utc_offset.value_or(time.utc_offset);
    if (options.sunlight.time) {
        report.line(fmt::format("{} seen from {}", to_iso8601({time.utc, utc_offset}), in_words(place)));
        report_position(choose_light({.sun = sunlight}, site, report), options.raster, report);
    } else {
        report.line(fmt::format("The day seen from {}", in_words(place)));
    }
    const CalendarDate date = options.date.value_or(local_date({time.utc, utc_offset}));
    report_day(sun_day(date, utc_offset, place), place, utc_offset, report);
    report.finish();
}

} // namespace

Run declare_sun(CLI::App& app)
{
    const auto options = std::make_shared<SunCommandOptions>();
    add_details(
        app,
        "Prints the sun's direction at a moment, and when it rises, stands highest and sets that day over "
        "an open horizon: upper limb, usual refraction, 0.8333 degrees below the horizontal.");
    add_raster(app, *options);
    add_sunlight_options(app, options->sunlight);
    add_date(app, *options);
    add_report_options(app, options->run);
    add_example(app, "the sun over Mauna Kea on a summer evening",
                "duskline sun --time 2026-06-21T18:30-10:00 --at -155.47,19.82");
    add_example(app, "the same from the centre of a raster, with the azimuth in its grid",
                "duskline sun dem.tif --time 2026-06-21T18:30-10:00");
    add_example(app, "when it rises and sets there, by the clock of Hawaii",
                "duskline sun --date 2026-06-21 --utc-offset -10:00 --at -155.47,19.82");
    return [options] { run_sun(*options); };
}

} // namespace duskline::cli
