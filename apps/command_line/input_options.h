#pragma once

#include "cli11_names.h"

#include <optional>
#include <string>
#include <vector>

namespace duskline::cli {

/// Which heights to read and how to take them: INPUT, -b, --oo, --cell-size, --nodata, -z, --z-unit,
/// --curvature, --flat.
struct InputOptions {
    std::string path;
    std::size_t band = 0;                    ///< counted from 1; 0: the first, unless it is a colour
    std::vector<std::string> open_options;   ///< KEY=VALUE, for GDAL
    std::optional<double> cell_size_m;       ///< else the file says
    std::optional<double> no_data;           ///< a stored value that means no data, besides the file's own
    double z_factor = 1.0;                   ///< heights are multiplied by it
    std::optional<double> metres_per_z_unit; ///< given by --z-unit; else the file says
    std::optional<double> curvature;         ///< coefficient; 0 for a flat earth; else the file decides
};

/// `options` must outlive `app`'s parsing.
void add_input_options(CLI::App& app, InputOptions& options);

} // namespace duskline::cli
