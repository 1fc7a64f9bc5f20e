#include "caster_option.h"
#include "command.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "lamp_options.h"
#include "light_options.h"
#include "option_values.h"
#include "output_options.h"
#include "progress_bar.h"
#include "raster_site.h"
#include "raster_tags.h"
#include "report.h"
#include "run_options.h"
#include "shadow_codes.h"
#include "shadow_job.h"
#include "stopwatch.h"

#include <duskline/casting/lamps.h>
#include <duskline/execution/available_memory.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace duskline::cli {
namespace {

struct ShadowOptions {
    InputOptions input;
    OutputOptions output;
    LightOptions light;
    LampOptions lamps;
    std::string caster; // empty: the default
    bool heights = false;
    bool classes = false;
    bool soft = false;
    bool antialias = false;
    MaskCodeOptions codes;
    std::optional<double> memory_mib;
    RunOptions run;
};

// The sun or whatever light is as far away, or else lamps.
struct ShadowLight {
    ChosenLight sun;
    std::vector<ChosenLamp> lamps;
};

ShadowResult chosen_result(const ShadowOptions& options)
{
    if (options.soft)
        return ShadowResult::soft;
    if (options.antialias)
        return ShadowResult::antialias;
    if (options.heights)
        return ShadowResult::heights;
    if (options.lamps.count)
        return ShadowResult::lamp_count;
    return options.classes ? ShadowResult::classes : ShadowResult::mask;
}

std::string encoding_in_words(ShadowResult result, const MaskCodes& codes, const HeightFileFacts& facts,
                              const ShadowLight& light)
{
    switch (result) {
    case ShadowResult::heights:
        return fmt::format("height a point needs to be in the {}, {}; -9999 no data",
                           light.lamps.empty() ? "sun" : "light", facts.height_unit);
    case ShadowResult::lamp_count:
        return "how many lamps light the cell; 255 no data";
    case ShadowResult::classes:
        return "0 lit, 1 self-shaded, 2 cast shadow, 255 no data";
    case ShadowResult::soft:
        return "share of the light's disc that is seen, 0 to 1; -9999 no data";
    case ShadowResult::antialias:
        return "share of the cell's area that is lit, 0 to 1; -9999 no data";
    case ShadowResult::mask:
        break;
    }
    return in_words(codes) + (light.lamps.size() > 1 ? "; lit is what at least one lamp lights" : "");
}

const char* name_of(ShadowResult result)
{
    switch (result) {
    case ShadowResult::heights:
        return "shadow height";
    case ShadowResult::classes:
        return "shadow class";
    case ShadowResult::lamp_count:
        return "lamps that light";
    case ShadowResult::soft:
        return "visible share of the light";
    case ShadowResult::antialias:
        return "lit share of the cell";
    case ShadowResult::mask:
        break;
    }
    return "lit";
}

std::string lamps_in_words(const std::vector<ChosenLamp>& lamps)
{
    return lamps.size() == 1 ? "lamp at " + in_words(lamps.front()) : fmt::format("{} lamps", lamps.size());
}

std::string band_description(ShadowResult result, const ShadowLight& light)
{
    if (!light.lamps.empty())
        return fmt::format("{}, {}", name_of(result), lamps_in_words(light.lamps));
    const ChosenLight& chosen = light.sun;
    const std::string from = chosen.time
                                 ? to_iso8601(*chosen.time)
                                 : fmt::format("azimuth {:g}, altitude {:g}", chosen.light.azimuth.degrees(),
                                               chosen.light.altitude.degrees());
    const char* what = result == ShadowResult::mask ? "sunlit" : name_of(result);
    return fmt::format("{} {}", what, from);
}

RasterContent content_of(const ShadowOptions& options, const HeightFile& file, const ShadowLight& light,
                         const EarthCurvature& curvature, const Caster& caster, const MaskCodes& codes,
                         const Report& report)
{
    const ShadowResult result = chosen_result(options);
    RasterContent content;
    content.samples = is_real(result) ? Samples::real : Samples::byte;
    content.classes = !is_real(result);
    content.no_data = is_real(result)                ? static_cast<double>(kNoHeight)
                      : result == ShadowResult::mask ? static_cast<double>(codes.no_data)
                                                     : 255.0;
    content.description = band_description(result, light);
    if (result == ShadowResult::heights)
        content.unit = file.facts().metres_per_unit == 1.0 ? "m" : file.facts().height_unit;
    content.tags = light.lamps.empty() ? light_tags(light.sun, file) : lamp_tags(light.lamps);
    if (result == ShadowResult::soft)
        add_tag(content.tags, "LIGHT_DIAMETER",
                fmt::format("{:.6g}", light.sun.light.angular_diameter.degrees()));
    add_tag(content.tags, "CASTER", std::string(caster.name));
    add_tag(content.tags, "ENCODING", encoding_in_words(result, codes, file.facts(), light));
    add_height_tags(content.tags, file, curvature);
    add_assumptions(content.tags, report);
    return content;
}

std::string share(std::size_t part, std::size_t all)
{
    return fmt::format("{:.2f} %",
                       all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

void report_outcome(const ShadowOptions& options, const ShadowOutcome& outcome, double total_s,
                    const Caster& caster, Report& report)
{
    const LitCount& count = outcome.count;
    const ShadowResult result = chosen_result(options);
    const std::string partly =
        !is_share(result) ? ""
                          : fmt::format(" {} {},", share(count.partly_lit, count.cells()),
                                        result == ShadowResult::soft ? "in half-shadow" : "partly lit");
    report.line(fmt::format("{}: {} lit,{} {} in shadow, {} without data, of {} cells", options.output.path,
                            share(count.lit, count.cells()), partly, share(count.shadow, count.cells()),
                            share(count.no_data, count.cells()), count.cells()));
    report.field("output", options.output.path);
    report.field("caster", caster.name);
    report.field("cells", count.cells());
    report.field("lit", count.lit);
    report.field("shadow", count.shadow);
    if (is_share(result))
        report.field("partly_lit", count.partly_lit);
    report.field("no_data", count.no_data);
    report.json()["seconds"] = {{"reading", outcome.reading_s},
                                {"casting", outcome.casting_s},
                                {"writing", outcome.writing_s},
                                {"total", total_s}};
    if (options.run.verbose)
        report.note(fmt::format(
            "{:.3f} s in all; reading {:.3f} s, casting {:.3f} s, writing {:.3f} s{}", total_s,
            outcome.reading_s, outcome.casting_s, outcome.writing_s,
            outcome.reading_s + outcome.casting_s + outcome.writing_s > total_s ? ", at the same time" : ""));
}

void report_sun(const ChosenLight& chosen, const HeightFile& file, Report& report)
{
    const Angle from_map_north = wrapped_to_circle(chosen.light.azimuth + file.ground().grid_north);
    report.field("azimuth_deg", from_map_north.degrees());
    report.field("altitude_deg", chosen.light.altitude.degrees());
    if (chosen.time)
        report.field("time_utc", to_iso8601({chosen.time->utc}));
}

void report_light(const ShadowLight& light, const EarthCurvature& curvature, const HeightFile& file,
                  Report& report)
{
    if (light.lamps.empty())
        report_sun(light.sun, file, report);
    for (const ChosenLamp& lamp : light.lamps)
        report.json()["lamps"].push_back({{"x", lamp.x},
                                          {"y", lamp.y},
                                          {"height_m", lamp.height_m},
                                          {"row", lamp.light.position.row},
                                          {"column", lamp.light.position.column}});
    report.field("curvature", curvature.coefficient);
    report.json()["cell_size_m"] = {file.ground().cell_size_m.x, file.ground().cell_size_m.y};
}

// How to go about it.
enum class Way { stream, whole, windows };
struct Plan {
    Way way = Way::whole;
    std::size_t memory_bytes = 0; // for windows
};

// Of all free memory what fits may take all, what does not half of it.
Plan plan_for(const ShadowOptions& options, const HeightFile& file, const Caster& caster)
{
    const ShadowResult result = chosen_result(options);
    if (options.lamps.given() || is_share(result)) {
        require_memory_for_whole(file, caster, result, options.lamps.points.size());
        return {};
    }
    if (can_stream(caster, result))
        return {.way = Way::stream};
    const auto free_bytes = static_cast<double>(available_memory_bytes());
    const double most_bytes =
        options.memory_mib ? std::min(*options.memory_mib * 1024.0 * 1024.0, free_bytes) : free_bytes;
    const double needed_bytes = static_cast<double>(file.rows()) * static_cast<double>(file.columns())
                                * bytes_per_cell(caster, result, 0);
    if (needed_bytes <= most_bytes)
        return {};
    if (can_stream(caster,
                   ShadowResult::mask)) // its beams are counted from the first line: no window has them
        throw UnsupportedOnThisMachine(fmt::format(
            "'{}' needs {:.3g} MiB for {} by --caster {}, which takes them from the whole raster; {:.3g} MiB "
            "may be used; take --caster exact, which casts in windows",
            file.facts().path, needed_bytes / 0x1p20, name_of(result), caster.name, most_bytes / 0x1p20));
    return {Way::windows, static_cast<std::size_t>(options.memory_mib ? most_bytes : most_bytes / 2.0)};
}

ShadowOutcome cast_shadows(const ShadowJob& job, Way way)
{
    switch (way) {
    case Way::stream:
        return cast_in_stream(job);
    case Way::windows:
        return cast_in_windows(job);
    case Way::whole:
        break;
    }
    return cast_whole(job);
}

void require_possible(const ShadowOptions& options, const Caster& caster)
{
    require_lamps_or_sun(options.lamps, options.light);
    if (!options.lamps.given())
        return;
    if (options.classes)
        throw UsageError(
            "--classes are of parallel light: give --azimuth and --altitude, or --time, not --point");
    if (options.soft)
        throw UsageError("--soft is of a sun's disc: give --azimuth and --altitude, or --time, not --point");
    if (options.antialias)
        throw UsageError(
            "--antialias is of parallel light: give --azimuth and --altitude, or --time, not --point");
    require_takes_lamps(caster);
}

ShadowLight choose(const ShadowOptions& options, const HeightFile& file, const EarthCurvature& curvature,
                   Report& report)
{
    if (options.lamps.given())
        return {{}, choose_lamps(options.lamps, options.input, options.run, file, curvature, report)};
    LightOptions light = options.light;
    light.disc_counts = options.soft;
    return {choose_light(light, light_site(file.ground()), report), {}};
}

std::vector<PointLight> as_casters_take_them(const std::vector<ChosenLamp>& lamps)
{
    std::vector<PointLight> lights;
    lights.reserve(lamps.size());
    for (const ChosenLamp& lamp : lamps)
        lights.push_back(lamp.light);
    return lights;
}

void run_shadow(const ShadowOptions& options)
{
    double total_s = 0.0;
    Report report("shadow", options.run);
    ProgressBar bar(options.run);
    ShadowOutcome outcome;
    const Caster& caster = chosen_caster(options.caster);
    require_possible(options, caster);
    {
        const Stopwatch watch(total_s);
        const WriteOptions write = write_options(options.output, options.run);
        const std::string format = output_format(options.output.path, write);
        const MaskCodes codes = choose_mask_codes(options.codes, is_picture_format(format));
        HeightFile file = open_heights(options.input, options.run, report);
        const Plan plan = plan_for(options, file, caster);
        const EarthCurvature curvature = choose_curvature(options.input, file, report);
        const ShadowLight light = choose(options, file, curvature, report);
        report_light(light, curvature, file, report);
        if (options.soft)
            report.field("light_diameter_deg", light.sun.light.angular_diameter.degrees());
        if (plan.way == Way::windows)
            require_memory_for_windows(file, light.sun.light, caster, chosen_result(options),
                                       static_cast<double>(plan.memory_bytes));
        RasterWriter writer(options.output.path, file,
                            content_of(options, file, light, curvature, caster, codes, report), write);
        outcome =
            cast_shadows({.file = file,
                          .writer = writer,
                          .light = light.sun.light,
                          .lamps = as_casters_take_them(light.lamps),
                          .curvature = curvature,
                          .caster = caster,
                          .result = chosen_result(options),
                          .codes = codes,
                          .execution = {.threads = options.run.threads, .progress = bar.part(0.0, 0.95)},
                          .memory_bytes = plan.memory_bytes},
                         plan.way);
        if (plan.way == Way::windows)
            report.note("too large for memory: cast in windows, each with the ground that shades it");
        writer.finish(bar.part(0.95, 1.0));
        bar.part(0.95, 1.0)(1.0);
        report_reading(file, report);
    }
    report_outcome(options, outcome, total_s, caster, report);
    report.finish();
}

void add_result_options(CLI::App& app, ShadowOptions& options)
{
    auto* heights = app.add_flag("--heights", options.heights,
                                 "write the height a point needs to be in the sun, in the unit of the input, "
                                 "instead of a mask; where the ground is lit, its own");
    auto* classes =
        app.add_flag("--classes", options.classes,
                     "write 0 lit, 1 self-shaded (its slope looks away), 2 cast shadow, 255 no data");
    auto* soft = app.add_flag("--soft", options.soft,
                              "write how much of the light's disc (--sun-size) is seen, 0 to 1: shadows with "
                              "soft edges");
    auto* antialias = app.add_flag("--antialias", options.antialias,
                                   "write how much of a cell's area is lit, 0 to 1: hard edges, drawn within "
                                   "cells");
    const std::array results = {heights, classes, soft, antialias};
    for (auto* result : results) {
        result->group("Output");
        result->excludes(app.get_option("--count"));
        for (auto* other : results)
            if (other != result)
                result->excludes(other);
    }
    add_mask_code_options(app, options.codes);
}

} // namespace

Run declare_shadow(CLI::App& app)
{
    const auto options = std::make_shared<ShadowOptions>();
    add_input_options(app, options->input);
    add_output_options(app, options->output);
    add_light_options(app, options->light);
    add_lamp_options(app, options->lamps);
    add_result_options(app, *options);
    add_caster_option(app, options->caster);
    add_run_options(app, options->run);
    add_number(
        app,
        {.names = "--memory",
         .unit = "MIB",
         .text = "memory for heights and answers; rasters that need more are cast in windows, with the same "
                 "result; else what is free",
         .range = {.least = 0.0, .above = true}},
        options->memory_mib)
        ->group("Running");
    add_details(
        app, "OUTPUT has the grid of INPUT: its size, coordinate system and geotransform. A mask says 0 in "
             "the shadow, 1 in the light and 255 where there is no data; in pictures (PNG, JPEG) 0, 255 "
             "and 128. The light and everything that was assumed stand in its metadata.");
    add_example(app, "the shadows of a summer evening",
                "duskline shadow dem.tif shadow.tif --time 2026-06-21T18:30-10:00");
    add_example(app, "a light in the north-west, 20 degrees high",
                "duskline shadow dem.tif shadow.png --azimuth 315 --altitude 20");
    add_example(app, "what a lamp 30 m above the ground and a beacon 4250 m high light",
                "duskline shadow dem.tif lit.tif --point 243500,2193200,+30 --point 240000,2190000,4250");
    add_example(app, "the same with soft edges, as wide as the sun's disc makes them",
                "duskline shadow dem.tif soft.tif --soft --time 2026-06-21T18:30-10:00");
    add_example(app, "how high a mast must be to stand in the sun",
                "duskline shadow dem.tif heights.tif --heights --azimuth 180 --altitude 8");
    return [options] { run_shadow(*options); };
}

} // namespace duskline::cli
