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
        {"full_screen.vert.glsl"},
        {"sweep_answers.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_answers.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
        {"sweep_fronts.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_fronts.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
        {"sweep_segments.comp.glsl", {{"DUSKLINE_LIMBS", "1"}}},
        {"sweep_segments.comp.glsl", {{"DUSKLINE_LIMBS", "2"}}},
    };
    return variants;
}

} // namespace duskline::gl
