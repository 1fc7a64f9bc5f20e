#pragma once

#include "cli11_names.h"

#include <functional>
#include <span>
#include <string_view>

namespace duskline::cli {

/// What a command does once its options are read. It reports failure by an exception (see exit_code.h).
using Run = std::function<void()>;

/// One word after `duskline`.
struct Command {
    std::string_view name;
    std::string_view description; ///< one line, for the list of commands

    /// Adds the command's options to `app` and returns what to do with them. The options must live as long
    /// as the returned function: keep them in a shared_ptr that it holds.
    Run (*declare)(CLI::App& app);
};

/// Every command, in the order of the help.
std::span<const Command> commands();

} // namespace duskline::cli
