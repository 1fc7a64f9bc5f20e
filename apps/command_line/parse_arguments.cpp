#include "parse_arguments.h"

#include "exit_code.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace duskline::cli {
namespace {

// "duskline shadow".
std::string full_name(const CLI::App& app)
{
    return app.get_parent() ? app.get_parent()->get_name() + " " + app.get_name() : app.get_name();
}

const CLI::App& chosen(const CLI::App& app)
{
    const auto commands = app.get_subcommands();
    return commands.empty() ? app : *commands.front();
}

// What CLI11 says about the number of values, as one would say it: "--azimuth: 1 required DEG missing".
std::string in_plain_words(const CLI::ParseError& error)
{
    std::string text = error.what();
    const std::size_t colon = text.find(':');
    const bool counts_values = error.get_name() == "ArgumentMismatch" && colon != std::string::npos;
    if (counts_values && text.ends_with("missing"))
        return text.substr(0, colon) + " needs a value";
    if (counts_values && text.find("At Most 1") != std::string::npos)
        return text.substr(0, colon) + " may be given once";
    return text;
}

} // namespace

// CLI11 takes its arguments last first.
void parse_arguments(CLI::App& app, std::vector<std::string> arguments)
{
    std::ranges::reverse(arguments);
    try {
        app.parse(arguments);
    } catch (const CLI::Success&) { // a call for help or for the version
        throw;
    } catch (const CLI::ParseError& error) {
        throw UsageError(fmt::format("{} (see {} --help)", in_plain_words(error), full_name(chosen(app))));
    }
}

void reject_unknown(const CLI::App& app)
{
    const std::vector<std::string> unknown = app.remaining();
    if (unknown.empty())
        return;
    const auto option = std::ranges::find_if(unknown, [](const auto& word) { return word.starts_with('-'); });
    const std::string problem = option != unknown.end()
                                    ? fmt::format("no option is called '{}'", *option)
                                    : fmt::format("'{}' is one argument too many", unknown.front());
    throw UsageError(fmt::format("{} (see {} --help)", problem, full_name(app)));
}

} // namespace duskline::cli
