#include "command.h"
#include "content_hash.h"
#include "day_folder.h"
#include "day_manifest.h"
#include "day_suns.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "interruption.h"
#include "light_map_options.h"
#include "option_values.h"
#include "output_options.h"
#include "picture_options.h"
#include "progress_bar.h"
#include "raster_tags.h"
#include "report.h"
#include "run_options.h"
#include "stopwatch.h"

#include <duskline/execution/for_rows.h>
#include <duskline/execution/run_stages.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/products/day_cycle.h>
#include <duskline/products/tiles.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/staged_output.h>
#include <duskline/raster_io/write_animation.h>
#include <duskline/raster_io/write_picture.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

namespace duskline::cli {
namespace {

struct DayOptions {
    InputOptions input;
    OutputOptions output;
    DaySunOptions sun;
    bool shadows = false;
    bool soft = false;
    std::string model = "lambert";
    std::optional<double> ambient;
    std::optional<std::size_t> atlas;
    std::optional<std::size_t> sheet;
    std::optional<std::size_t> animation;
    double frame_s = 0.15;
    bool resume = false;
    RunOptions run;

    bool has_extras() const { return atlas || sheet || animation; }
    bool is_hard_mask() const { return shadows && !soft; }
};

// Maps made and written at a time, at most: each is a byte a cell.
constexpr std::size_t kMostAtOnce = 8;

// Heights, a mask; normals and light; the visible fraction and its masks.
constexpr double kBytesPerCell = 5.0;
constexpr double kBytesPerCellLight = 16.0;
constexpr double kBytesPerCellSoft = 8.5;

constexpr auto kAtlas = "atlas.png";
constexpr auto kSheet = "contact_sheet.png";
constexpr auto kAnimation = "animation.webp";

// Everything there is to know once the options are settled.
struct DayJob {
    const DayOptions& options;
    HeightFile& file;
    EarthCurvature curvature;
    DaySuns day;
    bool bands = false; ///< one raster of many bands, not a folder of files
    std::string format; ///< of the maps
    ProgressBar& bar;

    std::size_t count() const { return day.suns.size(); }
    std::size_t at_once() const
    {
        return bands ? 1 : std::min(thread_count({.threads = options.run.threads}), kMostAtOnce);
    }
    Execution execution(double from, double to) const
    {
        return {.threads = options.run.threads, .progress = bar.part(from, to)};
    }
};

// All maps made smaller, for the pictures that show them together.
struct SmallMaps {
    std::vector<Grid<std::uint8_t>> atlas;
    std::vector<Grid<std::uint8_t>> sheet;
    std::vector<Grid<std::uint8_t>> animation;
};

struct Outcome {
    std::size_t made = 0;
    std::size_t kept = 0; ///< of a job that was stopped, or is complete
    double reading_s = 0.0;
    double casting_s = 0.0;
    double writing_s = 0.0;
    double total_s = 0.0;
};

bool is_one_raster(const std::string& path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".tif" || extension == ".tiff" || extension == ".TIF";
}

// PNG or GTiff, whatever the case they are typed in.
std::string format_of(const DayOptions& options, bool bands)
{
    if (options.output.format.empty())
        return bands ? "GTiff" : "PNG";
    std::string format = output_format("", {.format = options.output.format});
    if (bands && format != "GTiff")
        throw UsageError(fmt::format("one raster of many bands is a GTiff, got --of {}", format));
    if (format != "PNG" && format != "GTiff")
        throw UsageError(fmt::format("maps are PNG or GTiff, got --of {}", format));
    return format;
}

void require_possible(const DayOptions& options)
{
    require_possible(options.sun);
    if (options.shadows && options.ambient)
        throw UsageError("--ambient is of light, not of --shadows");
    light_model_named(options.model);
    if (!is_one_raster(options.output.path))
        return;
    if (options.has_extras())
        throw UsageError(
            "--atlas, --sheet and --animation lie beside maps in a folder; OUTPUT is one raster");
    if (options.resume)
        throw UsageError(
            "--resume is for maps in a folder; OUTPUT is one raster, which is written in one go");
}

DayMapOptions map_options(const DayOptions& options)
{
    DayMapOptions result;
    result.light = !options.shadows;
    result.soft = options.soft;
    const NamedLightModel& model = light_model_named(options.model);
    result.model.model = model.model;
    result.model.ambient = options.ambient.value_or(model.usual_ambient);
    return result;
}

std::string map_name(const DayJob& job, std::size_t map)
{
    const std::size_t digits = std::max<std::size_t>(2, std::to_string(job.count() - 1).size());
    return fmt::format("map_{:0{}}.{}", map, digits, job.format == "PNG" ? "png" : "tif");
}

std::vector<std::string> map_names(const DayJob& job)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < job.count(); ++i)
        names.push_back(map_name(job, i));
    return names;
}

