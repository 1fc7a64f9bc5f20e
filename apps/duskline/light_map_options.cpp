#include "light_map_options.h"

#include "colour_text.h"
#include "exit_code.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Map";

MapSize parse_size(const std::string& text)
{
    const std::size_t x = text.find('x');
    if (x == std::string::npos)
        return {.rows = parse_count("--size", text, 1)};
    return {.rows = parse_count("height of --size", text.substr(x + 1), 1),
            .columns = parse_count("width of --size", text.substr(0, x), 1)};
}

bool parse_normals(const std::string& text)
{
    if (text != "exact" && text != "packed")
        throw UsageError(fmt::format("--normals must be exact or packed, got '{}'", text));
    return text == "packed";
}

void add_lighting(CLI::App& app, LightMapCommandOptions& options)
{
    app.add_option_function<std::string>(
           "--model", [&options](const std::string& typed) { options.model = &light_model_named(typed); },
           fmt::format("light on a slope, N its normal and L the direction to the light: {}",
                       names_of_models()))
        ->type_name("NAME")
        ->default_str(std::string(kLightModels.front().name))
        ->group(kGroup);
    add_number(app,
               {.names = "--ambient",
                .unit = "SHARE",
                .text = "light that reaches every cell; else " + usual_ambients(),
                .range = {.least = 0.0, .most = 1.0}},
               options.ambient)
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--ambient-colour",
           [&options](const std::string& typed) {
               options.ambient_colour = parse_colour("--ambient-colour", typed);
           },
           "its colour; the # may be left out")
        ->type_name("#RRGGBB")
        ->default_str("#ffffff")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--normals",
           [&options](const std::string& typed) { options.packed_normals = parse_normals(typed); },
           "normals as they are, or as they come back from a signed byte a component")
        ->type_name("exact|packed")
        ->default_str("exact")
        ->group(kGroup);
}

void add_form(CLI::App& app, LightMapCommandOptions& options)
{
    app.add_option(
           "--texture", options.texture,
           "raster of colours (8 bits: RGB, RGBA, grey or paletted) that the light is multiplied with, "
           "warped to the map where needed; the result is as opaque as it is")
        ->type_name("FILE")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--size", [&options](const std::string& typed) { options.size = parse_size(typed); },
           "pixels of the map's longer side, or of both; not fewer than the raster has. Shadows are cast "
           "anew "
           "for every pixel from the ground under it, which is bilinear between samples")
        ->type_name("PIXELS|WxH")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--ot", [&options](const std::string& typed) { options.depth = parse_depth(typed); },
           "type of the output's samples: light from 0 to 1 as 0 to 255, as 0 to 65535, or as it is")
        ->type_name("Byte|UInt16|Float32")
        ->default_str("Byte")
        ->group("Output");
}

void add_shadows(CLI::App& app, LightMapCommandOptions& options)
{
    auto* soft =
        app.add_flag("--soft", options.soft,
                     "shadows with soft edges, as wide as a sun's disc (--sun-size) makes them; lamps cast "
                     "hard ones");
    auto* antialias =
        app.add_flag("--antialias", options.antialias,
                     "hard edges of a sun's shadows drawn within cells: light by the share of the "
                     "cell's area that is lit");
    auto* none =
        app.add_flag("--no-shadows", options.no_shadows, "slopes are lit, and nothing is in the way");
    soft->group(kGroup)->excludes(antialias);
    antialias->group(kGroup);
    none->group(kGroup)->excludes(soft)->excludes(antialias);
}

} // namespace

std::string names_of_models()
{
    std::string names;
    for (const NamedLightModel& model : kLightModels)
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", model.name, model.description);
    return names;
}

std::string usual_ambients()
{
    std::string text;
    for (const NamedLightModel& model : kLightModels)
        text += fmt::format("{}{:g} with {}", text.empty() ? "" : ", ", model.usual_ambient, model.name);
    return text;
}

LightMapOptions LightMapCommandOptions::light() const
{
    return {.model = model->model,
            .ambient = ambient.value_or(model->usual_ambient),
            .ambient_colour = ambient_colour};
}

void add_light_map_options(CLI::App& app, LightMapCommandOptions& options)
{
    add_lighting(app, options);
    add_form(app, options);
    add_shadows(app, options);
}

MapSize choose_map_size(const LightMapCommandOptions& options, const MapSize& whole)
{
    if (!options.size)
        return whole;
    MapSize size = *options.size;
    if (size.columns == 0) {
        const std::size_t longer = std::max(whole.rows, whole.columns);
        const auto scaled = [&](std::size_t side) {
            const double exact = static_cast<double>(side) * static_cast<double>(options.size->rows)
                                 / static_cast<double>(longer);
            return static_cast<std::size_t>(std::lround(exact));
        };
        size = {scaled(whole.rows), scaled(whole.columns)};
    }
    if (size.rows < whole.rows || size.columns < whole.columns)
        throw UsageError(
            fmt::format("--size must be at least that of the raster, {}x{}, got {}x{}; gdal_translate "
                        "-outsize -r average makes a map smaller",
                        whole.columns, whole.rows, size.columns, size.rows));
    return size;
}

} // namespace duskline::cli
