#include "gl/gl_test.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/texture_array.h>
#include <duskline/gl/vertex_array.h>

#include <gmock/gmock.h>

namespace duskline::gl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

using TextureArrayTest = GlTest;

TEST_F(TextureArrayTest, GivesShadersTheLayersItWasFilledWith)
{
    TextureArray layers(TextureFormat::r32f, 2, 3, 4);
    for (std::size_t layer = 0; layer < 4; ++layer) {
        Grid<float> values(3, 2, 10.0f * static_cast<float>(layer));
        values(2, 1) += 5.0f;
        layers.upload(values.view(), layer);
    }
    ShaderSources sources;
    sources.add("layer.frag.glsl", "#version 430 core\n"
                                   "uniform sampler2DArray layers;\n"
                                   "out vec4 pixel;\n"
                                   "void main() { ivec2 at = ivec2(gl_FragCoord.xy);\n"
                                   "    pixel = texelFetch(layers, ivec3(1, 2, at.x), 0); }\n");
    const Program program(sources, {{"full_screen.vert.glsl", "layer.frag.glsl"}});
    const Texture target(TextureFormat::r32f, 4, 1);
    const Framebuffer framebuffer({&target});
    framebuffer.bind();
    program.use();
    layers.bind(3);
    program.set("layers", 3);
    VertexArray().draw(VertexArray::Shape::triangles, 0, 3);
    EXPECT_THAT(read_back<float>(target).values(), testing::ElementsAre(5.0f, 15.0f, 25.0f, 35.0f));
}

TEST_F(TextureArrayTest, RefusesSizesAndLayersInWords)
{
    EXPECT_THAT([] { TextureArray(TextureFormat::r8, 2, 2, 0); },
                ThrowsMessage<InvalidInput>(HasSubstr("got 0")));
    EXPECT_THAT([] { TextureArray(TextureFormat::r8, 0, 2, 1); },
                ThrowsMessage<InvalidInput>(HasSubstr("got 0 x 2")));
    EXPECT_GE(most_layers(), 2048U);
    TextureArray layers(TextureFormat::r32f, 2, 3, 4);
    EXPECT_THAT([&] { layers.upload(Grid<float>(3, 2, 0.0f).view(), 4); },
                ThrowsMessage<InvalidInput>(HasSubstr("no layer 4")));
    EXPECT_THAT([&] { layers.upload(Grid<float>(2, 2, 0.0f).view(), 0); },
                ThrowsMessage<InvalidInput>(HasSubstr("got 2 x 2")));
}

} // namespace
} // namespace duskline::gl
