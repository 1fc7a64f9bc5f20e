#include "shadow_variants.h"

namespace duskline::planet_app {

std::vector<ShadowVariant> shadow_techniques(const gl::ShadowMapOptions& usual)
{
    std::vector<ShadowVariant> variants;
    for (const TechniqueName& known : planet_techniques())
        variants.push_back({std::string(known.name), known.technique, usual});
    return variants;
}

std::vector<ShadowVariant> shadow_map_variants(const gl::ShadowMapOptions& usual)
{
    using Filter = gl::ShadowMapFilter;
    std::vector<ShadowVariant> variants;
    const auto add = [&](const char* name, const auto& change) {
        ShadowVariant variant = {name, PlanetTechnique::shadow_map, usual};
        change(variant.shadow_map);
        variants.push_back(variant);
    };
    add("map-one-tap", [](auto& map) {
        map.filter = Filter::none;
        map.linear_compare = false;
    });
    add("map-one-tap-linear", [](auto& map) { map.filter = Filter::none; });
    add("map-kernels-nearest", [](auto& map) { map.linear_compare = false; });
    add("map-disc", [](auto& map) { map.filter = Filter::disc; });
    add("map-moments", [](auto& map) { map.filter = Filter::moments; });
    add("map-penumbra-only", [](auto& map) { map.penumbra_only = true; });
    add("map-far-faces", [](auto& map) { map.faces = gl::CasterFaces::away_from_light; });
    add("map-1024", [](auto& map) { map.size = 1024; });
    add("map-and-wide", [](auto& map) { map.wide_reach = 8.0 * map.reach; });
    return variants;
}

} // namespace duskline::planet_app
