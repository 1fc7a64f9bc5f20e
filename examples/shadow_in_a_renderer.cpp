// Terrain shadows in a renderer that was there before: a few lines, marked (1) to (4). The renderer is a small one with
// its own shaders, its own axes (y up, metres from the middle of the map) and its own things on the ground: towers, whose
// feet may stand in a shadow that their tops rise out of.
//
// usage: shadow_in_a_renderer PICTURE.ppm          needs no window; any graphics card with OpenGL 4.3, or Mesa

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/headless_context.h>
#include <duskline/gl/height_texture.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/terrain_shadow.h>
#include <duskline/gl/vertex_array.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <epoxy/gl.h>

#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

constexpr int kSide = 401; // cells
constexpr float kCell_m = 25.0f;
constexpr int kWidth = 1280;
constexpr int kHeight = 720;

// Vertices from their numbers: the ground in triangles, two a cell, or towers of 36 corners.
const std::string kVertexShader = R"(#version 430 core
layout(binding = 0) uniform sampler2D heights;
uniform int side;
uniform float cell_m;
uniform float aspect;
uniform bool towers;
out vec3 world_position;
out vec3 normal;
vec3 ground(ivec2 cell)
{
    float height = texelFetch(heights, clamp(cell, ivec2(0), ivec2(side - 1)), 0).r;
    return vec3(cell_m * (float(cell.x) - 0.5 * float(side - 1)), height, cell_m * (float(cell.y) - 0.5 * float(side - 1)));
}
void main()
{
    const ivec2 corners[6] = ivec2[6](ivec2(0, 0), ivec2(0, 1), ivec2(1, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1));
    if (towers) {
        ivec2 cell = 40 + (side - 80) / 6 * ivec2(gl_VertexID / 36 % 7, gl_VertexID / 252);
        int face = gl_VertexID / 6 % 6;
        vec2 corner = 2.0 * vec2(corners[gl_VertexID % 6]) - 1.0;
        vec3 box = vec3(corner, face < 3 ? -1.0 : 1.0);
        vec3 out_of = vec3(0.0, 0.0, box.z);
        int axis = face % 3;
        vec3 turned = axis == 0 ? box.xyz : axis == 1 ? box.zxy : box.yzx;
        normal = axis == 0 ? out_of.xyz : axis == 1 ? out_of.zxy : out_of.yzx;
        world_position = ground(cell) + vec3(50.0, 300.0, 50.0) * turned;
    } else {
        ivec2 cell = ivec2(gl_VertexID / 6 % (side - 1), gl_VertexID / 6 / (side - 1)) + corners[gl_VertexID % 6];
        world_position = ground(cell);
        normal = normalize(cross(ground(cell + ivec2(0, 1)) - ground(cell - ivec2(0, 1)),
                                 ground(cell + ivec2(1, 0)) - ground(cell - ivec2(1, 0))));
    }
    // a bird's view from the south, without perspective
    vec2 tilt = vec2(cos(0.6), sin(0.6));
    vec3 seen = 2.0 / (cell_m * float(side)) * world_position;
    gl_Position = vec4(seen.x, aspect * dot(tilt, vec2(seen.y, -seen.z)) - 0.3, -0.3 * dot(tilt.yx, seen.yz), 1.0);
}
)";

const std::string kFragmentShader = R"(
in vec3 world_position;
in vec3 normal;
uniform vec3 to_sun;
uniform bool towers;
out vec4 colour;
void main()
{
    vec3 own = towers ? vec3(0.80, 0.42, 0.30) : vec3(0.62, 0.66, 0.50);
    float sun = max(dot(normalize(normal), to_sun), 0.0);
    sun *= shadow_factor(world_position); // (1)
    colour = vec4(sqrt(own * ((0.6 + 0.4 * normal.y) * vec3(0.20, 0.24, 0.32) + 1.1 * sun)), 1.0);
}
)";

GLuint compiled(GLenum stage, const std::string& text)
{
    const GLuint shader = glCreateShader(stage);
    const char* lines = text.c_str();
    glShaderSource(shader, 1, &lines, nullptr);
    glCompileShader(shader);
    return shader;
}

