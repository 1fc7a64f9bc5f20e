#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace duskline::cli {

/// Adds what the command does at more length than its one line; paragraphs are parted by empty lines.
void add_details(CLI::App& app, std::string_view text);

/// Adds a command line to show, and what it does.
void add_example(CLI::App& app, std::string_view what, std::string_view command_line);

/// Prints a command's declared options and texts for --help, 80 columns wide.
class HelpText : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// The same as a manual page for man(1).
std::string man_page(const CLI::App& app);

} // namespace duskline::cli
