#include "caster_option.h"
#include "command.h"
#include "exit_code.h"
#include "height_input.h"
#include "help_page.h"
#include "light_options.h"
#include "output_options.h"
#include "picture_options.h"
#include "progress_bar.h"
#include "raster_site.h"
#include "raster_tags.h"
#include "report.h"
#include "run_options.h"
#include "stopwatch.h"

#include <duskline/casting/visible_fraction.h>
#include <duskline/products/relief.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/read_colours.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace duskline::cli {
namespace {

struct ReliefCommandOptions {
    InputOptions input;
    OutputOptions output;
    LightOptions light;
    PictureOptions picture;
    std::string caster;
    bool soft = false;
    RunOptions run;
};

// Heights, texture, heights lowered for the curvature, shadow heights, lit fraction; when lowered heights and
// shadow heights are gone, water and the picture come instead. For soft edges the visible fraction and its masks, but
// shadow heights no more.
constexpr double kBytesPerCell = 20.0;
constexpr double kBytesPerCellSoft = 24.5;

// Everything there is to know once the options are settled.
struct ReliefJob {
    const ReliefCommandOptions& options;
    HeightFile& file;
    DirectionalLight light;
    EarthCurvature curvature;
    const Caster& caster;
    ProgressBar& bar;

    Execution execution(double from, double to) const
    {
        return {.threads = options.run.threads, .progress = bar.part(from, to)};
    }
};

struct Seconds {
    double reading = 0.0;
    double casting = 0.0;
    double shading = 0.0;
    double writing = 0.0;
    double total = 0.0;
};

Terrain lowered(const ReliefJob& job, const Terrain& terrain)
{
    Terrain result{terrain.heights_m.copy(), terrain.cell_size_m};
    CurvedEarth(job.curvature, terrain.cell_size_m, terrain.heights_m.columns())
        .lower(result.heights_m.view());
    return result;
}

// Edges within cells where they are hard, and soft where the half-shadow is wide enough to be seen.
void soften(LitFraction& lit, const VisibleFraction& seen)
{
    std::ranges::transform(lit.values(), seen.values(), lit.values().begin(),
                           [](float hard, float soft) { return soft > 0.0f && soft < 1.0f ? soft : hard; });
}

LitFraction hard_edges_on(const ReliefJob& job, const HeightField& field)
{
    const ShadowField shadows = job.caster.shadow_heights(field, job.light, job.execution(0.2, 0.5));
    return lit_fraction(field, shadows, job.light, job.execution(0.5, 0.55));
}

LitFraction cast_on(const ReliefJob& job, const HeightField& field)
{
    LitFraction lit = hard_edges_on(job, field);
    if (job.options.soft)
        soften(lit, visible_fraction(field, job.light, job.caster, job.execution(0.55, 0.65)));
    return lit;
}

LitFraction cast(const ReliefJob& job, const Terrain& terrain)
{
    if (job.curvature.coefficient == 0.0)
        return cast_on(job, terrain);
    const Terrain fallen_away = lowered(job, terrain);
    return cast_on(job, fallen_away);
}

// What the ground looks like before it is lit.
struct Ground {
    Terrain terrain;
    Tint tint;
    Grid<Rgba8> texture; // empty: none
};

Ground read_ground(const ReliefJob& job, Report& report)
{
    const PictureOptions& wanted = job.options.picture;
    Ground ground;
    ground.terrain = read_terrain(job.file, job.execution(0.0, 0.15));
    report_reading(job.file, report);
    ground.tint = choose_tint(wanted, ground.terrain, job.file, report);
    if (!wanted.texture.empty())
        ground.texture = read_colours(wanted.texture, job.file, job.execution(0.15, 0.2));
    return ground;
}

Picture shade(const ReliefJob& job, const Ground& ground, const LitFraction& lit, Report& report)
{
    const PictureOptions& wanted = job.options.picture;
    const ReliefOptions options = {
        .tint = ground.tint,
        .texture = ground.texture.view(),
        .exaggeration = wanted.exaggeration.value_or(shading_exaggeration(ground.terrain, job.light)),
        .ambient = choose_ambient(wanted, job.file),
        .curvature = job.curvature,
        .air = has_air(job.file)};
    report.field("exaggeration", *options.exaggeration);
    report.field("ambient", options.ambient);
    report.note(fmt::format("slopes are shaded as if {:.2f} times as steep", *options.exaggeration));
    Picture picture = relief(ground.terrain, job.light, lit, options, job.execution(0.65, 0.85));
    const PictureSize size = choose_size(wanted, job.file);
    if (size.rows != picture.rows() || size.columns != picture.columns())
        picture = shrunk(picture, size.rows, size.columns, job.execution(0.85, 0.9));
    return picture;
}

Picture draw(const ReliefJob& job, Seconds& seconds, Report& report)
{
    const double bytes_per_cell = job.options.soft ? kBytesPerCellSoft : kBytesPerCell;
    require_memory(job.file.rows(), job.file.columns(), bytes_per_cell + job.caster.bytes_per_cell,
                   "'" + job.file.facts().path + "'");
    Ground ground;
    {
        const Stopwatch watch(seconds.reading);
        ground = read_ground(job, report);
    }
    LitFraction lit;
    {
        const Stopwatch watch(seconds.casting);
        lit = cast(job, ground.terrain);
    }
    const Stopwatch watch(seconds.shading);
    return shade(job, ground, lit, report);
}

bool is_opaque(const Picture& picture)
{
    return std::ranges::all_of(picture.values(), [](const Rgba8& pixel) { return pixel[3] == 255; });
}

using Rgb8 = std::array<std::uint8_t, 3>;

// The colours alone, laid over white where they are not opaque.
Grid<Rgb8> over_white(const Picture& picture)
{
    Grid<Rgb8> result(picture.rows(), picture.columns());
    std::ranges::transform(picture.values(), result.values().begin(), [](const Rgba8& pixel) {
        const auto blend = [&](unsigned colour) {
            const unsigned opacity = pixel[3];
            return static_cast<std::uint8_t>((colour * opacity + 255U * (255U - opacity) + 127U) / 255U);
        };
        return Rgb8{blend(pixel[0]), blend(pixel[1]), blend(pixel[2])};
    });
    return result;
}

// Formats of pictures that have no transparency.
bool is_opaque_format(const std::string& format)
{
    return format == "JPEG" || format == "BMP";
}

RasterContent content_of(const ReliefJob& job, const ChosenLight& chosen, Samples samples,
                         const Report& report)
{
    const PictureSize size = choose_size(job.options.picture, job.file);
    RasterContent content;
    content.samples = samples;
    content.rows = size.rows;
    content.columns = size.columns;
    content.tags = light_tags(chosen, job.file);
    if (job.options.soft)
        add_tag(content.tags, "LIGHT_DIAMETER", fmt::format("{:.6g}", job.light.angular_diameter.degrees()));
    add_tag(content.tags, "CASTER", std::string(job.caster.name));
    add_height_tags(content.tags, job.file, job.curvature);
    add_assumptions(content.tags, report);
    return content;
}

// What can be wrong with the output is said before any work.
void require_writable(const ReliefJob& job, const ChosenLight& chosen, const Report& report)
{
    const RasterWriter trial(job.options.output.path, job.file, content_of(job, chosen, Samples::rgb, report),
                             write_options(job.options.output, job.options.run));
}

template <typename Pixel>
void write_whole(RasterWriter& writer, const Grid<Pixel>& pixels, const ProgressCallback& progress)
{
    writer.write(0, 0, pixels.view());
    writer.finish(progress);
    if (!progress(1.0))
        throw Cancelled();
}

void write(const ReliefJob& job, const ChosenLight& chosen, const Picture& picture, Report& report)
{
    const WriteOptions options = write_options(job.options.output, job.options.run);
    const bool opaque = is_opaque(picture);
    const bool flat = is_opaque_format(output_format(job.options.output.path, options));
    if (flat && !opaque)
        report.warn("the format has no transparency: what is without data is white");
    const Samples samples = opaque || flat ? Samples::rgb : Samples::rgba;
    RasterWriter writer(job.options.output.path, job.file, content_of(job, chosen, samples, report), options);
    if (samples == Samples::rgb)
        write_whole(writer, over_white(picture), job.bar.part(0.9, 1.0));
    else
        write_whole(writer, picture, job.bar.part(0.9, 1.0));
}

void report_light(const ReliefJob& job, const ChosenLight& chosen, Report& report)
{
    report.field("azimuth_deg",
                 wrapped_to_circle(job.light.azimuth + job.file.ground().grid_north).degrees());
    report.field("altitude_deg", job.light.altitude.degrees());
    if (chosen.time)
        report.field("time_utc", to_iso8601({chosen.time->utc}));
    report.field("curvature", job.curvature.coefficient);
    report.field("caster", job.caster.name);
}

void report_outcome(const ReliefJob& job, const Picture& picture, const Seconds& seconds, Report& report)
{
    report.line(fmt::format("{}: {} x {} pixels, light from azimuth {:.1f}, {:.1f} degrees high",
                            job.options.output.path, picture.columns(), picture.rows(),
                            wrapped_to_circle(job.light.azimuth + job.file.ground().grid_north).degrees(),
                            job.light.altitude.degrees()));
    report.field("output", job.options.output.path);
    report.field("columns", picture.columns());
    report.field("rows", picture.rows());
    report.json()["seconds"] = {{"reading", seconds.reading},
                                {"casting", seconds.casting},
                                {"shading", seconds.shading},
                                {"writing", seconds.writing},
                                {"total", seconds.total}};
    if (job.options.run.verbose)
        report.note(
            fmt::format("{:.3f} s in all; reading {:.3f} s, casting {:.3f} s, shading {:.3f} s, writing "
                        "{:.3f} s",
                        seconds.total, seconds.reading, seconds.casting, seconds.shading, seconds.writing));
}

void run_relief(const ReliefCommandOptions& options)
{
    Seconds seconds;
    Report report("relief", options.run);
    ProgressBar bar(options.run);
    const Caster& caster = chosen_caster(options.caster);
    require_palette(options.picture);
    HeightFile file = open_heights(options.input, options.run, report);
    LightOptions light = with_usual_light(options.light, report);
    light.disc_counts = options.soft;
    const ChosenLight chosen = choose_light(light, light_site(file.ground()), report);
    const EarthCurvature curvature = choose_curvature(options.input, file, report);
    const ReliefJob job = {options, file, chosen.light, curvature, caster, bar};
    report_light(job, chosen, report);
    require_writable(job, chosen, report);
    Picture picture;
    {
        const Stopwatch total(seconds.total);
        picture = draw(job, seconds, report);
        const Stopwatch writing(seconds.writing);
        write(job, chosen, picture, report);
    }
    report_outcome(job, picture, seconds, report);
    report.finish();
}

} // namespace