std::string encoding_of(const DayJob& job)
{
    if (!job.options.shadows)
        return "0 dark to 255 white; 0 no data";
    if (job.options.soft)
        return "0 full shadow to 255 full light, by the share of the sun's disc that is seen; 0 no data";
    return job.format == "PNG" ? "0 shadow, 255 lit, 128 no data" : "0 shadow, 1 lit, 255 no data";
}

std::string content_name(const DayOptions& options)
{
    if (options.shadows)
        return options.soft ? "visible share of the sun" : "sunlit";
    return options.soft ? "light, soft shadows" : "light";
}

// All that the bytes of a job's files depend on.
nlohmann::ordered_json identity_of(const DayJob& job, const Terrain& lowered)
{
    const DayOptions& options = job.options;
    nlohmann::ordered_json times = nlohmann::ordered_json::array();
    for (const ChosenLight& sun : job.day.suns)
        times.push_back(sun.time->utc.time_since_epoch().count());
    const auto or_null = [](const auto& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    };
    return {
        {"rows", lowered.heights_m.rows()},
        {"columns", lowered.heights_m.columns()},
        {"cell_size_m", {lowered.cell_size_m.x, lowered.cell_size_m.y}},
        {"heights", content_hash(lowered.heights_m.values())},
        {"content", content_name(options)},
        {"model", options.shadows ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(options.model)},
        {"ambient", or_null(options.ambient)},
        {"map_format", job.format},
        {"creation_options", options.output.creation_options},
        {"place_deg", {job.day.view.place.longitude.degrees(), job.day.view.place.latitude.degrees()}},
        {"grid_north_deg", job.day.view.true_to_grid_north.degrees()},
        {"pressure_mbar", options.sun.sunlight.air.pressure_mbar},
        {"temperature_c", options.sun.sunlight.air.temperature_c},
        {"utc_offset_min", job.day.utc_offset.count()},
        {"times_us", times},
        {"atlas", or_null(options.atlas)},
        {"sheet", or_null(options.sheet)},
        {"animation", or_null(options.animation)},
        {"frame_s", options.frame_s}};
}

// Tags of every map, without its light.
RasterTags common_tags(const DayJob& job, const Report& report)
{
    RasterTags tags;
    add_tag(tags, "CASTER", "exact");
    add_tag(tags, "ENCODING", encoding_of(job));
    add_height_tags(tags, job.file, job.curvature);
    add_assumptions(tags, report);
    return tags;
}

BandContent band_of(const DayJob& job, std::size_t map)
{
    const ChosenLight& sun = job.day.suns[map];
    return {fmt::format("{} {}", content_name(job.options), to_iso8601(*sun.time)), "",
            light_tags(sun, job.file)};
}

RasterContent content_of(const DayJob& job, const Report& report)
{
    RasterContent content;
    content.classes = job.options.is_hard_mask();
    if (content.classes)
        content.no_data = job.format == "PNG" ? 128.0 : 255.0;
    content.tags = common_tags(job, report);
    if (job.bands)
        for (std::size_t i = 0; i < job.count(); ++i)
            content.bands.push_back(band_of(job, i));
    return content;
}

RasterContent with_light(RasterContent content, const BandContent& band)
{
    content.description = band.description;
    content.tags.insert(content.tags.begin(), band.tags.begin(), band.tags.end());
    return content;
}

