#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/embedded_shaders.h>
#include <duskline/gl/program.h>
#include <duskline/gl/shader_sources.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace duskline::gl {

ShaderSources::ShaderSources(std::filesystem::path folder) : folder_(std::move(folder))
{
    for (const EmbeddedShader& shader : embedded_shaders())
        texts_.emplace(shader.name, shader.text);
}

void ShaderSources::add(std::string name, std::string text)
{
    texts_.insert_or_assign(std::move(name), std::move(text));
}

std::filesystem::path ShaderSources::file(std::string_view name) const
{
    if (folder_.empty())
        return {};
    auto path = folder_ / name;
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) ? path : std::filesystem::path{};
}

std::string ShaderSources::text(std::string_view name) const
{
    if (const auto path = file(name); !path.empty()) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    if (const auto found = texts_.find(name); found != texts_.end())
        return found->second;
    std::string known;
    for (const auto& [other, text] : texts_)
        known += (known.empty() ? "" : ", ") + other;
    throw InvalidInput("no shader is called '" + std::string(name) + "'; there are: " + known);
}

std::vector<std::string> ShaderSources::names() const
{
    std::vector<std::string> names;
    for (const auto& [name, text] : texts_)
        names.push_back(name);
    return names;
}

namespace {

// The file that an include line asks for, else empty.
std::string included_file(const std::string& line)
{
    static const std::regex include(R"(^\s*#\s*include\s+"([^"]+)\".*)");
    std::smatch found;
    return std::regex_match(line, found, include) ? found[1].str() : std::string();
}

bool is_version(const std::string& line)
{
    static const std::regex version(R"(^\s*#\s*version\b.*)");
    return std::regex_match(line, version);
}

class Expansion {
public:
    Expansion(const ShaderSources& sources, const std::vector<ShaderDefine>& defines)
        : sources_(sources), defines_(defines)
    {}

    void append(const std::string& name, const std::string& asked_for_at)
    {
        if (std::ranges::find(expanded_.files, name) != expanded_.files.end())
            return;
        const std::size_t number = expanded_.files.size();
        expanded_.files.push_back(name);
        std::istringstream lines(text_of(name, asked_for_at));
        std::string line;
        for (std::size_t n = 1; std::getline(lines, line); ++n) {
            if (const std::string file = included_file(line); !file.empty()) {
                append_line_number(1, expanded_.files.size());
                append(file, name + ":" + std::to_string(n));
                append_line_number(n + 1, number);
                continue;
            }
            expanded_.text += line + "\n";
            if (is_version(line)) {
                for (const ShaderDefine& define : defines_)
                    expanded_.text += "#define " + define.name + " " + define.value + "\n";
                append_line_number(n + 1, number);
            }
        }
    }

    ShaderText take() { return std::move(expanded_); }

private:
    std::string text_of(const std::string& name, const std::string& asked_for_at) const
    {
        try {
            return sources_.text(name);
        } catch (const InvalidInput& error) {
            throw ShaderError((asked_for_at.empty() ? "" : asked_for_at + ": ") + error.what());
        }
    }

    // The number of the line that follows.
    void append_line_number(std::size_t line, std::size_t file)
    {
        expanded_.text += "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
    }

    const ShaderSources& sources_;
    const std::vector<ShaderDefine>& defines_;
    ShaderText expanded_;
};

} // namespace

ShaderText expanded_shader(const ShaderSources& sources, std::string_view name,
                           const std::vector<ShaderDefine>& defines)
{
    Expansion expansion(sources, defines);
    expansion.append(std::string(name), "");
    return expansion.take();
}

} // namespace duskline::gl
