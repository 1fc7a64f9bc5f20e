#include "input_options.h"

#include "exit_code.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Heights";

double metres_per(const std::string& unit)
{
    if (unit == "m")
        return 1.0;
    if (unit == "ft")
        return 0.3048;
    if (unit == "us-ft")
        return 1200.0 / 3937.0;
    throw UsageError(fmt::format("--z-unit must be m, ft or us-ft, got '{}'", unit));
}

void add_unit(CLI::App& app, InputOptions& options)
{
    add_number(app,
               {.names = "-z,--z-factor",
                .unit = "F",
                .text = "multiply heights by F",
                .range = {.least = 0.0, .above = true}},
               options.z_factor)
        ->group(kGroup);
    const auto read = [&options](const std::string& typed) { options.metres_per_z_unit = metres_per(typed); };
    app.add_option_function<std::string>(
           "--z-unit", read, "unit of the heights; else taken from the band or the CRS, else metres")
        ->type_name("m|ft|us-ft")
        ->group(kGroup);
}

void add_curvature(CLI::App& app, InputOptions& options)
{
    auto* coefficient =
        add_number(app,
                   {.names = "--curvature",
                    .unit = "C",
                    .text = "how much the ground falls away under a ray of light: 1 round earth "
                            "without air, 0.857 (6/7) with usual air, 0 flat; else 6/7 on the "
                            "Earth, 1 on other bodies, 0 without a CRS",
                    .range = {.least = 0.0, .most = 1.0}},
                   options.curvature)
            ->group(kGroup);
    app.add_flag_function(
           "--flat", [&options](std::int64_t) { options.curvature = 0.0; }, "flat earth, as --curvature 0")
        ->excludes(coefficient)
        ->group(kGroup);
}

} // namespace

void add_input_options(CLI::App& app, InputOptions& options)
{
    app.add_option("INPUT", options.path, "elevation model: any raster that GDAL reads")->required();
    const auto read_band = [&options](const std::string& typed) {
        options.band = parse_count("--band", typed, 1);
    };
    app.add_option_function<std::string>("-b,--band", read_band, "band with the heights, from 1 up")
        ->type_name("N")
        ->default_str("1")
        ->group(kGroup);
    app.add_option("--oo", options.open_options, "open option of the input's GDAL driver; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group(kGroup);
    add_number(app,
               {.names = "--cell-size",
                .unit = "METRES",
                .text = "width and height of a cell; else the file says",
                .range = {.least = 0.0, .above = true}},
               options.cell_size_m)
        ->group(kGroup);
    add_number(app,
               {.names = "--nodata",
                .unit = "VALUE",
                .text = "a stored number that means no data, besides those the file declares"},
               options.no_data)
        ->group(kGroup);
    add_unit(app, options);
    add_curvature(app, options);
}

} // namespace duskline::cli
