#pragma once

#include <stdexcept>
#include <string_view>

namespace duskline::cli {

/// What the program tells the shell; documented on every man page. Interruption is 128 + signal: 130, 143.
enum class ExitCode : int {
    done = 0,
    failed = 1,    ///< while running
    usage = 2,     ///< wrong options or values
    input = 3,     ///< the input cannot be used
    output = 4,    ///< the output cannot be written
    resources = 5, ///< not enough memory, or not possible on this machine
};

/// The command line itself is wrong. The text says how and what would be right.
class UsageError : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// Standard output cannot be written.
class StandardOutputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Says on one line of stderr, after the program's name, why the exception now being handled ended it, and returns its
/// exit code. Call inside a catch block.
int report_failure(std::string_view program) noexcept;

} // namespace duskline::cli
