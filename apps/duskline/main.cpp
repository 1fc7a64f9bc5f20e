#include "command.h"
#include "exit_code.h"
#include "help_page.h"
#include "interruption.h"
#include "parse_arguments.h"
#include "report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace duskline::cli {
namespace {

constexpr auto kDescription = "exact shadows on elevation models";

// A command's own page, on request; the build makes the manual from it.
void add_page_options(CLI::App& app)
{
    app.set_help_flag("-h,--help", "show this help")->group("General");
    app.add_flag_callback("--man-page", [] { throw CLI::CallForAllHelp(); })->group("");
}

// The parts that every `duskline` command line shares.
struct CommandLine {
    CLI::App app{kDescription, "duskline"};
    std::map<const CLI::App*, Run> runs;
    bool version = false;
};

void declare(CommandLine& line)
{
    // What is not known is reported by reject_unknown, with the name of the option.
    line.app.allow_extras();
    line.app.formatter(std::make_shared<HelpText>());
    add_page_options(line.app);
    line.app.add_flag("--version", line.version, "show the version")->group("General");
    for (const Command& command : commands()) {
        CLI::App& added =
            *line.app.add_subcommand(std::string(command.name), std::string(command.description));
        line.runs[&added] = command.declare(added);
        add_page_options(added);
        added.allow_extras();
    }
    // Last, because commands inherit what the program has when they are added.
    add_example(line.app, "where the sun is seen from Mauna Kea, and when it sets",
                "duskline sun --time 2026-06-21T18:30-10:00 --at -155.47,19.82");
}

std::string command_names()
{
    std::string names;
    for (const Command& command : commands())
        names += (names.empty() ? "" : ", ") + std::string(command.name);
    return names;
}

void require_command(const std::vector<std::string>& arguments)
{
    if (arguments.empty())
        throw UsageError(fmt::format("give a command: {} (see duskline --help)", command_names()));
    const std::string& first = arguments.front();
    if (!first.starts_with('-') && !std::ranges::count(commands(), first, &Command::name))
        throw UsageError(fmt::format("no command is called '{}'; there are: {} (see duskline --help)", first,
                                     command_names()));
}

const CLI::App& chosen(const CommandLine& line)
{
    const auto commands = line.app.get_subcommands();
    return commands.empty() ? line.app : *commands.front();
}

void run(const std::vector<std::string>& arguments)
{
    CommandLine line;
    declare(line);
    require_command(arguments);
    try {
        parse_arguments(line.app, arguments);
    } catch (const CLI::CallForHelp&) {
        return write_to_stdout(line.app.help());
    } catch (const CLI::CallForAllHelp&) {
        return write_to_stdout(man_page(chosen(line)));
    }
    if (line.version)
        return write_to_stdout("duskline " DUSKLINE_VERSION "\n");
    reject_unknown(line.app);
    const CLI::App& command = chosen(line);
    reject_unknown(command);
    if (&command == &line.app)
        throw UsageError(fmt::format("give a command: {} (see duskline --help)", command_names()));
    line.runs.at (&command)();
}

} // namespace
} // namespace duskline::cli

int main(int argc, char** argv)
{
    using namespace duskline::cli;
    watch_for_interruption();
    try {
        run(std::vector<std::string>(argv + 1, argv + argc));
        return static_cast<int>(ExitCode::done);
    } catch (...) {
        return report_failure("duskline");
    }
}
