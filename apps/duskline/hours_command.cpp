#include "command.h"
#include "content_hash.h"
#include "date_options.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "hours_checkpoint.h"
#include "light_options.h"
#include "option_values.h"
#include "output_options.h"
#include "progress_bar.h"
#include "raster_site.h"
#include "raster_tags.h"
#include "report.h"
#include "run_options.h"
#include "stopwatch.h"

#include <duskline/light/day.h>
#include <duskline/products/sun_hours.h>
#include <duskline/raster_io/memory_need.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace duskline::cli {
namespace {

struct HoursOptions {
    InputOptions input;
    OutputOptions output;
    SunlightOptions sunlight;
    std::optional<CalendarDate> date;
    std::vector<CalendarDate> dates;
    std::optional<CalendarDate> from;
    std::optional<CalendarDate> to;
    std::optional<std::size_t> every;
    std::optional<std::chrono::minutes> utc_offset;
    double step_min = 5.0;
    Limb limb = Limb::upper;
    bool total = false;
    bool light_times = false;
    bool refine = false;
    bool resume = false;
    RunOptions run;
};

constexpr float kNoHours = -9999.0f;

// Heights, a mask, seconds; the first and last sun of a cell; the pyramid of the rays.
constexpr double kBytesPerCell = 9.0;
constexpr double kBytesPerCellLightTimes = 4.0;
constexpr double kBytesPerCellRays = 8.0 * 2.0 / 3.0;

// The days to cast, and how many days they stand for.
struct Days {
    std::vector<CalendarDate> cast;
    std::size_t period = 0;
};

// Everything there is to know once the options are settled.
struct HoursJob {
    const HoursOptions& options;
    HeightFile& file;
    EarthCurvature curvature;
    SunView view;
    Days days;
    ProgressBar& bar;

