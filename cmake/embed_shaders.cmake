# Makes a source file of shader files, so that the library carries them.
#
# cmake -D OUTPUT=file.cpp -D SHADERS=list;of;files -P embed_shaders.cmake
set(rows "")
foreach(shader ${SHADERS})
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} text)
  string(APPEND rows "    EmbeddedShader{\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
list(LENGTH SHADERS count)
file(WRITE ${OUTPUT}.new "// Made by cmake/embed_shaders.cmake.

#include <duskline/gl/embedded_shaders.h>

#include <array>

namespace duskline::gl {

static constexpr std::array<EmbeddedShader, ${count}> kShaders = {
${rows}};

std::span<const EmbeddedShader> embedded_shaders()
{
    return kShaders;
}

} // namespace duskline::gl
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
