#pragma once

#include "cli11_names.h"

#include <cstddef>

namespace duskline::cli {

/// How a command runs and what it says while doing so: -j, -q, -v, --json.
struct RunOptions {
    std::size_t threads = 0; ///< 0: every core
    bool quiet = false;      ///< no progress, no summary; warnings and errors stay
    bool verbose = false;    ///< notes on what was assumed
    bool json = false;       ///< the summary as one JSON object on stdout
};

/// `options` must outlive `app`'s parsing.
void add_run_options(CLI::App& app, RunOptions& options);

/// Only -v and --json, for commands that are quick and whose summary is all they make.
void add_report_options(CLI::App& app, RunOptions& options);

} // namespace duskline::cli