    std::chrono::minutes utc_offset() const { return options.utc_offset.value_or(std::chrono::minutes(0)); }
    UtcTime midnight(CalendarDate date) const { return std::chrono::sys_days(date) - utc_offset(); }
    Execution execution(double from, double to) const
    {
        return {.threads = options.run.threads, .progress = bar.part(from, to)};
    }
};

struct Outcome {
    std::size_t suns = 0;
    std::size_t data_cells = 0;
    double hours_sum = 0.0;
    float least = std::numeric_limits<float>::infinity();
    float most = -std::numeric_limits<float>::infinity();
    double reading_s = 0.0;
    double casting_s = 0.0;
    double writing_s = 0.0;
    double total_s = 0.0;
};

Days days_between(CalendarDate from, CalendarDate to, std::size_t every)
{
    if (to < from)
        throw UsageError(fmt::format("--to {} is before --from {}; give the earlier day first", in_words(to),
                                     in_words(from)));
    Days days;
    const auto first = std::chrono::sys_days(from);
    const auto last = std::chrono::sys_days(to);
    days.period = static_cast<std::size_t>((last - first).count()) + 1;
    for (std::size_t i = 0; i < days.period; i += every)
        days.cast.emplace_back(first + std::chrono::days(i));
    return days;
}

Days choose_days(const HoursOptions& options)
{
    const bool between = options.from || options.to;
    const int given = (options.date ? 1 : 0) + (options.dates.empty() ? 0 : 1) + (between ? 1 : 0);
    if (given != 1)
        throw UsageError(
            "give the days in one way: --date 2026-06-21, --dates 2026-06-21,2026-12-21, or --from "
            "2026-01-01 --to 2026-12-31");
    if (between && !(options.from && options.to))
        throw UsageError("--from and --to need each other");
    if (options.every && !between)
        throw UsageError("--every is of the days between --from and --to");
    if (between)
        return days_between(*options.from, *options.to, options.every.value_or(1));
    Days days;
    days.cast = options.date ? std::vector{*options.date} : options.dates;
    days.period = days.cast.size();
    return days;
}

void require_possible(const HoursOptions& options, const Days& days)
{
    if (options.refine && !options.light_times)
        throw UsageError("--refine is of first and last light: give --light-times too");
    if (options.light_times && days.cast.size() != 1)
        throw UsageError(
            fmt::format("--light-times is of one day: give one --date, not {}", days.cast.size()));
}

std::chrono::microseconds step_of(const HoursOptions& options)
{
    return std::chrono::microseconds(std::llround(options.step_min * 60.0e6));
}

std::vector<SunSample> suns_of(const HoursJob& job, CalendarDate date)
{
    const SunDay day = sun_day(date, job.utc_offset(), job.view.place, job.view.options);
    return sample_sun(day.midnights, job.view, step_of(job.options));
}

// What to multiply hours over all days cast with.
double weight_of(const HoursJob& job)
{
    const double cast = static_cast<double>(job.days.cast.size());
    return job.options.total ? static_cast<double>(job.days.period) / cast : 1.0 / cast;
}

const char* name_of(Limb limb)
{
    switch (limb) {
    case Limb::centre:
        return "centre";
    case Limb::lower:
        return "lower";
    case Limb::upper:
        break;
    }
    return "upper";
}

Limb limb_named(const std::string& name)
{
    for (const Limb limb : {Limb::upper, Limb::centre, Limb::lower})
        if (name == name_of(limb))
            return limb;
    throw UsageError(fmt::format("--limb must be upper, centre or lower, got '{}'", name));
}

// All that the sums of a job depend on, for its checkpoint.
nlohmann::ordered_json identity_of(const HoursJob& job, const Terrain& terrain)
{
    nlohmann::ordered_json days = nlohmann::ordered_json::array();
    for (const CalendarDate date : job.days.cast)
        days.push_back(in_words(date));
    return {{"format", "duskline hours 1"},
            {"byte_order", std::endian::native == std::endian::little ? "little" : "big"},
            {"rows", terrain.heights_m.rows()},
            {"columns", terrain.heights_m.columns()},
            {"cell_size_m", {terrain.cell_size_m.x, terrain.cell_size_m.y}},
            {"heights", content_hash(std::as_const(terrain.heights_m).values())},
            {"place_deg", {job.view.place.longitude.degrees(), job.view.place.latitude.degrees()}},
            {"grid_north_deg", job.view.true_to_grid_north.degrees()},
            {"pressure_mbar", job.options.sunlight.air.pressure_mbar},
            {"temperature_c", job.options.sunlight.air.temperature_c},
            {"limb", name_of(job.view.limb)},
            {"step_us", step_of(job.options).count()},
            {"utc_offset_min", job.utc_offset().count()},
            {"days", days}};
}

void include(Outcome& outcome, std::span<const float> hours)
{
    for (const float value : hours) {
        if (std::isnan(value))
            continue;
        ++outcome.data_cells;
        outcome.hours_sum += static_cast<double>(value);
        outcome.least = std::min(outcome.least, value);
        outcome.most = std::max(outcome.most, value);
    }
}

void write_without_nan(RasterWriter& writer, std::size_t band, std::size_t first_row, Grid<float>& values)
{
    std::ranges::replace_if(
        values.values(), [](float value) { return std::isnan(value); }, kNoHours);
    writer.write_band(band, first_row, 0, std::as_const(values).view());
}

// Writes rows in bands; `make(first, rows)` gives the grids of them, hours first.
template <typename Make>
void write_rows(const HoursJob& job, RasterWriter& writer, Outcome& outcome, const Make& make)
{
    const Stopwatch watch(outcome.writing_s);
    const ProgressCallback progress = job.bar.part(0.85, 0.97);
    const std::size_t at_once = std::max<std::size_t>(writer.block_rows(), 64);
    for (std::size_t first = 0; first < job.file.rows(); first += at_once) {
        const std::size_t rows = std::min(at_once, job.file.rows() - first);
        auto grids = make(first, rows);
        include(outcome, grids.front().values());
        for (std::size_t band = 0; band < grids.size(); ++band)
            write_without_nan(writer, band, first, grids[band]);
        if (!progress(static_cast<double>(first + rows) / static_cast<double>(job.file.rows())))
            throw Cancelled();
    }
}

// Hours of all days, and for one day first and last light.
void cast_light_times(const HoursJob& job, const Terrain& terrain, RasterWriter& writer, Outcome& outcome)
{
    const CalendarDate date = job.days.cast.front();
    std::optional<TerrainRays> rays;
    std::optional<SunCourse> course;
    {
        const Stopwatch watch(outcome.casting_s);
        if (job.options.refine)
            rays.emplace(terrain, job.execution(0.1, 0.15));
        std::vector<SunSample> suns = suns_of(job, date);
        outcome.suns = suns.size();
        course.emplace(terrain, std::move(suns), job.execution(0.15, 0.2));
        course->cast(job.execution(0.2, job.options.refine ? 0.4 : 0.85));
    }
    const Execution quiet = {.threads = job.options.run.threads};
    write_rows(job, writer, outcome, [&](std::size_t first, std::size_t rows) {
        SunTimes times = course->times(first, rows, job.midnight(date), rays ? &*rays : nullptr, quiet);
        std::vector<Grid<float>> grids;
        grids.push_back(std::move(times.hours));
        grids.push_back(std::move(times.first));
        grids.push_back(std::move(times.last));
        return grids;
    });
}

// Casts the days that are not done yet, and keeps a checkpoint of them on request.
void sum_days(const HoursJob& job, const Terrain& terrain, const std::optional<HoursCheckpoint>& checkpoint,
              SunSeconds& seconds, Outcome& outcome, Report& report)
{
    const Stopwatch watch(outcome.casting_s);
    std::size_t done = checkpoint ? checkpoint->load(seconds) : 0;
    if (done > 0)
        report.note(fmt::format("{} of {} days were done before", done, job.days.cast.size()));
    report.field("days_resumed", done);
    TerrainShadows shadows(terrain, job.execution(0.1, 0.1));
    const std::size_t days = job.days.cast.size();
    const auto place_of = [days](std::size_t day) {
        return 0.1 + 0.75 * static_cast<double>(day) / static_cast<double>(days);
    };
    try {
        while (done < days) {
            const std::vector<SunSample> suns = suns_of(job, job.days.cast[done]);
            add_sunlight(shadows, suns, seconds, job.execution(place_of(done), place_of(done + 1)));
            outcome.suns += suns.size();
            ++done;
            if (checkpoint && done < days)
                checkpoint->save(done, seconds);
            if (!job.bar.part(0.0, 1.0)(place_of(done)))
                throw Cancelled();
        }
    } catch (const Cancelled&) {
        if (checkpoint && done > 0)
            report.warn(fmt::format("'{}' keeps {} of {} days; the same command goes on from there",
                                    checkpoint->path(), std::min(done, days - 1), days));
        throw;
    }
}

void cast_sums(const HoursJob& job, const Terrain& terrain, RasterWriter& writer, Outcome& outcome,
               const std::optional<HoursCheckpoint>& checkpoint, Report& report)
{
    SunSeconds seconds(terrain.heights_m.rows(), terrain.heights_m.columns(), 0U);
    sum_days(job, terrain, checkpoint, seconds, outcome, report);
    const double hours_per_second = weight_of(job) / 3600.0;
    write_rows(job, writer, outcome, [&](std::size_t first, std::size_t rows) {
        std::vector<Grid<float>> grids;
        Grid<float>& hours = grids.emplace_back(rows, seconds.columns());
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < seconds.columns(); ++x)
                hours(y, x) = std::isnan(terrain.heights_m(first + y, x))
                                  ? std::numeric_limits<float>::quiet_NaN()
                                  : static_cast<float>(hours_per_second * seconds(first + y, x));
        return grids;
    });
}

