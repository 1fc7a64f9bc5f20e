#include "drawing_program.h"
#include "fly_by.h"
#include "render_picture.h"
#include "report.h"
#include "soak.h"
#include "viewer_options.h"
#include "window.h"

namespace duskline::viewer {
namespace {

constexpr auto kProgram = "duskline-viewer";

void look(const ViewerOptions& options)
{
    require_consistent(options);
    cli::Report report("view", options.run, kProgram);
    if (!options.render.empty())
        render_picture(options, report);
    else if (options.soak_s)
        soak(options, report);
    else if (options.flyby_frames)
        fly_by(options, report);
    else
        return show_window(options, report);
    report.finish();
}

int run(int argc, char** argv)
{
    ViewerOptions options;
    return window::run_drawing_program(
        {.name = kProgram,
         .description = "a terrain and its shadows, in real time",
         .add_options = [&](CLI::App& app) { add_viewer_options(app, options); },
         .run = [&] { look(options); }},
        argc, argv);
}

} // namespace
} // namespace duskline::viewer

int main(int argc, char** argv)
{
    return duskline::viewer::run(argc, argv);
}
