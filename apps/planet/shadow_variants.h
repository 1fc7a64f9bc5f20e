#pragma once

#include "planet_state.h"

#include <string>
#include <vector>

namespace duskline::planet_app {

/// A technique with its options, to be compared with others.
struct ShadowVariant {
    std::string name;
    PlanetTechnique technique = PlanetTechnique::none;
    gl::ShadowMapOptions shadow_map;
};

/// Every technique once, with `usual` options of the shadow map.
std::vector<ShadowVariant> shadow_techniques(const gl::ShadowMapOptions& usual);

/// The shadow map with each of its options changed by itself, from `usual`.
std::vector<ShadowVariant> shadow_map_variants(const gl::ShadowMapOptions& usual);

} // namespace duskline::planet_app