std::string days_in_words(const HoursJob& job)
{
    const auto& cast = job.days.cast;
    if (cast.size() == 1)
        return in_words(cast.front());
    return fmt::format("{} days from {} to {}", cast.size(), in_words(cast.front()), in_words(cast.back()));
}

RasterContent content_of(const HoursJob& job, const Report& report)
{
    const std::string clock = job.utc_offset() == std::chrono::minutes(0)
                                  ? "UTC"
                                  : "UTC" + to_iso8601({UtcTime(), job.utc_offset()}).substr(19);
    RasterContent content;
    content.samples = Samples::real;
    content.no_data = static_cast<double>(kNoHours);
    content.bands.push_back(
        {fmt::format("hours of sun{}, {}", job.options.total ? " in all" : " a day", days_in_words(job)),
         "h",
         {}});
    if (job.options.light_times)
        for (const char* which : {"first", "last"})
            content.bands.push_back({fmt::format("{} light, hours after 00:00 of {} by {}", which,
                                                 in_words(job.days.cast.front()), clock),
                                     "h",
                                     {}});
    add_tag(content.tags, "SOFTWARE", "duskline " DUSKLINE_VERSION);
    add_tag(content.tags, "SUN_PLACE", in_words(job.view.place));
    add_tag(content.tags, "SUN_LIMB", name_of(job.view.limb));
    add_tag(content.tags, "SUN_DAYS", days_in_words(job));
    add_tag(content.tags, "SUN_STEP_MIN", fmt::format("{:g}", job.options.step_min));
    add_tag(content.tags, "ENCODING", "hours; -9999 no data, and no light for times of light");
    add_height_tags(content.tags, job.file, job.curvature);
    add_assumptions(content.tags, report);
    return content;
}

