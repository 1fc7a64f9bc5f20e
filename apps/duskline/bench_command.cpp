#include "caster_bench.h"
#include "command.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "lamp_options.h"
#include "light_options.h"
#include "option_values.h"
#include "progress_bar.h"
#include "raster_site.h"
#include "report.h"
#include "run_options.h"

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/lamps.h>
#include <duskline/execution/for_rows.h>
#include <duskline/raster_io/memory_need.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace duskline::cli {
namespace {

struct BenchOptions {
    InputOptions input;
    LightOptions light;
    LampOptions lamps;
    std::string casters; // empty: the usual ones
    std::optional<std::size_t> runs;
    RunOptions run;
};

// Rasters of more cells have the plain ray only when asked: it takes seconds for 2048 x 2048, in a low sun a minute.
constexpr std::size_t kMostCellsForRay = 1'000'000;

// Heights and their copy, two masks, and what a caster takes at most.
constexpr double kBytesPerCell =
    2.0 * sizeof(float) + 2.0 + std::ranges::max(kCasters, {}, &Caster::bytes_per_cell).bytes_per_cell;

// The casters of "exact,sweep", each once.
std::vector<const Caster*> casters_named(std::string_view names)
{
    std::vector<const Caster*> casters;
    for (std::size_t from = 0; from <= names.size();) {
        const std::size_t comma = std::min(names.find(',', from), names.size());
        const Caster* caster = &caster_named(names.substr(from, comma - from));
        if (std::ranges::find(casters, caster) == casters.end())
            casters.push_back(caster);
        from = comma + 1;
    }
    return casters;
}

bool leaves_out_ray(std::size_t cells)
{
    return cells > kMostCellsForRay;
}

std::vector<const Caster*> usual_casters(std::size_t cells, bool for_lamp)
{
    std::vector<const Caster*> casters;
    for (const Caster& caster : kCasters)
        if ((caster.name != "ray" || !leaves_out_ray(cells)) && (!for_lamp || caster.cast_lamp != nullptr))
            casters.push_back(&caster);
    return casters;
}

// Three digits, and all before the point.
std::string in_digits(double number)
{
    return fmt::format("{:.{}f}", number, number < 9.995 ? 2 : number < 99.95 ? 1 : 0);
}

double share(std::size_t part, std::size_t all)
{
    return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

template <typename Number>
nlohmann::ordered_json or_null(const std::optional<Number>& number)
{
    return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

nlohmann::ordered_json as_json(const CasterBench& bench, double memcpy_s)
{
    const MaskDifference& difference = bench.difference;
    const double median_s = bench.times.median_s();
    return {{"name", bench.caster->name},
            {"runs", bench.times.count()},
            {"median_ms", 1e3 * median_s},
            {"best_ms", 1e3 * bench.times.best_s()},
            {"cells_per_s", static_cast<double>(difference.cells) / median_s},
            {"times_memcpy", median_s / memcpy_s},
            {"differing", difference.differing},
            {"differing_share", share(difference.differing, difference.cells)},
            {"false_light", difference.false_light},
            {"false_shadow", difference.false_shadow},
            {"beside_edge", difference.beside_edge},
            {"farthest_from_edge_cells", or_null(difference.farthest_from_edge)},
            {"peak_bytes", or_null(bench.peak_bytes)}};
}

std::size_t longest_name()
{
    std::size_t longest = 0;
    for (const Caster& caster : kCasters)
        longest = std::max(longest, caster.name.size());
    return longest;
}

std::string as_row(const CasterBench& bench, double memcpy_s)
{
    const MaskDifference& difference = bench.difference;
    const double median_s = bench.times.median_s();
    return fmt::format("{:<{}} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>5}", bench.caster->name,
                       longest_name(), in_digits(1e3 * median_s), in_digits(1e3 * bench.times.best_s()),
                       in_digits(static_cast<double>(difference.cells) / median_s / 1e6),
                       in_digits(median_s / memcpy_s), difference.differing,
                       fmt::format("{:.4f} %", 100.0 * share(difference.differing, difference.cells)),
                       difference.farthest_from_edge ? fmt::to_string(*difference.farthest_from_edge) : "-",
                       bench.peak_bytes ? in_digits(static_cast<double>(*bench.peak_bytes) / 0x1p20) : "-",
                       bench.times.count());
}

// The light, and how it is spoken of.
struct Asked {
    BenchLight light;
    std::string in_words;
    nlohmann::ordered_json fields;
};

Asked ask_sun(const ChosenLight& chosen, const HeightFile& file)
{
    const double azimuth_deg = wrapped_to_circle(chosen.light.azimuth + file.ground().grid_north).degrees();
    const double altitude_deg = chosen.light.altitude.degrees();
    Asked asked{chosen.light,
                fmt::format("light from azimuth {:g}, altitude {:g}", azimuth_deg, altitude_deg),
                {{"azimuth_deg", azimuth_deg}, {"altitude_deg", altitude_deg}}};
    if (chosen.time)
        asked.fields["time_utc"] = to_iso8601({chosen.time->utc});
    return asked;
}

Asked ask_lamp(const ChosenLamp& lamp)
{
    return {lamp.light,
            "lamp at " + in_words(lamp),
            {{"lamp", {{"x", lamp.x}, {"y", lamp.y}, {"height_m", lamp.height_m}}}}};
}

Asked ask(const BenchOptions& options, const HeightFile& file, const EarthCurvature& curvature,
          Report& report)
{
    if (!options.lamps.given())
        return ask_sun(choose_light(options.light, light_site(file.ground()), report), file);
    return ask_lamp(choose_lamps(options.lamps, options.input, options.run, file, curvature, report).front());
}

void require_one_light(const BenchOptions& options, const std::vector<const Caster*>& casters)
{
    require_lamps_or_sun(options.lamps, options.light);
    if (!options.lamps.given())
        return;
    if (options.lamps.points.size() > 1)
        throw UsageError(fmt::format("bench takes one --point, got {}", options.lamps.points.size()));
    for (const Caster* caster : casters)
        require_takes_lamps(*caster);
}

void report_scene(const HeightFile& file, const Asked& asked, const EarthCurvature& curvature, Report& report)
{
    report.line(fmt::format("{}: {} rows x {} columns, {}", file.facts().path, file.rows(), file.columns(),
                            asked.in_words));
    report.field("input", file.facts().path);
    report.field("rows", file.rows());
    report.field("columns", file.columns());
    report.field("cells", file.rows() * file.columns());
    report.json()["cell_size_m"] = {file.ground().cell_size_m.x, file.ground().cell_size_m.y};
    report.json().update(asked.fields);
    report.field("curvature", curvature.coefficient);
}

void report_machine(const BenchOptions& options, Report& report)
{
    report.field("threads", thread_count({.threads = options.run.threads}));
    report.field("kernel", kernels::active_kernels().isa);
}

void report_result(const BenchResult& result, Report& report)
{
    const double memcpy_s = result.memcpy_times.median_s();
    const auto threads = report.json()["threads"].get<std::size_t>();
    report.line(fmt::format("{} thread{}, {} kernels; memcpy of the heights {} ms on one thread", threads,
                            threads > 1 ? "s" : "", report.json()["kernel"].get<std::string>(),
                            in_digits(1e3 * memcpy_s)));
    report.line("");
    report.line(fmt::format("{:<{}} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>5}", "caster",
                            longest_name(), "median ms", "best ms", "Mcells/s", "x memcpy", "differing",
                            "share", "farthest", "peak MiB", "runs"));
    report.field("memcpy_ms", 1e3 * memcpy_s);
    report.field("memcpy_best_ms", 1e3 * result.memcpy_times.best_s());
    report.field("truth", result.truth->name);
    report.field("shadow", result.shadow);
    report.field("no_data", result.no_data);
    report.json()["casters"] = nlohmann::ordered_json::array();
    for (const CasterBench& bench : result.casters) {
        report.line(as_row(bench, memcpy_s));
        report.json()["casters"].push_back(as_json(bench, memcpy_s));
    }
    report.line("");
    report.line(fmt::format("differing  cells with another answer than {}",
                            result.truth->name == "ray" ? "ray" : "fast-ray, which gives the bits of ray"));
    report.line("farthest   of them from a shadow's edge, in cells");
}

void report_missing_ray(Report& report)
{
    const std::string text = fmt::format("left out on more than {} cells, where it takes long; --casters "
                                         "ray,exact asks for it",
                                         kMostCellsForRay);
    report.line(fmt::format("{:<{}} {}", "ray", longest_name(), text));
    report.note("ray is " + text);
}

void run_bench(const BenchOptions& options)
{
    Report report("bench", options.run);
    std::vector<const Caster*> asked_for;
    if (!options.casters.empty())
        asked_for = casters_named(options.casters);
    require_one_light(options, asked_for);
    HeightFile file = open_heights(options.input, options.run, report);
    const EarthCurvature curvature = choose_curvature(options.input, file, report);
    const Asked asked = ask(options, file, curvature, report);
    require_memory(file.rows(), file.columns(), kBytesPerCell, "'" + file.facts().path + "'");
    const std::size_t cells = file.rows() * file.columns();
    report_scene(file, asked, curvature, report);
    report_machine(options, report);

    const BenchPlan plan{.casters = options.casters.empty() ? usual_casters(cells, options.lamps.given())
                                                            : asked_for,
                         .runs = options.runs,
                         .threads = options.run.threads};
    BenchResult result;
    {
        ProgressBar bar(options.run);
        Terrain terrain =
            read_terrain(file, {.threads = options.run.threads, .progress = bar.part(0.0, 0.1)});
        if (curvature.coefficient != 0.0)
            CurvedEarth(curvature, terrain.cell_size_m, file.columns()).lower(terrain.heights_m.view());
        report_reading(file, report);
        result = bench_casters(terrain, asked.light, plan, bar);
    }
    report_result(result, report);
    if (options.casters.empty() && leaves_out_ray(cells))
        report_missing_ray(report);
    report.finish();
}

void add_bench_options(CLI::App& app, BenchOptions& options)
{
    std::string names;
    for (const Caster& caster : kCasters)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", caster.name);
    app.add_option("--casters", options.casters,
                   fmt::format("which to measure, with commas between: {}; else all, but ray only up to {} "
                               "cells",
                               names, kMostCellsForRay))
        ->type_name("A,B")
        ->group("Running");
    const auto read_runs = [&options](const std::string& typed) {
        options.runs = parse_count("--runs", typed, 1);
    };
    app.add_option_function<std::string>(
           "--runs", read_runs,
           "how often each is timed; else as often as fits in 2 seconds, from 1 "
           "to 25")
        ->type_name("N")
        ->group("Running");
}

} // namespace

Run declare_bench(CLI::App& app)
{
    const auto options = std::make_shared<BenchOptions>();
    add_input_options(app, options->input);
    add_light_options(app, options->light);
    add_point_option(app, options->lamps, ", for the casters that take lamps");
    add_bench_options(app, *options);
    add_run_options(app, options->run);
    add_details(
        app, "Casts the light with every caster, in memory, and says how long each takes, in how many cells "
             "it differs from ray, how far those are from a shadow's edge (1: beside it, diagonally too), "
             "and how much memory it takes besides the heights, its answer included.");
    add_details(
        app, "The heights are copied by memcpy, on one thread, and the casters take turns, round after "
             "round: a machine that slows down slows all of them, and their ratios to the copy stay. Times "
             "are medians and do not count reading the file. Memory is the most that was resident at once; "
             "where the system does not say, there is none in the table, and null in the JSON.");
    add_example(app, "how fast and how right are the casters here, in a low sun?",
                "duskline bench dem.tif --azimuth 203 --altitude 5");
    add_example(app, "two of them on one thread, by a machine",
                "duskline bench dem.tif --azimuth 203 --altitude 5 --casters exact,sweep -j 1 --json");
    return [options] { run_bench(*options); };
}

} // namespace duskline::cli
