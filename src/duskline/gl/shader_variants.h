#pragma once

#include <duskline/gl/shader_sources.h>

#include <string>
#include <vector>

namespace duskline::gl {

/// A stage as it is compiled somewhere in this folder.
struct ShaderVariant {
    std::string file;
    std::vector<ShaderDefine> defines = {};
};

/// Every stage in every variant. Tests give each to glslangValidator: a new stage is a new line here.
inline const std::vector<ShaderVariant>& shader_variants()
{
    static const std::vector<ShaderVariant> variants = {
        {"cloud_layer.frag.glsl"},
        {"cloud_layer.vert.glsl"},
        {"full_screen.vert.glsl"},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "0"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "1"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "2"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "3"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "4"}, {"DUSKLINE_SMAP_LANES", "1"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "5"}, {"DUSKLINE_SMAP_LANES", "4"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "6"}, {"DUSKLINE_SMAP_LANES", "1"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "7"}}},
        {"lit_mask.frag.glsl", {{"SHADOW_LOOKUP", "8"}}},
        {"planet.frag.glsl", {{"PLANET_SHADOW", "0"}}},
        {"planet.frag.glsl", {{"PLANET_SHADOW", "1"}}},
        {"planet.frag.glsl", {{"PLANET_SHADOW", "2"}}},
        {"planet.vert.glsl"},
        {"planet_depth.vert.glsl"},
        {"planet_sky.frag.glsl"},
        {"scene_object.frag.glsl"},
        {"scene_object.vert.glsl"},
        {"shadow_map_moments.frag.glsl", {{"DUSKLINE_ROWS", "0"}}},
        {"shadow_map_moments.frag.glsl", {{"DUSKLINE_ROWS", "1"}}},
        {"sky.frag.glsl"},
        {"smap_bounds.frag.glsl", {{"DUSKLINE_SMAP_LANES", "1"}}},
        {"smap_bounds.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}}},
        {"smap_colour.frag.glsl", {{"DUSKLINE_SMAP_LANES", "1"}}},
        {"smap_colour.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}}},
        {"smap_covered.frag.glsl", {{"DUSKLINE_SMAP_LANES", "1"}}},
        {"smap_covered.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}}},
        {"smap_mask.frag.glsl", {{"DUSKLINE_SMAP_LANES", "1"}, {"DUSKLINE_FULL_SCAN", "0"}}},
        {"smap_mask.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}, {"DUSKLINE_FULL_SCAN", "0"}}},
        {"smap_mask.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}, {"DUSKLINE_FULL_SCAN", "1"}}},
        {"smap_next.frag.glsl", {{"DUSKLINE_SMAP_LANES", "1"}}},
        {"smap_next.frag.glsl", {{"DUSKLINE_SMAP_LANES", "4"}}},
        {"sweep_answers.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_answers.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
        {"sweep_fronts.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_fronts.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
        {"sweep_segments.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_segments.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "0"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "1"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "2"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "3"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "4"}, {"DUSKLINE_SMAP_LANES", "1"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "5"}, {"DUSKLINE_SMAP_LANES", "4"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "6"}, {"DUSKLINE_SMAP_LANES", "1"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "7"}}},
        {"terrain.frag.glsl", {{"SHADOW_LOOKUP", "8"}}},
        {"terrain.vert.glsl"},
    };
    return variants;
}

} // namespace duskline::gl