void report_outcome(const HoursJob& job, const Outcome& outcome, Report& report)
{
    const std::string& path = job.options.output.path;
    const double mean =
        outcome.data_cells == 0 ? 0.0 : outcome.hours_sum / static_cast<double>(outcome.data_cells);
    const bool any = outcome.data_cells > 0;
    const double least = any ? static_cast<double>(outcome.least) : 0.0;
    const double most = any ? static_cast<double>(outcome.most) : 0.0;
    report.line(fmt::format("{}: {:.2f} h of sun{} on average, {:.2f} to {:.2f} h; {}, {} suns", path, mean,
                            job.options.total ? " in all" : " a day", least, most, days_in_words(job),
                            outcome.suns));
    report.field("output", path);
    report.field("days", job.days.cast.size());
    report.field("period_days", job.days.period);
    report.field("suns", outcome.suns);
    report.field("cells", job.file.rows() * job.file.columns());
    report.field("no_data", job.file.rows() * job.file.columns() - outcome.data_cells);
    report.field("hours_mean", mean);
    report.field("hours_least", least);
    report.field("hours_most", most);
    report.field("latitude_deg", job.view.place.latitude.degrees());
    report.field("longitude_deg", job.view.place.longitude.degrees());
    report.field("limb", name_of(job.view.limb));
    report.json()["seconds"] = {{"reading", outcome.reading_s},
                                {"casting", outcome.casting_s},
                                {"writing", outcome.writing_s},
                                {"total", outcome.total_s}};
}

void require_memory_for(const HoursJob& job)
{
    require_memory(job.file.rows(), job.file.columns(),
                   kBytesPerCell + (job.options.light_times ? kBytesPerCellLightTimes : 0.0)
                       + (job.options.refine ? kBytesPerCellRays : 0.0),
                   "'" + job.file.facts().path + "'");
}

void cast(const HoursJob& job, Outcome& outcome, Report& report)
{
    RasterWriter writer(job.options.output.path, job.file, content_of(job, report),
                        write_options(job.options.output, job.options.run));
    Terrain terrain;
    {
        const Stopwatch watch(outcome.reading_s);
        terrain = read_lowered_terrain(job.file, job.curvature, job.execution(0.0, 0.1));
    }
    report_reading(job.file, report);
    std::optional<HoursCheckpoint> checkpoint;
    if (job.options.resume)
        checkpoint.emplace(job.options.output.path, identity_of(job, terrain));
    if (job.options.light_times)
        cast_light_times(job, terrain, writer, outcome);
    else
        cast_sums(job, terrain, writer, outcome, checkpoint, report);
    const Stopwatch watch(outcome.writing_s);
    writer.finish(job.bar.part(0.97, 1.0));
    job.bar.part(0.97, 1.0)(1.0);
    if (checkpoint)
        checkpoint->remove();
}

