#include "descent.h"
#include "drawing_program.h"
#include "planet_options.h"
#include "render_picture.h"
#include "report.h"
#include "soak.h"
#include "window.h"

namespace duskline::planet_app {
namespace {

constexpr auto kProgram = "duskline-planet";

void look(const PlanetOptions& options)
{
    require_consistent(options);
    cli::Report report("planet", options.run, kProgram);
    if (!options.render.empty())
        render_picture(options, report);
    else if (options.soak_s)
        soak(options, report);
    else if (options.flydown_frames)
        fly_down(options, report);
    else
        return show_window(options, report);
    report.finish();
}

int run(int argc, char** argv)
{
    PlanetOptions options;
    return window::run_drawing_program(
        {.name = kProgram,
         .description = "a planet and its shadows, from space down to the ground",
         .add_options = [&](CLI::App& app) { add_planet_options(app, options); },
         .run = [&] { look(options); }},
        argc, argv);
}

} // namespace
} // namespace duskline::planet_app

int main(int argc, char** argv)
{
    return duskline::planet_app::run(argc, argv);
}