// Masks in a GeoTIFF have the codes of duskline shadow.
void recode(const DayJob& job, Grid<std::uint8_t>& map)
{
    if (!job.options.is_hard_mask() || job.format == "PNG")
        return;
    constexpr std::uint8_t lit = 1;
    constexpr std::uint8_t no_data = 255;
    for (std::uint8_t& value : map.values())
        value = value == 255 ? lit : value == kNoDataInShadowMap ? no_data : value;
}

bool not_interrupted(double)
{
    return !interrupted();
}

// Maps under way: made by one stage, written by the next.
struct Batch {
    std::vector<Grid<std::uint8_t>> maps;
    std::vector<std::optional<RasterWriter>> writers;
};

// Makes maps and writes them, some at a time, both at once.
class Factory {
public:
    Factory(const DayJob& job, DayMaps& maps, DayFolder& folder, RasterContent content, Outcome& outcome)
        : job_(job), maps_(maps), folder_(folder), content_(std::move(content)), outcome_(outcome)
    {
        for (auto* tiles : {&small_.atlas, &small_.sheet, &small_.animation})
            tiles->resize(job.count());
    }

    void run(const Execution& execution)
    {
        const std::size_t batches = (job_.count() + job_.at_once() - 1) / job_.at_once();
        run_stages(batches, batches_.size(),
                   {[this](std::size_t batch) { make(batch); }, [this](std::size_t batch) { write(batch); }},
                   execution);
    }

    SmallMaps& small() { return small_; }

private:
    std::size_t first_of(std::size_t batch) const { return batch * job_.at_once(); }
    std::size_t size_of(std::size_t batch) const
    {
        return std::min(job_.at_once(), job_.count() - first_of(batch));
    }

    void make(std::size_t number)
    {
        const Stopwatch watch(outcome_.casting_s);
        Batch& batch = batches_.at(number % batches_.size());
        batch.maps.clear();
        batch.maps.resize(size_of(number));
        batch.writers.clear();
        batch.writers.resize(size_of(number));
        for (std::size_t i = 0; i < size_of(number); ++i) {
            const std::size_t map = first_of(number) + i;
            const std::string name = map_name(job_, map);
            const bool there = folder_.has(name);
            (there ? outcome_.kept : outcome_.made) += 1;
            if (there && !job_.options.has_extras())
                continue;
            batch.maps[i] = maps_.map(job_.day.suns[map].light,
                                      {.threads = job_.options.run.threads, .progress = not_interrupted});
            if (!there)
                batch.writers[i].emplace(
                    folder_.path_of(name), job_.file, with_light(content_, band_of(job_, map)),
                    WriteOptions{.format = job_.format,
                                 .creation_options = job_.options.output.creation_options,
                                 .threads = 1});
        }
    }

    void write(std::size_t number)
    {
        const Stopwatch watch(outcome_.writing_s);
        Batch& batch = batches_.at(number % batches_.size());
        for_rows(size_of(number), 1, {.threads = job_.options.run.threads, .progress = {}},
                 [&](std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i)
                         write_map(batch, i, first_of(number) + i);
                 });
    }

    void write_map(Batch& batch, std::size_t i, std::size_t map)
    {
        Grid<std::uint8_t>& values = batch.maps[i];
        if (values.empty())
            return;
        shrink(job_.options.atlas, values, small_.atlas[map]);
        shrink(job_.options.sheet, values, small_.sheet[map]);
        shrink(job_.options.animation, values, small_.animation[map]);
        if (!batch.writers[i])
            return;
        recode(job_, values);
        batch.writers[i]->write(0, 0, GridView<const std::uint8_t>(values.view()));
        batch.writers[i]->finish(not_interrupted);
        batch.writers[i].reset();
    }

    void shrink(const std::optional<std::size_t>& pixels, const Grid<std::uint8_t>& map,
                Grid<std::uint8_t>& small) const
    {
        if (!pixels)
            return;
        const PictureSize size = size_with_longer_side("the size", *pixels, job_.file);
        small = mean_of_cells(map.view(), size.rows, size.columns);
    }

    const DayJob& job_;
    DayMaps& maps_;
    DayFolder& folder_;
    RasterContent content_;
    Outcome& outcome_;
    std::array<Batch, 2> batches_;
    SmallMaps small_;
};