void run_hours(const HoursOptions& options)
{
    Outcome outcome;
    Report report("hours", options.run);
    ProgressBar bar(options.run);
    Days days = choose_days(options);
    require_possible(options, days);
    HeightFile file = open_heights(options.input, options.run, report);
    const EarthCurvature curvature = choose_curvature(options.input, file, report);
    const SunView view = choose_sun_view(options.sunlight, light_site(file.ground()), options.limb, report);
    const HoursJob job = {options, file, curvature, view, std::move(days), bar};
    require_memory_for(job);
    {
        const Stopwatch total(outcome.total_s);
        cast(job, outcome, report);
    }
    if (outcome.suns == 0 && report.json().value("days_resumed", 0) == 0)
        report.warn(fmt::format("the sun does not rise over {} on {}: no cell has any",
                                in_words(job.view.place), days_in_words(job)));
    report_outcome(job, outcome, report);
    report.finish();
}

void add_days(CLI::App& app, HoursOptions& options)
{
    add_date_option(app, "--date", "the sun of this day: 2026-06-21", options.date);
    add_dates_option(app, "--dates", "of these days, parted by commas", options.dates);
    add_date_option(app, "--from", "of all days from this one on", options.from);
    add_date_option(app, "--to", "to this one, which counts as well", options.to);
    app.add_option_function<std::string>(
           "--every",
           [&options](const std::string& typed) { options.every = parse_count("--every", typed, 1); },
           "cast one day in N between --from and --to, which stands for the others")
        ->type_name("N")
        ->default_str("1")
        ->group("Light");
    add_utc_offset_option(app, "of the clock that dates and times are told by: -10:00; else UTC",
                          options.utc_offset);
    add_number(app,
               {.names = "--step",
                .unit = "MIN",
                .text = "longest time between two suns, minutes; a tenth of it where the sun is lowest",
                .range = {.least = 0.0, .most = 120.0, .above = true}},
               options.step_min)
        ->group("Light");
    app.add_option_function<std::string>(
           "--limb", [&options](const std::string& typed) { options.limb = limb_named(typed); },
           "how much of the disc must be seen to count as sun: upper (any of it, as almanacs have it), "
           "centre "
           "(half), lower (all)")
        ->type_name("NAME")
        ->default_str("upper")
        ->group("Light");
}

void add_results(CLI::App& app, HoursOptions& options)
{
    app.add_flag("--total", options.total,
                 "write hours in all, over all days of the period; else the mean of a day")
        ->group("Output");
    app.add_flag("--light-times", options.light_times,
                 "write first and last light too, bands 2 and 3: hours after 00:00 of --date by the clock of "
                 "--utc-offset")
        ->group("Output");
    app.add_flag("--refine", options.refine,
                 "find first and last light by rays, to 1/64 of the time between two suns; slow")
        ->group("Output");
    app.add_flag(
           "--resume", options.resume,
           "keep the sums beside OUTPUT (OUTPUT.checkpoint) after each day, and go on from there when the "
           "same command is given again")
        ->group("Running");
}

} // namespace

Run declare_hours(CLI::App& app)
{
    const auto options = std::make_shared<HoursOptions>();
    add_input_options(app, options->input);
    add_output_options(app, options->output);
    add_days(app, *options);
    add_sun_view_options(app, options->sunlight);
    add_results(app, *options);
    add_run_options(app, options->run);
    add_details(
        app, "OUTPUT has the grid of INPUT and says how many hours a day the sun shines on each cell, -9999 "
             "where there is no data. Shadows are those of the caster exact. A day is the one whose solar "
             "noon is nearest to 12:00 of the date; flat ground has the almanac's day length.\n\n"
             "Memory: 9 bytes a cell, 13 with --light-times, 18.4 with --refine.");
    add_example(app, "the longest day, with first and last light by Hawaii's clock",
                "duskline hours dem.tif june.tif --date 2026-06-21 --utc-offset -10:00 --light-times");
    add_example(app, "the mean day of a year, from one day a week, resumable",
                "duskline hours dem.tif year.tif --from 2026-01-01 --to 2026-12-31 --every 7 --resume");
    return [options] { run_hours(*options); };
}

} // namespace duskline::cli
