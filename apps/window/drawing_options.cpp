#include "drawing_options.h"

#include "exit_code.h"
#include "help_page.h"
#include "option_values.h"

#include <duskline/raster_io/file_errors.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace duskline::window {
namespace {

using cli::UsageError;

constexpr std::size_t kLeastPixels = 16;
constexpr std::size_t kMostPixels = 16384;

void read_size(const std::string& typed, DrawingOptions& options)
{
    const std::size_t cross = typed.find('x');
    if (cross == std::string::npos)
        throw UsageError(fmt::format("--size must be width x height such as 1024x768, got '{}'", typed));
    options.width = cli::parse_count("--size", typed.substr(0, cross), kLeastPixels);
    options.height = cli::parse_count("--size", typed.substr(cross + 1), kLeastPixels);
    if (options.width > kMostPixels || options.height > kMostPixels)
        throw UsageError(fmt::format("--size must be at most {0}x{0}, got '{1}'", kMostPixels, typed));
}

void require_new(const std::string& path, bool overwrite)
{
    if (!overwrite && std::filesystem::exists(path))
        throw OutputError(fmt::format("'{}' is there already: --overwrite replaces it", path));
}

} // namespace

void add_size_option(CLI::App& app, DrawingOptions& options, const std::string& group)
{
    app.add_option_function<std::string>(
           "--size", [&options](const std::string& typed) { read_size(typed, options); },
           "of the window or the picture, pixels")
        ->type_name("WxH")
        ->default_str("1024x768")
        ->group(group);
}

void add_render_option(CLI::App& app, DrawingOptions& options)
{
    app.add_option("--render", options.render, "write one picture, needs no display; PNG, JPEG, ...")
        ->type_name("FILE")
        ->group(kHeadlessGroup);
}

void add_soak_options(CLI::App& app, DrawingOptions& options, const std::string& soak_text)
{
    cli::add_number(app, {.names = "--soak", .unit = "SECONDS", .text = soak_text, .range = {0.0, 1e6, true}},
                    options.soak_s)
        ->group(kHeadlessGroup);
    app.add_option_function<std::string>(
           "--seed",
           [&options](const std::string& typed) { options.seed = cli::parse_count("--seed", typed, 0); },
           "of --soak: the same random use for the same number")
        ->type_name("N")
        ->default_str("1")
        ->group(kHeadlessGroup);
}

void add_output_options(CLI::App& app, DrawingOptions& options, const std::string& flight)
{
    app.add_option("--report", options.report, "write the figures of " + flight + " to a JSON file")
        ->type_name("FILE")
        ->group(kHeadlessGroup);
    app.add_option("--frames", options.frames,
                   "write the pictures of " + flight + " into a folder that is there")
        ->type_name("FOLDER")
        ->group(kHeadlessGroup);
    app.add_flag("--overwrite", options.overwrite, "replace files that are there")->group(kHeadlessGroup);
}

void require_one_task(const DrawingOptions& options, bool flies, const std::string& flight)
{
    if (!options.render.empty() && flies)
        throw UsageError(fmt::format("give --render or {}, not both", flight));
    if (options.soak_s && (!options.render.empty() || flies))
        throw UsageError(fmt::format("--soak goes alone: leave --render and {} out", flight));
    if (!flies && (!options.report.empty() || !options.frames.empty()))
        throw UsageError(
            fmt::format("--report and --frames say where {0} leaves what it finds: give {0} FRAMES", flight));
}

void require_new_picture(const DrawingOptions& options)
{
    require_new(options.render, options.overwrite);
}

void require_new_report(const DrawingOptions& options)
{
    if (!options.report.empty())
        require_new(options.report, options.overwrite);
    if (!options.frames.empty() && !std::filesystem::is_directory(options.frames))
        throw OutputError(fmt::format("--frames: there is no folder '{}'", options.frames));
}

void write_report(const DrawingOptions& options, const nlohmann::ordered_json& json)
{
    if (options.report.empty())
        return;
    std::ofstream file(options.report);
    file << json.dump(2) << '\n';
    file.close();
    if (!file)
        throw OutputError(fmt::format("cannot write '{}'", options.report));
}

} // namespace duskline::window
