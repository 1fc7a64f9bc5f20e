#include "gl/gl_test.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/reversed_depth.h>
#include <duskline/gl/vertex_array.h>

#include <algorithm>
#include <array>

namespace duskline::gl {
namespace {

using namespace angle_literals;

constexpr CameraAxes kAhead = {.forward = {0.0, 1.0, 0.0}, .right = {1.0, 0.0, 0.0}, .up = {0.0, 0.0, 1.0}};

// A triangle over all of the picture, so many metres ahead, in a grey.
void add_wall(ShaderSources& sources)
{
    sources.add("wall.vert.glsl",
                "#version 430 core\n"
                "uniform mat4 to_clip;\n"
                "uniform float ahead_m;\n"
                "void main() {\n"
                "    vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 8.0 - 2.0;\n"
                "    gl_Position = to_clip * vec4(at.x * ahead_m, ahead_m, at.y * ahead_m, 1.0);\n"
                "}\n");
    sources.add("wall.frag.glsl", "#version 430 core\n"
                                  "uniform float grey;\n"
                                  "out vec4 pixel;\n"
                                  "void main() { pixel = vec4(grey); }\n");
}

using ReversedDepthTest = GlTest;

TEST_F(ReversedDepthTest, TellsApartWhatLiesAMillionthBehindAtEveryDistance)
{
    ShaderSources sources;
    add_wall(sources);
    const Program wall(sources, {{"wall.vert.glsl", "wall.frag.glsl"}});
    const Texture colour(TextureFormat::r8, 4, 4);
    const Texture depth(TextureFormat::depth32f, 4, 4);
    const Framebuffer framebuffer({&colour}, &depth);
    const VertexArray no_vertices;
    const auto draw = [&](double ahead_m, float grey) {
        wall.set("ahead_m", static_cast<float>(ahead_m));
        wall.set("grey", grey);
        no_vertices.draw(VertexArray::Shape::triangles, 0, 3);
    };
    framebuffer.bind();
    wall.use();
    wall.set_matrix("to_clip", eye_to_reversed_clip(kAhead, 60_deg, 1.0, 0.1));
    for (double distance_m = 0.5; distance_m < 1e8; distance_m *= 7.0)
        for (const bool near_first : {true, false}) {
            framebuffer.clear();
            const ReversedDepth reversed;
            draw(distance_m * (near_first ? 1.0 : 1.000001), near_first ? 1.0f : 0.5f);
            draw(distance_m * (near_first ? 1.000001 : 1.0), near_first ? 0.5f : 1.0f);
            const Grid<std::uint8_t> seen = read_back<std::uint8_t>(colour);
            EXPECT_EQ(std::ranges::count(seen.values(), 255), 16) << distance_m << ", " << near_first;
        }
}

TEST_F(ReversedDepthTest, LeavesTheTestsOfOthersAlone)
{
    ShaderSources sources;
    add_wall(sources);
    const Program wall(sources, {{"wall.vert.glsl", "wall.frag.glsl"}});
    const Texture colour(TextureFormat::r8, 2, 2);
    const Texture depth(TextureFormat::depth32f, 2, 2);
    const Framebuffer framebuffer({&colour}, &depth);
    framebuffer.bind();
    {
        const ReversedDepth reversed;
    }
    framebuffer.clear();
    wall.use();
    // Depth 1 to -1 over the usual clip space, and no depth test: the last one wins.
    wall.set_matrix("to_clip", {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, -0.5f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f,
                                0.0f, 0.0f, 1.0f});
    wall.set("ahead_m", 1.0f);
    wall.set("grey", 1.0f);
    VertexArray().draw(VertexArray::Shape::triangles, 0, 3);
    EXPECT_EQ(std::ranges::count(read_back<std::uint8_t>(colour).values(), 255), 4);
}

} // namespace
} // namespace duskline::gl
