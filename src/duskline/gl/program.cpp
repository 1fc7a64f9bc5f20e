#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/program.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <regex>

namespace duskline::gl {

void delete_program(unsigned int name)
{
    // OpenGL would keep it until another is current, and whoever then puts back what was current meets a name no more.
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    if (static_cast<GLuint>(current) == name)
        glUseProgram(0);
    glDeleteProgram(name);
}

static void delete_shader(unsigned int name)
{
    glDeleteShader(name);
}

namespace {

using Shader = Handle<delete_shader>;

struct Stage {
    std::string_view ending;
    GLenum kind;
};

constexpr std::array kStages = {
    Stage{".vert.glsl", GL_VERTEX_SHADER},          Stage{".tesc.glsl", GL_TESS_CONTROL_SHADER},
    Stage{".tese.glsl", GL_TESS_EVALUATION_SHADER}, Stage{".geom.glsl", GL_GEOMETRY_SHADER},
    Stage{".frag.glsl", GL_FRAGMENT_SHADER},        Stage{".comp.glsl", GL_COMPUTE_SHADER},
};

GLenum stage_of(const std::string& file)
{
    for (const Stage& stage : kStages)
        if (file.ends_with(stage.ending))
            return stage.kind;
    throw InvalidInput("'" + file + "' does not tell its stage: shaders are called pass.stage.glsl, "
                       + "stage being vert, tesc, tese, geom, frag or comp");
}

// Drivers begin a message with the number of the text and the line: 0:12(5), 0(12) or ERROR: 0:12.
std::string with_file_names(const std::string& log, const std::vector<std::string>& files)
{
    static const std::regex place(R"((^|\n)((?:ERROR|WARNING): )?(\d+)[:(](\d+)(?:\(\d+\)|\))?)");
    std::string named;
    auto rest = log.cbegin();
    for (std::sregex_iterator found(log.begin(), log.end(), place), end; found != end; ++found) {
        const std::size_t file = std::stoul((*found)[3].str());
        named.append(rest, (*found)[0].first);
        named += (*found)[1].str() + (file < files.size() ? files[file] : (*found)[3].str()) + ":"
                 + (*found)[4].str();
        rest = (*found)[0].second;
    }
    named.append(rest, log.cend());
    named.erase(named.find_last_not_of(" \n\r\t\0") + 1);
    return named;
}

template <typename GetLength, typename GetText>
std::string log_of(GLuint object, GetLength get_length, GetText get_text)
{
    GLint length = 0;
    get_length(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    get_text(object, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

Shader compiled(const std::string& file, const ShaderText& shader_text)
{
    Shader shader(glCreateShader(stage_of(file)));
    const char* text = shader_text.text.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint good = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &good);
    if (good != GL_TRUE)
        throw ShaderError(
            file + " does not compile:\n"
            + with_file_names(log_of(shader.name(), glGetShaderiv, glGetShaderInfoLog), shader_text.files));
    return shader;
}

std::string joined(const std::vector<std::string>& names)
{
    std::string all;
    for (const std::string& name : names)
        all += (all.empty() ? "" : " + ") + name;
    return all;
}

Handle<delete_program> linked(const std::vector<Shader>& shaders, const std::vector<std::string>& stages)
{
    Handle<delete_program> program(glCreateProgram());
    for (const Shader& shader : shaders)
        glAttachShader(program.name(), shader.name());
    glLinkProgram(program.name());
    for (const Shader& shader : shaders)
        glDetachShader(program.name(), shader.name());
    GLint good = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
    if (good != GL_TRUE)
        throw ShaderError(joined(stages) + " do not link:\n"
                          + log_of(program.name(), glGetProgramiv, glGetProgramInfoLog));
    return program;
}

std::vector<ShaderText> expanded_stages(const ShaderSources& sources, const ProgramDescription& description)
{
    std::vector<ShaderText> texts;
    for (const std::string& stage : description.stages)
        texts.push_back(expanded_shader(sources, stage, description.defines));
    return texts;
}

std::vector<std::string> files_of(const std::vector<ShaderText>& texts)
{
    std::vector<std::string> files;
    for (const ShaderText& text : texts)
        files.insert(files.end(), text.files.begin(), text.files.end());
    return files;
}

Handle<delete_program> built(const std::vector<ShaderText>& texts, const std::vector<std::string>& stages)
{
    std::vector<Shader> shaders;
    for (std::size_t i = 0; i < stages.size(); ++i)
        shaders.push_back(compiled(stages[i], texts[i]));
    return linked(shaders, stages);
}

} // namespace

Program::Program(const ShaderSources& sources, ProgramDescription description)
    : description_(std::move(description))
{
    const auto texts = expanded_stages(sources, description_);
    file_times_ = times_of(sources, files_of(texts));
    program_ = built(texts, description_.stages);
}

Program::FileTimes Program::times_of(const ShaderSources& sources, const std::vector<std::string>& files)
{
    FileTimes times;
    for (const std::string& file : files)
        if (const auto path = sources.file(file); !path.empty()) {
            std::error_code error; // a file that is just being replaced
            times.emplace_back(path, std::filesystem::last_write_time(path, error));
        }
    return times;
}

bool Program::reload_if_changed(const ShaderSources& sources)
{
    std::vector<std::string> names;
    for (const auto& [path, time] : file_times_)
        names.push_back(path.filename().string());
    if (times_of(sources, names) == file_times_)
        return false;
    file_times_ = times_of(sources, names); // even when the text is wrong: it is said once
    const auto texts = expanded_stages(sources, description_);
    file_times_ = times_of(sources, files_of(texts));
    program_ = built(texts, description_.stages);
    return true;
}

void Program::use() const
{
    glUseProgram(name());
}

void Program::set(const char* uniform, float value) const
{
    glProgramUniform1f(name(), glGetUniformLocation(name(), uniform), value);
}

void Program::set(const char* uniform, int value) const
{
    glProgramUniform1i(name(), glGetUniformLocation(name(), uniform), value);
}

void Program::set(const char* uniform, unsigned int value) const
{
    glProgramUniform1ui(name(), glGetUniformLocation(name(), uniform), value);
}

void Program::set(const char* uniform, const std::array<int, 2>& value) const
{
    glProgramUniform2iv(name(), glGetUniformLocation(name(), uniform), 1, value.data());
}

void Program::set(const char* uniform, const std::array<float, 2>& value) const
{
    glProgramUniform2fv(name(), glGetUniformLocation(name(), uniform), 1, value.data());
}

void Program::set(const char* uniform, const std::array<float, 3>& value) const
{
    glProgramUniform3fv(name(), glGetUniformLocation(name(), uniform), 1, value.data());
}

void Program::set(const char* uniform, const std::array<float, 4>& value) const
{
    glProgramUniform4fv(name(), glGetUniformLocation(name(), uniform), 1, value.data());
}

void Program::set_matrix(const char* uniform, const std::array<float, 16>& column_after_column) const
{
    glProgramUniformMatrix4fv(name(), glGetUniformLocation(name(), uniform), 1, GL_FALSE,
                              column_after_column.data());
}

void dispatch(const Program& program, std::size_t width, std::size_t height)
{
    std::array<GLint, 3> group{};
    glGetProgramiv(program.name(), GL_COMPUTE_WORK_GROUP_SIZE, group.data());
    const auto groups = [](std::size_t count, GLint size) {
        return static_cast<GLuint>((count + static_cast<std::size_t>(size) - 1)
                                   / static_cast<std::size_t>(size));
    };
    if (width == 0 || height == 0)
        return;
    GLint before = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &before);
    program.use();
    glDispatchCompute(groups(width, group[0]), groups(height, group[1]), 1);
    glUseProgram(static_cast<GLuint>(before));
}

} // namespace duskline::gl
