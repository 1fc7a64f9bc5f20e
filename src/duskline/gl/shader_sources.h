#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace duskline::gl {

/// GLSL texts by file name. Duskline's own are part of the library; a folder of files may stand in for them while
/// one works on them, and a renderer adds its own, which may include Duskline's:
///
///     ShaderSources sources;
///     sources.add("ground.frag.glsl", "#version 430 core\n#include \"terrain_shadow.glsl\"\n...");
///     Program program(sources, {.stages = {"ground.vert.glsl", "ground.frag.glsl"}});
class ShaderSources {
public:
    /// Those built into the library. Files of `folder`, if one is given, come before them, and before added ones.
    explicit ShaderSources(std::filesystem::path folder = {});

    /// Adds a text under that name, in place of an earlier one.
    void add(std::string name, std::string text);

    /// The text of that name. Throws InvalidInput, listing the names there are.
    std::string text(std::string_view name) const;

    /// The file it would be read from; empty when it comes from memory.
    std::filesystem::path file(std::string_view name) const;

    /// Names of all that are in memory, in alphabetical order.
    std::vector<std::string> names() const;

private:
    std::filesystem::path folder_;
    std::map<std::string, std::string, std::less<>> texts_;
};

/// A name that the shader sees as `#define name value`.
struct ShaderDefine {
    std::string name;
    std::string value;
};

/// One stage, ready for the compiler.
struct ShaderText {
    std::string text;
    std::vector<std::string> files; ///< in the order of their numbers in `#line`
};

/// Puts defines behind the `#version` line, and included files (`#include "name"`, each once) where they are asked
/// for, with `#line` directives so that the compiler's messages tell file and line.
/// Throws ShaderError for a file that is not there, with the line that asked for it.
ShaderText expanded_shader(const ShaderSources& sources, std::string_view name,
                           const std::vector<ShaderDefine>& defines = {});

} // namespace duskline::gl
