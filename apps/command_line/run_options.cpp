#include "run_options.h"

#include "option_values.h"

#include <CLI/CLI.hpp>

namespace duskline::cli {
namespace {

constexpr auto kGroup = "Running";

void add_threads(CLI::App& app, std::size_t& threads)
{
    const auto read = [&threads](const std::string& typed) {
        threads = typed == "ALL" ? 0 : parse_count("--threads", typed, 1);
    };
    app.add_option_function<std::string>("-j,--threads", read,
                                         "threads to use; the result does not depend on it")
        ->type_name("N|ALL")
        ->default_str("ALL")
        ->group(kGroup);
}

} // namespace

void add_run_options(CLI::App& app, RunOptions& options)
{
    add_threads(app, options.threads);
    auto* quiet = app.add_flag("-q,--quiet", options.quiet, "no progress bar and no summary")->group(kGroup);
    add_report_options(app, options);
    app.get_option("--verbose")->excludes(quiet);
}

void add_report_options(CLI::App& app, RunOptions& options)
{
    app.add_flag("-v,--verbose", options.verbose, "say what was assumed")->group(kGroup);
    app.add_flag("--json", options.json, "write the summary to stdout as one JSON object")->group(kGroup);
}

} // namespace duskline::cli