std::vector<std::string> captions(const DayJob& job)
{
    std::vector<std::string> texts;
    for (const ChosenLight& sun : job.day.suns)
        texts.push_back(to_iso8601(*sun.time).substr(11, 5));
    return texts;
}

MapAtlas atlas_of(const DayJob& job)
{
    const PictureSize tile = size_with_longer_side("--atlas", *job.options.atlas, job.file);
    return {kAtlas, {.columns = columns_for(job.count(), tile.rows, tile.columns)}, tile.rows, tile.columns};
}

// The pictures that show all maps together.
DayManifest write_extras(const DayJob& job, const SmallMaps& small, const DayFolder& folder, Outcome& outcome)
{
    const Stopwatch watch(outcome.writing_s);
    DayManifest manifest;
    if (job.options.atlas) {
        manifest.atlas = atlas_of(job);
        write_picture(folder.path_of(kAtlas), tiled(small.atlas, manifest.atlas->layout).view(), true);
    }
    stop_if_interrupted();
    if (job.options.sheet) {
        manifest.sheet = kSheet;
        const Grid<std::uint8_t>& tile = small.sheet.front();
        const std::size_t caption = std::max<std::size_t>(14, tile.rows() / 9);
        const TileLayout layout = {.columns = columns_for(job.count(), tile.rows() + caption, tile.columns()),
                                   .gap = std::max<std::size_t>(2, tile.columns() / 40),
                                   .caption = caption};
        write_picture(folder.path_of(kSheet), tiled(small.sheet, layout, captions(job)).view(), true);
    }
    stop_if_interrupted();
    if (job.options.animation) {
        manifest.animation = kAnimation;
        write_animation(folder.path_of(kAnimation), small.animation,
                        {.seconds_a_frame = job.options.frame_s, .overwrite = true});
    }
    return manifest;
}

struct Ground {
    Terrain terrain; ///< lowered for the curvature of the earth
    NormalField normals;
};

Ground read_ground(const DayJob& job, Outcome& outcome, Report& report)
{
    const Stopwatch watch(outcome.reading_s);
    Ground ground;
    ground.terrain = read_terrain(job.file, job.execution(0.0, 0.05));
    report_reading(job.file, report);
    if (!job.options.shadows)
        ground.normals = upward_normals(ground.terrain, job.execution(0.05, 0.1));
    if (job.curvature.coefficient != 0.0)
        CurvedEarth(job.curvature, ground.terrain.cell_size_m, ground.terrain.heights_m.columns())
            .lower(ground.terrain.heights_m.view());
    return ground;
}

void require_memory_for(const DayJob& job)
{
    require_memory(job.file.rows(), job.file.columns(),
                   kBytesPerCell + (job.options.shadows ? 0.0 : kBytesPerCellLight)
                       + (job.options.soft ? kBytesPerCellSoft : 0.0)
                       + 2.0 * static_cast<double>(job.at_once()),
                   "'" + job.file.facts().path + "'");
}

void make_folder_of_maps(const DayJob& job, Outcome& outcome, Report& report)
{
    const DayOptions& options = job.options;
    DayFolder folder(options.output.path, {.overwrite = options.output.overwrite, .resume = options.resume});
    Ground ground = read_ground(job, outcome, report);
    const nlohmann::ordered_json identity = identity_of(job, ground.terrain);
    if (options.resume && folder.is_complete(identity)) {
        outcome.kept = job.count();
        return;
    }
    std::vector<std::string> names = map_names(job);
    if (options.atlas)
        names.emplace_back(kAtlas);
    if (options.sheet)
        names.emplace_back(kSheet);
    if (options.animation)
        names.emplace_back(kAnimation);
    folder.begin(identity, names);
    try {
        DayMaps maps(ground.terrain, std::move(ground.normals), map_options(options));
        Factory factory(job, maps, folder, content_of(job, report), outcome);
        factory.run(job.execution(0.1, 0.9));
        DayManifest manifest = write_extras(job, factory.small(), folder, outcome);
        manifest.encoding = encoding_of(job);
        manifest.map_files = map_names(job);
        folder.publish(manifest_of(manifest, identity, job.day, job.file));
    } catch (const Cancelled&) {
        if (options.resume)
            report.warn(fmt::format("'{}' keeps the maps that are done; the same command goes on from there",
                                    folder.staging()));
        throw;
    }
}

