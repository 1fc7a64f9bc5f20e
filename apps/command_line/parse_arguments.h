#pragma once

#include "cli11_names.h"

#include <string>
#include <vector>

namespace duskline::cli {

/// Reads the arguments after the program's name into what `app` declares. Throws UsageError, in plain words, when they
/// do not fit; CLI::Success (CLI::CallForHelp, ...) where help or the version was asked for. Of an app that allows extras,
/// what it does not know remains: see `reject_unknown`.
void parse_arguments(CLI::App& app, std::vector<std::string> arguments);

/// Throws UsageError, naming the first option or argument that was given to `app` and that it does not know.
void reject_unknown(const CLI::App& app);

} // namespace duskline::cli
