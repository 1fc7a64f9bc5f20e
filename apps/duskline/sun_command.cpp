#include "command.h"
#include "help_page.h"
#include "light_options.h"
#include "report.h"
#include "run_options.h"

#include <memory>

namespace duskline::cli {
namespace {

struct SunOptions {
    LightOptions light;
    RunOptions run;
};

void run_sun(const SunOptions& options)
{
    Report report("sun", options.run);
    const ChosenLight chosen = choose_light(options.light, {}, report);
    report.field("azimuth_deg", chosen.light.azimuth.degrees());
    report.field("altitude_deg", chosen.light.altitude.degrees());
    report.finish();
}

} // namespace

Run declare_sun(CLI::App& app)
{
    const auto options = std::make_shared<SunOptions>();
    add_light_options(app, options->light);
    add_run_options(app, options->run);
    add_example(app, "the sun over Mauna Kea on a summer evening",
                "duskline sun --time 2026-06-21T18:30-10:00 --at -155.47,19.82");
    return [options] { run_sun(*options); };
}

} // namespace duskline::cli