Run declare_relief(CLI::App& app)
{
    const auto options = std::make_shared<ReliefCommandOptions>();
    add_input_options(app, options->input);
    add_output_options(app, options->output);
    add_light_options(app, options->light);
    add_picture_options(app, options->picture);
    app.add_flag("--soft", options->soft,
                 "soft edges of shadows, as wide as the light's disc (--sun-size) makes them")
        ->group("Picture");
    add_caster_option(app, options->caster);
    add_run_options(app, options->run);
    add_details(
        app,
        "OUTPUT is a picture of red, green and blue, and of opacity where INPUT has cells without data, on "
        "the grid of INPUT: GeoTIFF, PNG, JPEG or any other format that GDAL can write colours to. Ground "
        "is coloured by height or by a texture, lit by the light and by the sky, and lies in the shadows "
        "that are really cast. Shadow edges are drawn within cells, not blurred.\n\n"
        "Without a light it comes from the north-west (azimuth 315), 45 degrees high.");
    add_example(app, "an evening in June",
                "duskline relief dem.tif evening.png --time 2026-06-21T18:30-10:00");
    add_example(app, "a small picture in the colours of an atlas",
                "duskline relief dem.tif small.jpg --palette atlas --size 1024 --azimuth 315 --altitude 30");
    add_example(app, "an aerial photograph with the shadows of a winter morning",
                "duskline relief dem.tif winter.tif --texture photo.tif --time 2026-12-21T08:30+01:00");
    return [options] { run_relief(*options); };
}

} // namespace duskline::cli