GLuint linked(const std::string& vertex_text, const std::string& fragment_text)
{
    const GLuint program = glCreateProgram();
    glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex_text));
    glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment_text));
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good != GL_TRUE)
        throw std::runtime_error("the renderer's shaders do not link");
    return program;
}

void draw_scene(GLuint program, const duskline::Vector3& to_sun)
{
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.70f, 0.80f, 0.92f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "side"), kSide);
    glUniform1f(glGetUniformLocation(program, "cell_m"), kCell_m);
    glUniform1f(glGetUniformLocation(program, "aspect"),
                static_cast<float>(kWidth) / static_cast<float>(kHeight));
    glUniform3f(glGetUniformLocation(program, "to_sun"), static_cast<float>(to_sun.x),
                static_cast<float>(to_sun.z), static_cast<float>(-to_sun.y));
    for (const GLint towers : {0, 1}) {
        glUniform1i(glGetUniformLocation(program, "towers"), towers);
        glDrawArrays(GL_TRIANGLES, 0, towers == 1 ? 36 * 7 * 7 : 6 * (kSide - 1) * (kSide - 1));
    }
}

void draw_picture(const std::string& file)
{
    using namespace duskline;
    const gl::HeadlessContext context; // an engine has its own
    const Terrain terrain =
        make_mountains({.grid = {kSide, kSide, {kCell_m, kCell_m}}, .seed = 5, .height_m = 1600.0});
    const gl::Texture heights = gl::height_texture(terrain.heights_m.view());
    const DirectionalLight sun{.azimuth = Angle::from_degrees(255.0), .altitude = Angle::from_degrees(16.0)};

    // (2) once: passes that find the shadow of a sun, and the text for the engine's own shader
    const gl::ShaderSources sources;
    gl::ShadowSweep sweep(sources, {.limbs = true});
    const std::string include = gl::expanded_shader(sources, "terrain_shadow.glsl").text;
    const GLuint program = linked(kVertexShader, "#version 430 core\n" + include + kFragmentShader);

    // (3) when the sun moves or the ground changes
    const gl::Texture& shadow = sweep.cast(heights, terrain.cell_size_m, sun);
    const double corner_m = -0.5 * kCell_m * (kSide - 1);
    const gl::GridPlacement placement{.origin = {corner_m, 0.0, corner_m},
                                      .column_step = {kCell_m, 0.0, 0.0},
                                      .row_step = {0.0, 0.0, kCell_m},
                                      .metre_up = {0.0, 1.0, 0.0}};
    const auto block = gl::terrain_shadow_block(placement, shadow, sun);

    const gl::Texture colour(gl::TextureFormat::rgba8, kWidth, kHeight);
    const gl::Texture depth(gl::TextureFormat::depth32f, kWidth, kHeight);
    const gl::Framebuffer framebuffer({&colour}, &depth);
    const gl::VertexArray no_attributes;
    framebuffer.bind();
    glBindVertexArray(no_attributes.name());
    heights.bind(0);
    gl::Buffer block_buffer;
    gl::bind_terrain_shadow(shadow, block, block_buffer); // (4) before things are drawn
    draw_scene(program, direction_towards(sun));

    std::ofstream out(file, std::ios::binary);
    out << "P6\n" << kWidth << " " << kHeight << "\n255\n";
    const auto picture = gl::read_back_picture(kWidth, kHeight);
    for (const auto& pixel : picture.values())
        out.write(reinterpret_cast<const char*>(pixel.data()), 3);
    if (!out)
        throw std::runtime_error("cannot write " + file);
    std::cout << "drew " << kWidth << " x " << kHeight << " pixels\n";
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: shadow_in_a_renderer PICTURE.ppm\n";
        return 2;
    }
    try {
        draw_picture(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "shadow_in_a_renderer: " << error.what() << "\n";
        return dynamic_cast<const duskline::UnsupportedOnThisMachine*>(&error) != nullptr ? 5 : 1;
    }
}
