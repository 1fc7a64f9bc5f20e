#include "drawing_program.h"

#include "exit_code.h"
#include "help_page.h"
#include "interruption.h"
#include "parse_arguments.h"
#include "report.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace duskline::window {
namespace {

void parse_and_run(const DrawingProgram& program, const std::vector<std::string>& arguments)
{
    CLI::App app(program.description, program.name);
    app.formatter(std::make_shared<cli::HelpText>());
    app.allow_extras();
    app.set_help_flag("-h,--help", "show this help")->group("General");
    app.add_flag_callback("--man-page", [] { throw CLI::CallForAllHelp(); })->group("");
    app.set_version_flag("--version", std::string(program.name) + " " DUSKLINE_VERSION "\n",
                         "show the version")
        ->group("General");
    program.add_options(app);
    try {
        cli::parse_arguments(app, arguments);
    } catch (const CLI::CallForHelp&) {
        return cli::write_to_stdout(app.help());
    } catch (const CLI::CallForAllHelp&) {
        return cli::write_to_stdout(cli::man_page(app));
    } catch (const CLI::CallForVersion& version) {
        return cli::write_to_stdout(version.what());
    }
    cli::reject_unknown(app);
    program.run();
}

} // namespace

int run_drawing_program(const DrawingProgram& program, int argc, char** argv)
{
    cli::watch_for_interruption();
    try {
        parse_and_run(program, std::vector<std::string>(argv + 1, argv + argc));
        return static_cast<int>(cli::ExitCode::done);
    } catch (...) {
        return cli::report_failure(program.name);
    }
}

} // namespace duskline::window
