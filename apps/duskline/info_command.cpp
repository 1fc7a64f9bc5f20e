#include "command.h"
#include "height_input.h"
#include "help_page.h"
#include "light_options.h"
#include "progress_bar.h"
#include "report.h"
#include "run_options.h"

#include <duskline/casting/kernels/kernels.h>
#include <duskline/execution/available_memory.h>
#include <duskline/execution/for_rows.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace duskline::cli {
namespace {

struct InfoOptions {
    InputOptions input;
    RunOptions run;
};

// Lowest and highest of the heights there are, metres; lowest above highest when there are none.
struct HeightRange {
    double lowest_m = std::numeric_limits<double>::infinity();
    double highest_m = -std::numeric_limits<double>::infinity();

    bool is_empty() const { return lowest_m > highest_m; }
};

void extend(HeightRange& range, GridView<const float> heights_m)
{
    float lowest = std::numeric_limits<float>::infinity();
    float highest = -lowest;
    for (std::size_t y = 0; y < heights_m.rows(); ++y) {
        for (const float h : heights_m.row(y)) {
            lowest = h < lowest ? h : lowest;
            highest = h > highest ? h : highest;
        }
    }
    range.lowest_m = std::min(range.lowest_m, static_cast<double>(lowest));
    range.highest_m = std::max(range.highest_m, static_cast<double>(highest));
}

HeightRange height_range(HeightFile& file, const ProgressCallback& progress)
{
    const std::size_t block = file.facts().block_rows;
    const std::size_t at_once =
        std::max<std::size_t>((std::size_t{1} << 22U) / file.columns() / block, 1) * block;
    Grid<float> heights_m(std::min(at_once, file.rows()), file.columns());
    HeightRange range;
    for (std::size_t first = 0; first < file.rows(); first += at_once) {
        const std::size_t rows = std::min(at_once, file.rows() - first);
        const GridView<float> part = heights_m.view().window(0, 0, rows, file.columns());
        file.read(first, 0, part);
        extend(range, part);
        if (!progress(static_cast<double>(first + rows) / static_cast<double>(file.rows())))
            throw Cancelled();
    }
    range.lowest_m += file.facts().base_m;
    range.highest_m += file.facts().base_m;
    return range;
}

void report_storage(const HeightFileFacts& facts, Report& report)
{
    report.line(
        fmt::format("{}: {}, {} rows x {} columns", facts.path, facts.format, facts.rows, facts.columns));
    report.line(fmt::format("stored     {}{}{}, blocks of {} x {}, band {} of {}", facts.sample_type,
                            facts.compression.empty() ? "" : ", ", facts.compression, facts.block_rows,
                            facts.block_columns, facts.band, facts.band_count));
    report.field("path", facts.path);
    report.field("format", facts.format);
    report.field("rows", facts.rows);
    report.field("columns", facts.columns);
    report.field("band", facts.band);
    report.field("band_count", facts.band_count);
    report.field("sample_type", facts.sample_type);
    report.field("compression", facts.compression);
    report.json()["block"] = {{"rows", facts.block_rows}, {"columns", facts.block_columns}};
}

void report_heights(const HeightFile& file, const HeightRange& range, Report& report)
{
    const HeightFileFacts& facts = file.facts();
    const ReadTally& tally = file.tally();
    const double share =
        tally.cells == 0 ? 0.0 : static_cast<double>(tally.no_data) / static_cast<double>(tally.cells);
    report.line(range.is_empty() ? std::string("heights    none")
                                 : fmt::format("heights    {:.6g} to {:.6g} m, {:.2f} % without data",
                                               range.lowest_m, range.highest_m, 100.0 * share));
    auto& json = report.json()["heights"];
    json["lowest_m"] = range.is_empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(range.lowest_m);
    json["highest_m"] = range.is_empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(range.highest_m);
    json["no_data_cells"] = tally.no_data;
    json["no_data_share"] = share;
    json["undeclared_void_cells"] = tally.undeclared_voids;
    json["declared_no_data"] = facts.no_data && std::isfinite(*facts.no_data)
                                   ? nlohmann::ordered_json(*facts.no_data)
                                   : nlohmann::ordered_json();
    json["has_mask"] = facts.has_mask;
    json["unit"] = facts.height_unit;
    json["metres_per_unit"] = facts.metres_per_unit;
    json["scale"] = facts.scale;
    json["offset"] = facts.offset;
}

std::string map_north_in_words(Angle map_north)
{
    if (map_north == Angle())
        return "";
    return fmt::format("; there the map's north lies {:.2f} degrees {} of true north",
                       std::abs(map_north.degrees()), map_north.degrees() < 0.0 ? "west" : "east");
}

void report_ground(const HeightFileFacts& facts, Report& report)
{
    const GroundFrame& ground = facts.ground;
    report.line(fmt::format("cells      {:.6g} x {:.6g} m, {:.4g} x {:.4g} km in all", ground.cell_size_m.x,
                            ground.cell_size_m.y,
                            ground.cell_size_m.x * static_cast<double>(facts.columns) / 1e3,
                            ground.cell_size_m.y * static_cast<double>(facts.rows) / 1e3));
    report.line(fmt::format("CRS        {}", facts.crs_name.empty() ? "none" : facts.crs_name));
    report.json()["cell_size_m"] = {ground.cell_size_m.x, ground.cell_size_m.y};
    report.json()["rows_flipped"] = ground.rows_flipped;
    report.json()["columns_flipped"] = ground.columns_flipped;
    report.json()["grid_north_deg"] = ground.grid_north.degrees();
    report.json()["map_north_deg"] = ground.map_north.degrees();
    report.json()["crs"] = {{"name", facts.crs_name}, {"wkt", facts.crs_wkt}};
    if (facts.geotransform)
        report.field("geotransform", *facts.geotransform);
    if (ground.rows_flipped || ground.columns_flipped)
        report.line(fmt::format("stored     {}{}{} first", ground.rows_flipped ? "south" : "",
                                ground.rows_flipped && ground.columns_flipped ? " and " : "",
                                ground.columns_flipped ? "east" : ""));
    if (!ground.body)
        return;
    report.line(fmt::format("body       {}, radius {:.1f} km here", ground.body->name,
                            ground.body->local_radius_m / 1e3));
    report.line(
        fmt::format("centre     {}{}", in_words(*ground.centre), map_north_in_words(ground.map_north)));
    report.json()["body"] = {{"name", ground.body->name}, {"radius_m", ground.body->local_radius_m}};
    report.json()["centre"] = {{"longitude_deg", ground.centre->longitude.degrees()},
                               {"latitude_deg", ground.centre->latitude.degrees()}};
}

void report_machine(const RunOptions& options, Report& report)
{
    const std::size_t threads = thread_count({.threads = options.threads});
    const std::size_t memory = available_memory_bytes();
    report.line(fmt::format("machine    {} kernels, {} threads, {:.1f} GiB of memory free",
                            kernels::active_kernels().isa, threads,
                            static_cast<double>(memory) / 1024.0 / 1024.0 / 1024.0));
    auto& machine = report.json()["machine"];
    machine["kernels"] = kernels::active_kernels().isa;
    for (const kernels::Kernels& kernel : kernels::runnable_kernels())
        machine["runnable_kernels"].push_back(kernel.isa);
    machine["threads"] = threads;
    machine["memory_free_bytes"] = memory;
}

// With -v they are on stderr already.
void report_notes(const RunOptions& run, Report& report)
{
    for (const auto& text : report.json()["notes"])
        if (!run.verbose)
            report.line("note       " + text.get<std::string>());
}

void run_info(const InfoOptions& options)
{
    Report report("info", options.run);
    HeightFile file = open_heights(options.input, options.run, report);
    choose_curvature(options.input, file, report);
    HeightRange range;
    {
        ProgressBar bar(options.run);
        range = height_range(file, bar.part(0.0, 1.0));
    }
    report_storage(file.facts(), report);
    report_heights(file, range, report);
    report_ground(file.facts(), report);
    report_reading(file, report);
    report_notes(options.run, report);
    report_machine(options.run, report);
    report.finish();
}

} // namespace

Run declare_info(CLI::App& app)
{
    const auto options = std::make_shared<InfoOptions>();
    add_input_options(app, options->input);
    add_run_options(app, options->run);
    add_details(
        app, "Reads the heights once and says what Duskline makes of the file: its cells in metres, units, "
             "range, holes and place, what was assumed, and what this machine has to work with.");
    add_example(app, "is this file understood?", "duskline info dem.tif");
    return [options] { run_info(*options); };
}

} // namespace duskline::cli
