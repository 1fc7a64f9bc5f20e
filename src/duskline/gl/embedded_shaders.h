#pragma once

#include <span>
#include <string_view>

namespace duskline::gl {

struct EmbeddedShader {
    std::string_view name;
    std::string_view text;
};

/// The files of gl/shaders, as they were when the library was built (cmake/embed_shaders.cmake).
std::span<const EmbeddedShader> embedded_shaders();

} // namespace duskline::gl
