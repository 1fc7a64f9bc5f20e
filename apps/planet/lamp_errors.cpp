#include "lamp_errors.h"

#include <fmt/format.h>

namespace duskline::planet_app {

LampErrors::LampErrors(const std::vector<PlacedLamp>& lamps)
{
    for (const PlacedLamp& lamp : lamps)
        if (lamp.light.on)
            lamps_.push_back({option_of(lamp), {}});
}

void LampErrors::compare(PlanetScene& scene, const GroundProbe& probe, const PlanetState& state,
                         std::size_t step)
{
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        const ProbedPicture lit = probe.lamp(scene, state, i);
        PictureTruth truth(scene.terrain(), lamplight(scene.lamps()[i]), state.camera.eye_m,
                           scene.quadtree().patches(), lit, step, scene.execution());
        lamps_[i].errors += truth.errors_of(lit);
    }
}

void LampErrors::add_to(cli::Report& report) const
{
    for (const OfLamp& lamp : lamps_) {
        if (lamp.errors.pixels == 0)
            continue;
        const auto share = [&](std::size_t pixels) {
            return static_cast<double>(pixels) / static_cast<double>(lamp.errors.pixels);
        };
        report.json()["lamps"].push_back({{"lamp", lamp.option},
                                          {"pixels", lamp.errors.pixels},
                                          {"dark_share", share(lamp.errors.dark)},
                                          {"wrong_share", share(lamp.errors.wrong)},
                                          {"wrong_apart_share", share(lamp.errors.wrong_apart)}});
        report.line(fmt::format(
            "{}: of {} pixels it could light {:.1f} % are in shadow; {:.2f} % are wrong, {:.2f} % apart "
            "from edges",
            lamp.option, lamp.errors.pixels, 100.0 * share(lamp.errors.dark),
            100.0 * share(lamp.errors.wrong), 100.0 * share(lamp.errors.wrong_apart)));
    }
}

} // namespace duskline::planet_app
