#include "caster_option.h"
#include "command.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "light_job.h"
#include "light_pixels.h"
#include "raster_tags.h"
#include "report.h"
#include "stopwatch.h"

#include <duskline/casting/lamps.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/write_ply.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>

namespace duskline::cli {
namespace {

// ---------------------------------------------------------------------------------------------------------
// What is asked for

bool is_mesh(const OutputOptions& output)
{
    const auto is_ply = [](std::string text) {
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
        return text == "ply";
    };
    if (!output.format.empty())
        return is_ply(output.format);
    const std::string extension = std::filesystem::path(output.path).extension().string();
    return !extension.empty() && is_ply(extension.substr(1));
}

void require_possible(const LightCommandOptions& options)
{
    require_lights(options.lights);
    const bool only_lamps = options.lights.lamps.given()
                            || (!options.lights.lights.empty()
                                && std::ranges::all_of(options.lights.lights, [](const auto& text) {
                                       return text.find("point=") != std::string::npos;
                                   }));
    if (only_lamps && options.map.soft)
        throw UsageError("--soft is of a sun's disc, and all the lights are lamps");
    if (only_lamps && options.map.antialias)
        throw UsageError("--antialias is of parallel light, and all the lights are lamps");
    if (!is_mesh(options.output))
        return;
    if (options.map.depth != SampleDepth::byte)
        throw UsageError("a mesh has colours of 8 bits: leave --ot away, or write a raster");
    if (!options.output.creation_options.empty())
        throw UsageError("--co is for GDAL's formats, and a mesh is none of them");
}

bool has_lamps(const LightJob& job)
{
    return std::ranges::any_of(job.lights,
                               [&](const ChosenMapLight& light) { return light.lamp && job.casts(light); });
}

// ---------------------------------------------------------------------------------------------------------
// Writing

constexpr std::array kDepthNames = {"Byte", "UInt16", "Float32"};

bool zero_is_no_data(const LightJob& job)
{
    return job.options.map.model->model == LightModel::hillshade && job.options.map.texture.empty()
           && job.options.map.depth != SampleDepth::real;
}

std::string shadows_in_words(const LightMapCommandOptions& map)
{
    if (map.no_shadows)
        return "none";
    return map.soft ? "soft" : map.antialias ? "antialiased" : "hard";
}

std::string encoding_in_words(const LightJob& job, bool opacity)
{
    const bool real = job.options.map.depth == SampleDepth::real;
    const bool hillshade = job.options.map.model->model == LightModel::hillshade;
    const std::string most = real ? "1" : job.options.map.depth == SampleDepth::word ? "65535" : "255";
    const std::string no_data = real                   ? "; -9999 no data"
                                : zero_is_no_data(job) ? "; 0 no data"
                                : opacity              ? "; opacity 0 no data"
                                                       : "";
    if (hillshade && job.options.map.depth == SampleDepth::byte)
        return "1 to 255 as gdaldem hillshade" + no_data;
    return (hillshade ? "gdaldem hillshade / 255, from 0 to " : "light from 0 to ") + most + no_data;
}

void add_light_tags(RasterTags& tags, const LightJob& job)
{
    std::string lights;
    for (const ChosenMapLight& light : job.lights)
        lights += (lights.empty() ? "" : "; ") + in_words(light, job.file);
    add_tag(tags, "LIGHTS", std::move(lights));
    const LightMapOptions options = job.options.map.light();
    add_tag(tags, "LIGHT_MODEL", std::string(job.options.map.model->name));
    add_tag(tags, "AMBIENT", fmt::format("{:g}", options.ambient));
    add_tag(tags, "NORMALS", job.options.map.packed_normals ? "packed" : "exact");
    add_tag(tags, "SHADOWS", shadows_in_words(job.options.map));
    add_tag(tags, "CASTER", std::string(job.caster.name));
}

RasterTags tags_of(const LightJob& job, const Report& report)
{
    RasterTags tags;
    if (job.lights.size() == 1 && job.lights.front().sun)
        tags = light_tags(*job.lights.front().sun, job.file);
    else
        add_tag(tags, "SOFTWARE", "duskline " DUSKLINE_VERSION);
    add_light_tags(tags, job);
    add_height_tags(tags, job.file, job.curvature);
    add_assumptions(tags, report);
    return tags;
}

RasterContent content_of(const LightJob& job, const LightPixels& pixels, bool opacity, const Report& report)
{
    RasterContent content;
    content.samples = samples_of(pixels, opacity);
    content.rows = job.size.rows;
    content.columns = job.size.columns;
    if (job.options.map.depth == SampleDepth::real)
        content.no_data = static_cast<double>(kNoLight);
    else if (zero_is_no_data(job))
        content.no_data = 0.0;
    content.description = "light, " + std::string(job.options.map.model->name);
    content.tags = tags_of(job, report);
    add_tag(content.tags, "ENCODING", encoding_in_words(job, opacity));
    return content;
}

// What can be wrong with the output is said before any work.
void require_writable(const LightJob& job, const Report& report)
{
    const OutputOptions& output = job.options.output;
    if (job.mesh)
        return require_writable_ply(output.path, job.file, output.overwrite);
    const bool grey = job.options.map.texture.empty();
    const LightMap trial{std::vector<Grid<float>>(grey ? 1U : 3U)};
    const RasterWriter writer(output.path, job.file,
                              content_of(job, {.map = trial, .depth = job.options.map.depth}, false, report),
                              write_options(output, job.options.run));
}

void write_raster(const LightJob& job, const MapGround& ground, const LightMap& map, Report& report)
{
    const WriteOptions options = write_options(job.options.output, job.options.run);
    LightPixels pixels{.map = map, .texture = ground.texture.view(), .depth = job.options.map.depth};
    const bool opacity = pixels.depth != SampleDepth::real && !zero_is_no_data(job) && !is_opaque(pixels);
    const std::string format = output_format(job.options.output.path, options);
    pixels.over_white = opacity && (format == "JPEG" || format == "BMP");
    if (pixels.over_white)
        report.warn("the format has no transparency: what is without data is white");
    const RasterContent content = content_of(job, pixels, opacity && !pixels.over_white, report);
    RasterWriter writer(job.options.output.path, job.file, content, options);
    write_pixels(writer, pixels, content.samples, job.bar.part(0.87, 0.95));
    writer.finish(job.bar.part(0.95, 1.0));
}

std::vector<std::string> mesh_comments(const LightJob& job, const Report& report)
{
    const HeightFileFacts& facts = job.file.facts();
    std::vector<std::string> comments;
    if (facts.geotransform) {
        const auto& gt = *facts.geotransform;
        const double x = static_cast<double>(facts.columns) / 2.0;
        const double y = static_cast<double>(facts.rows) / 2.0;
        comments.push_back(fmt::format("x 0, y 0 is {:.10g} {:.10g} of {}", gt[0] + x * gt[1] + y * gt[2],
                                       gt[3] + x * gt[4] + y * gt[5],
                                       facts.crs_name.empty() ? "the map" : facts.crs_name));
    }
    for (const auto& [key, value] : tags_of(job, report)) {
        comments.push_back(fmt::format("{}={}", key, value));
        std::ranges::replace(comments.back(), '\n', ' ');
    }
    return comments;
}

void write_mesh(const LightJob& job, MapGround& ground, const LightMap& map, const Report& report)
{
    raise_again(job, ground);
    Grid<std::array<std::uint8_t, 3>> colours(job.size.rows, job.size.columns);
    const LightPixels pixels{
        .map = map, .texture = ground.texture.view(), .over_white = !ground.texture.empty()};
    for (std::size_t row = 0; row < colours.rows(); ++row)
        fill_colours(pixels, row, colours.row(row));
    write_ply(job.options.output.path, job.file,
              {.field = ground.of_map(),
               .normals = ground.normals,
               .colours = colours.view(),
               .base_m = job.file.facts().base_m,
               .comments = mesh_comments(job, report)},
              job.options.output.overwrite, job.bar.part(0.88, 1.0));
}

// ---------------------------------------------------------------------------------------------------------
// What is said

nlohmann::ordered_json as_json(const ChosenMapLight& light, const HeightFile& file)
{
    nlohmann::ordered_json json;
    if (light.sun) {
        const DirectionalLight& sun = light.sun->light;
        json["azimuth_deg"] = wrapped_to_circle(sun.azimuth + file.ground().grid_north).degrees();
        json["altitude_deg"] = sun.altitude.degrees();
        if (light.sun->time)
            json["time_utc"] = to_iso8601({light.sun->time->utc});
    } else {
        json["x"] = light.lamp->x;
        json["y"] = light.lamp->y;
        json["height_m"] = light.lamp->height_m;
        json["reach_m"] = light.reach_m;
    }
    json["strength"] = light.strength;
    json["colour"] = {light.colour.red, light.colour.green, light.colour.blue};
    json["shadows"] = light.casts;
    return json;
}

void report_job(const LightJob& job, Report& report)
{
    for (const ChosenMapLight& light : job.lights)
        report.json()["lights"].push_back(as_json(light, job.file));
    report.field("model", job.options.map.model->name);
    report.field("ambient", job.options.map.light().ambient);
    report.field("shadows", shadows_in_words(job.options.map));
    report.field("normals", job.options.map.packed_normals ? "packed" : "exact");
    report.field("curvature", job.curvature.coefficient);
    report.field("caster", job.caster.name);
}

struct LightTally {
    double sum = 0.0;
    std::size_t cells = 0;
    std::size_t no_data = 0;
};

LightTally tally_of(const LightMap& map)
{
    LightTally tally;
    const auto channels = static_cast<double>(map.channels.size());
    for (std::size_t i = 0; i < map.channels.front().size(); ++i) {
        double light = 0.0;
        for (const Grid<float>& channel : map.channels)
            light += channel.values()[i];
        ++(std::isnan(light) ? tally.no_data : tally.cells);
        tally.sum += std::isnan(light) ? 0.0 : light / channels;
    }
    return tally;
}

void report_outcome(const LightJob& job, const LightMap& map, const LightSeconds& seconds, Report& report)
{
    const LightTally tally = tally_of(map);
    const double mean = tally.cells == 0 ? 0.0 : tally.sum / static_cast<double>(tally.cells);
    const char* depth = kDepthNames.at(static_cast<std::size_t>(job.options.map.depth));
    report.line(
        fmt::format("{}: {} x {} {}, {} {}, mean light {:.3f}, {} without data", job.options.output.path,
                    job.size.columns, job.size.rows, job.mesh ? "vertices" : "pixels",
                    map.channels.size() == 1 ? "grey" : "red, green and blue", depth, mean, tally.no_data));
    report.field("output", job.options.output.path);
    report.field("columns", job.size.columns);
    report.field("rows", job.size.rows);
    report.field("channels", map.channels.size());
    report.field("type", depth);
    report.field("mean_light", mean);
    report.field("no_data", tally.no_data);
    report.json()["seconds"] = {{"reading", seconds.reading},
                                {"casting", seconds.casting},
                                {"lighting", seconds.lighting},
                                {"writing", seconds.writing},
                                {"total", seconds.total}};
    if (job.options.run.verbose)
        report.note(
            fmt::format("{:.3f} s in all; reading {:.3f} s, casting {:.3f} s, lighting {:.3f} s, writing "
                        "{:.3f} s",
                        seconds.total, seconds.reading, seconds.casting, seconds.lighting, seconds.writing));
}

LightMap make_and_write(const LightJob& job, LightSeconds& seconds, Report& report)
{
    MapGround ground;
    {
        const Stopwatch watch(seconds.reading);
        ground = read_ground(job, report);
    }
    LightMap map = make_map(job, ground, seconds);
    const Stopwatch watch(seconds.writing);
    if (job.mesh)
        write_mesh(job, ground, map, report);
    else
        write_raster(job, ground, map, report);
    if (!job.bar.part(1.0, 1.0)(1.0))
        throw Cancelled();
    return map;
}

void run_light(const LightCommandOptions& options)
{
    LightSeconds seconds;
    Report report("light", options.run);
    ProgressBar bar(options.run);
    const Caster& caster = chosen_caster(options.caster);
    require_possible(options);
    HeightFile file = open_heights(options.input, options.run, report);
    const MapSize size = choose_map_size(options.map, {file.rows(), file.columns()});
    const EarthCurvature curvature = choose_curvature(options.input, file, report);
    const LightJob job = {.options = options,
                          .file = file,
                          .lights = choose_map_lights(options.lights, options.input, options.run, file,
                                                      curvature, options.map.soft, report),
                          .curvature = curvature,
                          .caster = caster,
                          .size = size,
                          .mesh = is_mesh(options.output),
                          .bar = bar};
    if (has_lamps(job))
        require_takes_lamps(caster);
    report_job(job, report);
    require_writable(job, report);
    require_memory(size.rows, size.columns, bytes_per_cell(job),
                   "the light map of '" + file.facts().path + "'");
    LightMap map;
    {
        const Stopwatch watch(seconds.total);
        map = make_and_write(job, seconds, report);
    }
    report_outcome(job, map, seconds, report);
    report.finish();
}

} // namespace

Run declare_light(CLI::App& app)
{
    const auto options = std::make_shared<LightCommandOptions>();
    add_input_options(app, options->input);
    add_output_options(app, options->output);
    add_map_light_options(app, options->lights);
    add_light_map_options(app, options->map);
    add_caster_option(app, options->caster);
    add_run_options(app, options->run);
    add_details(app, "OUTPUT says how much light falls on every cell of INPUT, cast shadows included: to "
                     "multiply colours with, in "
                     "a map or in an engine. It is one grey band, or red, green and blue when a light or the "
                     "ambient light has a "
                     "colour or a texture is given, and an opacity of 0 where there is no data. Light from 0 "
                     "to 1 is stored as 0 "
                     "to 255 (--ot); light beyond 1 is 1. An OUTPUT that ends in .ply is a mesh of triangles "
                     "with the light as the "
                     "colours of its vertices.\n\n"
                     "Without a light it comes from the north-west (azimuth 315), 45 degrees high.");
    add_example(app, "the light of a summer evening, for a texture unit",
                "duskline light dem.tif light.png --time 2026-06-21T18:30-10:00");
    add_example(app, "gdaldem hillshade's numbers, with the shadows that are cast",
                "duskline light dem.tif shade.tif --model hillshade --azimuth 315 --altitude 30");
    add_example(app, "a low warm sun and the blue of the sky, four times as fine as the heights",
                "duskline light dem.tif warm.tif --light azimuth=240,altitude=8,colour=#ffcc88 --ambient 0.3 "
                "--ambient-colour 88aaff --size 8192 --antialias");
    add_example(
        app, "a lamp 30 m above the ground, and moonlight that casts no shadows",
        "duskline light dem.tif night.tif --light point=243500,2193200,+30,colour=#ffaa55,reach=2000 --light "
        "azimuth=90,altitude=40,strength=0.1,shadows=no --ambient 0");
    add_example(app, "an aerial photograph in evening light",
                "duskline light dem.tif evening.tif --texture photo.tif --azimuth 240 --altitude 20");
    add_example(app, "the same as a mesh with colours",
                "duskline light dem.tif evening.ply --texture photo.tif --azimuth 240 --altitude 20");
    return [options] { run_light(*options); };
}

} // namespace duskline::cli
