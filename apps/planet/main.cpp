#include "descent.h"
#include "exit_code.h"
#include "help_page.h"
#include "interruption.h"
#include "parse_arguments.h"
#include "planet_options.h"
#include "render_picture.h"
#include "report.h"
#include "soak.h"
#include "window.h"

#include <string>
#include <vector>

namespace duskline::planet_app {
namespace {

constexpr auto kProgram = "duskline-planet";
constexpr auto kDescription = "a planet and its shadows, from space down to the ground";

void look(const PlanetOptions& options)
{
    require_consistent(options);
    cli::Report report("planet", options.run, kProgram);
    if (!options.render.empty())
        render_picture(options, report);
    else if (options.flydown_frames)
        fly_down(options, report);
    else if (options.soak_s)
        soak(options, report);
    else
        return show_window(options, report);
    report.finish();
}

void run(const std::vector<std::string>& arguments)
{
    CLI::App app(kDescription, kProgram);
    PlanetOptions options;
    app.formatter(std::make_shared<cli::HelpText>());
    app.allow_extras();
    app.set_help_flag("-h,--help", "show this help")->group("General");
    app.add_flag_callback("--man-page", [] { throw CLI::CallForAllHelp(); })->group("");
    app.set_version_flag("--version", "duskline-planet " DUSKLINE_VERSION "\n", "show the version")
        ->group("General");
    add_planet_options(app, options);
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
    look(options);
}

} // namespace
} // namespace duskline::planet_app

int main(int argc, char** argv)
{
    using namespace duskline;
    cli::watch_for_interruption();
    try {
        planet_app::run(std::vector<std::string>(argv + 1, argv + argc));
        return static_cast<int>(cli::ExitCode::done);
    } catch (...) {
        return cli::report_failure(planet_app::kProgram);
    }
}
