#include "picture_options.h"

#include "exit_code.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Picture";

std::string names_of_tints()
{
    std::string names;
    for (const NamedTint& tint : named_tints())
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", tint.name, tint.description);
    return names;
}

void read_sea(PictureOptions& options, const std::string& typed)
{
    options.no_sea = typed == "none";
    if (options.no_sea)
        options.sea_level_m = std::nullopt;
    else
        options.sea_level_m = parse_number("--sea", typed);
}

void add_colours(CLI::App& app, PictureOptions& options)
{
    app.add_option(
           "--palette", options.palette,
           fmt::format("colours by height: {}; or a file as for gdaldem color-relief, in the unit of the "
                       "heights; else natural, moon or mars by the body in the CRS",
                       names_of_tints()))
        ->type_name("NAME|FILE")
        ->group(kGroup);
    app.add_option(
           "--texture", options.texture,
           "raster of colours (8 bits: RGB, RGBA, grey or paletted) to lay over the terrain, warped to it "
           "where needed; the palette shows where it is transparent or ends")
        ->type_name("FILE")
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--sea", [&options](const std::string& typed) { read_sea(options, typed); },
           "sea level: what lies lower is sea floor, and where nothing does, what lies level with it is "
           "water; "
           "none for land only; else found from the heights. Not with a FILE for a palette")
        ->type_name("METRES|none")
        ->group(kGroup);
}

std::string content_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.is_open() || file.bad())
        throw UsageError(fmt::format("--palette: '{}' is the name of no palette and cannot be read as a file "
                                     "({}); names are {}",
                                     path, std::strerror(errno), names_of_tints()));
    return text;
}

// Heights in the text are those of the file; the terrain is in metres above the base.
Palette in_metres(const Palette& palette, const HeightFileFacts& facts)
{
    std::vector<Palette::Entry> entries = palette.entries();
    for (Palette::Entry& entry : entries)
        entry.height_m = entry.height_m * facts.metres_per_unit * facts.z_factor - facts.base_m;
    Palette result(std::move(entries));
    result.no_data = palette.no_data;
    return result;
}

Palette palette_in(const std::string& path, double lowest, double highest)
{
    const std::string text = content_of(path);
    try {
        return palette_from_text(text, lowest, highest);
    } catch (const InvalidInput& error) {
        throw UsageError(fmt::format("--palette '{}': {}", path, error.what()));
    }
}

Tint tint_from_file(const std::string& path, const HeightSpan& span, const HeightFileFacts& facts)
{
    const auto as_in_file = [&](float height_m) {
        return (static_cast<double>(height_m) + facts.base_m) / (facts.metres_per_unit * facts.z_factor);
    };
    return plain_tint(
        in_metres(palette_in(path, as_in_file(span.lowest_m), as_in_file(span.highest_m)), facts));
}

bool is_name(const std::string& palette)
{
    return std::ranges::any_of(named_tints(), [&](const NamedTint& tint) { return tint.name == palette; });
}

std::string_view usual_palette(const HeightFile& file)
{
    if (has_air(file))
        return "natural";
    return file.ground().body->name == "Mars" ? "mars" : "moon";
}

Sea choose_sea(const PictureOptions& options, const HeightSpan& span, const HeightFile& file)
{
    if (options.sea_level_m) {
        const auto level_m = static_cast<float>(*options.sea_level_m - file.facts().base_m);
        return {span.lowest_m < level_m ? SeaKind::floor : SeaKind::surface, level_m};
    }
    // Other bodies have no sea, and heights from a planet's centre have no sea level.
    if (options.no_sea || !has_air(file) || file.facts().base_m != 0.0)
        return {};
    return likely_sea(span);
}

std::string in_words(const Sea& sea)
{
    switch (sea.kind) {
    case SeaKind::surface:
        return fmt::format("ground at {:g} m exactly is drawn as water", sea.level_m);
    case SeaKind::floor:
        return fmt::format("ground below {:g} m is drawn as sea floor", sea.level_m);
    case SeaKind::none:
        break;
    }
    return "no sea";
}

} // namespace

void add_look_options(CLI::App& app, PictureOptions& options)
{
    add_colours(app, options);
    add_number(app,
               {.names = "--ambient",
                .unit = "SHARE",
                .text =
                    "brightness of level ground in shadow, 1 being level ground in the light; else 0.28, and "
                    "0.06 on bodies without air",
                .range = {.least = 0.0, .most = 0.99}},
               options.ambient)
        ->group(kGroup);
}

void add_picture_options(CLI::App& app, PictureOptions& options)
{
    add_look_options(app, options);
    add_number(app,
               {.names = "--exaggeration",
                .unit = "F",
                .text =
                    "shade slopes as if they were F times as steep (shadows stay where they fall); else as "
                    "much as the terrain needs under this light, from 1 to 6",
                .range = {.least = 0.0, .above = true}},
               options.exaggeration)
        ->group(kGroup);
    app.add_option_function<std::string>(
           "--size", [&options](const std::string& typed) { options.size = parse_count("--size", typed, 1); },
           "pixels of the longer side of the picture, made smaller from that of the raster, which is the "
           "default")
        ->type_name("PIXELS")
        ->group(kGroup);
}

void require_palette(const PictureOptions& options)
{
    if (!options.palette.empty() && !is_name(options.palette))
        palette_in(options.palette, 0.0, 1.0);
}

Tint choose_tint(const PictureOptions& options, const HeightField& field, const HeightFile& file,
                 Report& report)
{
    const HeightSpan span = height_span(field);
    if (!options.palette.empty() && !is_name(options.palette)) {
        report.field("palette", options.palette);
        return tint_from_file(options.palette, span, file.facts());
    }
    const std::string name = options.palette.empty() ? std::string(usual_palette(file)) : options.palette;
    const Sea sea = choose_sea(options, span, file);
    report.field("palette", name);
    report.note(fmt::format("palette {}, {}", name, in_words(sea)));
    return fitted(tint_named(name), span, sea);
}

bool has_air(const HeightFile& file)
{
    return !file.ground().body || file.ground().body->is_earth;
}

double choose_ambient(const PictureOptions& options, const HeightFile& file)
{
    return options.ambient.value_or(has_air(file) ? 0.28 : 0.06);
}

PictureSize size_with_longer_side(std::string_view option, std::size_t pixels, const HeightFile& file)
{
    const std::size_t longer = std::max(file.rows(), file.columns());
    if (pixels > longer)
        throw UsageError(fmt::format("{} must be at most {}, the longer side of the raster, got {}", option,
                                     longer, pixels));
    const auto scaled = [&](std::size_t side) {
        const double exact =
            static_cast<double>(side) * static_cast<double>(pixels) / static_cast<double>(longer);
        return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(exact)));
    };
    return {scaled(file.rows()), scaled(file.columns())};
}

PictureSize choose_size(const PictureOptions& options, const HeightFile& file)
{
    if (!options.size)
        return {file.rows(), file.columns()};
    return size_with_longer_side("--size", *options.size, file);
}

} // namespace duskline::cli
