#pragma once

#include <duskline/gl/handle.h>
#include <duskline/gl/shader_sources.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace duskline::gl {

/// A shader that cannot be found, compiled or linked. The text is the driver's, with file names for numbers:
/// `terrain.frag.glsl:12: ...`.
class ShaderError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What a program is made of. Files are called pass.stage.glsl; stages are vert, tesc, tese, geom, frag and comp.
struct ProgramDescription {
    std::vector<std::string> stages;
    std::vector<ShaderDefine> defines = {};
};

void delete_program(unsigned int name);

/// A linked GLSL program.
class Program {
public:
    /// Throws ShaderError, and InvalidInput for a file name without a stage.
    Program(const ShaderSources& sources, ProgramDescription description);

    void use() const;

    /// Sets a uniform, by its name in GLSL, without making the program current. A name that the program does not
    /// use is passed over: compilers drop what has no effect.
    void set(const char* uniform, float value) const;
    void set(const char* uniform, int value) const;
    void set(const char* uniform, unsigned int value) const;
    void set(const char* uniform, const std::array<int, 2>& value) const;
    void set(const char* uniform, const std::array<float, 2>& value) const;
    void set(const char* uniform, const std::array<float, 3>& value) const;
    void set(const char* uniform, const std::array<float, 4>& value) const;
    void set_matrix(const char* uniform, const std::array<float, 16>& column_after_column) const;

    /// Builds the program anew if one of its files has changed on disk since; says whether. Throws ShaderError and
    /// stays as it was when the new text is wrong, until the file changes again.
    bool reload_if_changed(const ShaderSources& sources);

    unsigned int name() const { return program_.name(); }

private:
    using FileTimes = std::vector<std::pair<std::filesystem::path, std::filesystem::file_time_type>>;

    static FileTimes times_of(const ShaderSources& sources, const std::vector<std::string>& files);

    ProgramDescription description_;
    FileTimes file_times_;
    Handle<delete_program> program_;
};

/// Runs a compute program on at least `width` x `height` invocations in groups of the size its text declares.
void dispatch(const Program& program, std::size_t width, std::size_t height = 1);

} // namespace duskline::gl