void write_text(StagedOutput& staged, const std::string& text)
{
    std::ofstream file(staged.path());
    file << text << '\n';
    if (!file.flush())
        throw OutputError(fmt::format("cannot write '{}': the disk may be full", staged.target()));
    file.close();
    staged.publish();
}

void make_bands(const DayJob& job, Outcome& outcome, Report& report)
{
    const DayOptions& options = job.options;
    WriteOptions write = write_options(options.output, options.run);
    write.format = job.format;
    RasterWriter writer(options.output.path, job.file, content_of(job, report), write);
    StagedOutput manifest_file(options.output.path + ".json", options.output.overwrite);
    Ground ground = read_ground(job, outcome, report);
    const nlohmann::ordered_json identity = identity_of(job, ground.terrain);
    DayMaps maps(ground.terrain, std::move(ground.normals), map_options(options));
    std::array<Grid<std::uint8_t>, 2> slots;
    const auto make = [&](std::size_t map) {
        const Stopwatch watch(outcome.casting_s);
        slots.at(map % 2) =
            maps.map(job.day.suns[map].light, {.threads = options.run.threads, .progress = not_interrupted});
    };
    const auto write_band = [&](std::size_t map) {
        const Stopwatch watch(outcome.writing_s);
        recode(job, slots.at(map % 2));
        writer.write_band(map, 0, 0, GridView<const std::uint8_t>(slots.at(map % 2).view()));
        ++outcome.made;
    };
    run_stages(job.count(), slots.size(), {make, write_band}, job.execution(0.1, 0.95));
    const Stopwatch watch(outcome.writing_s);
    writer.finish(job.bar.part(0.95, 1.0));
    DayManifest manifest;
    manifest.encoding = encoding_of(job);
    manifest.map_files = {std::filesystem::path(options.output.path).filename().string()};
    write_text(manifest_file, manifest_of(manifest, identity, job.day, job.file).dump(2));
}

void report_outcome(const DayJob& job, const Outcome& outcome, Report& report)
{
    const std::string& path = job.options.output.path;
    const auto told = [&job](UtcTime time) { return to_iso8601({time, job.day.utc_offset}); };
    report.line(fmt::format("{}: {} maps of {} x {} cells, {} to {}{}", path, job.count(), job.file.columns(),
                            job.file.rows(), told(job.day.suns.front().time->utc),
                            told(job.day.suns.back().time->utc),
                            outcome.kept > 0 ? fmt::format("; {} were there", outcome.kept) : ""));
    report.field("output", path);
    report.field("maps", job.count());
    report.field("made", outcome.made);
    report.field("kept", outcome.kept);
    report.field("content", content_name(job.options));
    report.field("first_time", told(job.day.suns.front().time->utc));
    report.field("last_time", told(job.day.suns.back().time->utc));
    report.json()["seconds"] = {{"reading", outcome.reading_s},
                                {"casting", outcome.casting_s},
                                {"writing", outcome.writing_s},
                                {"total", outcome.total_s}};
}

// Sizes of the pictures, before any work.
void require_sizes(const DayOptions& options, const HeightFile& file)
{
    for (const auto& [name, pixels] :
         {std::pair{"--atlas", options.atlas}, std::pair{"--sheet", options.sheet},
          std::pair{"--animation", options.animation}})
        if (pixels)
            size_with_longer_side(name, *pixels, file);
}

