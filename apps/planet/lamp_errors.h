#pragma once

#include "ground_probe.h"
#include "report.h"
#include "shadow_truth.h"

#include <cstddef>
#include <string>
#include <vector>

namespace duskline::planet_app {

/// How right the shadows of a state's lamps are, summed over pictures: of the pixels that a lamp could light, those that its map
/// has wrong (ShadowErrors), against rays over all ground between them and the lamp.
class LampErrors {
public:
    explicit LampErrors(const std::vector<PlacedLamp>& lamps);

    /// Adds the picture of a state with those lamps, with everything there; every `step`th pixel of every `step`th row. Throws
    /// Cancelled.
    void compare(PlanetScene& scene, const GroundProbe& probe, const PlanetState& state, std::size_t step);

    /// A line and an entry of "lamps" for each, if there was anything to compare.
    void add_to(cli::Report& report) const;

private:
    struct OfLamp {
        std::string option; ///< that brings it
        ShadowErrors errors;
    };
    std::vector<OfLamp> lamps_; ///< that are on
};

} // namespace duskline::planet_app
