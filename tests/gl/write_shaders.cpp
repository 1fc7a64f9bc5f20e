// Writes every stage in every variant, with its includes in place, into a folder, for glslangValidator; fails when a
// stage is in no variant.
//
// usage: write_shaders FOLDER

#include <duskline/gl/shader_variants.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    using namespace duskline::gl;
    if (argc != 2) {
        std::cerr << "usage: write_shaders FOLDER\n";
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const ShaderSources sources;
    std::size_t number = 0;
    for (const ShaderVariant& variant : shader_variants())
        std::ofstream(folder / (std::to_string(number++) + "_" + variant.file))
            << expanded_shader(sources, variant.file, variant.defines).text;

    int missing = 0;
    for (const std::string& name : sources.names()) {
        const bool is_stage = std::ranges::count(name, '.') == 2;
        if (is_stage
            && std::ranges::find(shader_variants(), name, &ShaderVariant::file) == shader_variants().end()) {
            std::cerr << name << " is in no line of gl/shader_variants.h\n";
            ++missing;
        }
    }
    return missing == 0 ? 0 : 1;
}
