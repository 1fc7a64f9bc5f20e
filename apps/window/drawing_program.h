#pragma once

#include "cli11_names.h"

#include <functional>

namespace duskline::window {

/// What a program that draws is, and does.
struct DrawingProgram {
    const char* name;        ///< as typed
    const char* description; ///< one line
    std::function<void(CLI::App& app)> add_options;
    std::function<void()> run; ///< after the options have been read
};

/// The body of its `main`: reads the options, among them --help, --man-page and --version, and runs it. Whatever goes wrong
/// becomes one line on standard error. Returns the exit code.
int run_drawing_program(const DrawingProgram& program, int argc, char** argv);

} // namespace duskline::window
