#pragma once

// Enough of GLSL to compile terrain_shadow.glsl as C++: vectors are glm's, textures grids.

#include <duskline/geometry/grid.h>
#include <duskline/gl/shaders/terrain_shadow_block.h>

#include <glm/glm.hpp>

#include <array>
#include <cmath>

namespace duskline::gl::shader {

// NOLINTBEGIN(google-build-using-namespace)
using namespace glm;
// NOLINTEND(google-build-using-namespace)

// What a texture of one or two components gives: a missing one is 0.
struct sampler2D { // NOLINT(readability-identifier-naming): GLSL's name
    GridView<const std::array<float, 2>> texels;
};

inline vec4 texelFetch(const sampler2D& texture, ivec2 texel, int) // NOLINT(readability-identifier-naming)
{
    const auto& [x, y] = texture.texels(static_cast<std::size_t>(texel.y), static_cast<std::size_t>(texel.x));
    return {x, y, 0.0f, 1.0f};
}

inline ivec2 textureSize(const sampler2D& texture, int) // NOLINT(readability-identifier-naming)
{
    return {static_cast<int>(texture.texels.columns()), static_cast<int>(texture.texels.rows())};
}

inline float dot(const BlockVec4& a, const vec4& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

} // namespace duskline::gl::shader