void run_day(const DayOptions& options)
{
    Outcome outcome;
    Report report("day", options.run);
    ProgressBar bar(options.run);
    require_possible(options);
    const bool bands = is_one_raster(options.output.path);
    const std::string format = format_of(options, bands);
    HeightFile file = open_heights(options.input, options.run, report);
    require_sizes(options, file);
    const EarthCurvature curvature = choose_curvature(options.input, file, report);
    const DayJob job = {options, file,   curvature, choose_day_suns(options.sun, options.soft, file, report),
                        bands,   format, bar};
    require_memory_for(job);
    {
        const Stopwatch total(outcome.total_s);
        if (bands)
            make_bands(job, outcome, report);
        else
            make_folder_of_maps(job, outcome, report);
        bar.part(0.0, 1.0)(1.0);
    }
    report_outcome(job, outcome, report);
    report.finish();
}

void add_contents(CLI::App& app, DayOptions& options)
{
    auto* shadows =
        app.add_flag("--shadows", options.shadows, "map shadows alone; else the light on the ground");
    shadows->group("Output");
    app.add_flag("--soft", options.soft, "soft edges, as wide as the sun's disc makes them")->group("Output");
    app.add_option("--model", options.model, "how the light falls on slopes: " + names_of_models())
        ->type_name("NAME")
        ->default_str("lambert")
        ->excludes(shadows)
        ->group("Output");
    add_number(app,
               {.names = "--ambient",
                .unit = "SHARE",
                .text = "light that reaches every cell, of 1; the sun has the rest; else " + usual_ambients(),
                .range = {.least = 0.0, .most = 1.0}},
               options.ambient)
        ->group("Output");
}

void add_pictures(CLI::App& app, DayOptions& options)
{
    const auto add = [&app](const std::string& name, std::optional<std::size_t>& pixels,
                            const std::string& text) {
        app.add_option_function<std::string>(
               name, [name, &pixels](const std::string& typed) { pixels = parse_count(name, typed, 1); },
               text + ", this many pixels along the longer side of each")
            ->type_name("PIXELS")
            ->group("Output");
    };
    add("--atlas", options.atlas, "all maps in one texture as well, atlas.png");
    add("--sheet", options.sheet, "a contact sheet with times as well, contact_sheet.png");
    add("--animation", options.animation, "a film as well, animation.webp");
    add_number(app,
               {.names = "--frame",
                .unit = "SECONDS",
                .text = "how long the film shows a map",
                .range = {.least = 0.0, .most = 60.0, .above = true}},
               options.frame_s)
        ->group("Output");
    app.add_flag("--resume", options.resume,
                 "keep what is done when stopped, and go on from there when the same command is given again")
        ->group("Running");
}

} // namespace

Run declare_day(CLI::App& app)
{
    const auto options = std::make_shared<DayOptions>();
    add_input_options(app, options->input);
    add_output_options(app, options->output);
    add_contents(app, *options);
    add_pictures(app, *options);
    add_day_sun_options(app, options->sun);
    add_run_options(app, options->run);
    add_details(
        app,
        "OUTPUT is a folder, which gets map_00.png and so on and manifest.json: the time of each map, its "
        "sun, "
        "and from when to when to blend it with its neighbours. When its name ends in .tif it is one "
        "GeoTIFF with a band for each map, and the manifest lies beside it as OUTPUT.json. Maps have the "
        "grid of INPUT and a byte a cell: light from 0 to 255; soft shadows likewise; hard shadows 0, "
        "255 and 128 where there is no data (in GeoTIFF 0, 1, 255).\n\n"
        "With --date maps stand in the middles of equal parts of the daylight, between --from and --to in "
        "even steps from one to the other.");
    add_example(
        app, "24 light maps of a day, with a contact sheet and a film",
        "duskline day dem.tif june --date 2026-06-21 --utc-offset -10:00 --sheet 256 --animation 512");
    add_example(app, "12 shadow masks of an afternoon in one raster",
                "duskline day dem.tif afternoon.tif --shadows -n 12 --from 2026-06-21T13:00-10:00 --to "
                "2026-06-21T18:30-10:00");
    return [options] { run_day(*options); };
}

} // namespace duskline::cli
