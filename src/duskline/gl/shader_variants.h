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
    };
    return variants;
}

} // namespace duskline::gl
