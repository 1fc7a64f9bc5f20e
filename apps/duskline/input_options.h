#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace duskline::cli {

/// Which heights to read and how to take them: INPUT, -b, --oo, -z, --z-unit, --curvature, --flat.
struct InputOptions {
    std::string path;
    std::size_t band = 1;                    ///< counted from 1
    std::vector<std::string> open_options;   ///< KEY=VALUE, for GDAL
    double z_factor = 1.0;                   ///< heights are multiplied by it
    std::optional<double> metres_per_z_unit; ///< given by --z-unit; else the file says
    std::optional<double> curvature;         ///< coefficient; 0 for a flat earth; else the file decides
};

/// `options` must outlive `app`'s parsing.
void add_input_options(CLI::App& app, InputOptions& options);

} // namespace duskline::cli
