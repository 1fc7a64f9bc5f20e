#include "output_options.h"

#include <CLI/CLI.hpp>

namespace duskline::cli {

void add_output_options(CLI::App& app, OutputOptions& options)
{
    constexpr auto group = "Output";
    app.add_option("OUTPUT", options.path, "raster to write; replaced only with --overwrite")->required();
    app.add_option("-f,--of", options.format,
                   "GDAL driver, such as GTiff, COG or PNG; else by the extension of OUTPUT")
        ->type_name("FORMAT")
        ->group(group);
    app.add_option("--co", options.creation_options,
                   "creation option of the output's GDAL driver; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group(group);
    app.add_flag("--overwrite", options.overwrite,
                 "replace OUTPUT if it exists, once the new one is complete")
        ->group(group);
}

WriteOptions write_options(const OutputOptions& options, const RunOptions& run)
{
    return {.format = options.format,
            .creation_options = options.creation_options,
            .overwrite = options.overwrite,
            .threads = run.threads};
}

} // namespace duskline::cli
