#pragma once

#include "cli11_names.h"
#include "run_options.h"

#include <duskline/raster_io/raster_writer.h>

#include <string>
#include <vector>

namespace duskline::cli {

/// Where and how to write: OUTPUT, --of, --co, --overwrite.
struct OutputOptions {
    std::string path;
    std::string format;                        ///< GDAL driver name; empty: by the file name's extension
    std::vector<std::string> creation_options; ///< KEY=VALUE, for GDAL
    bool overwrite = false;
};

/// `options` must outlive `app`'s parsing. Call after add_input_options: INPUT comes first.
void add_output_options(CLI::App& app, OutputOptions& options);

/// The same for whoever writes.
WriteOptions write_options(const OutputOptions& options, const RunOptions& run);

} // namespace duskline::cli
