#include "gl/gl_test.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/texture.h>
#include <duskline/gl/vertex_array.h>

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace duskline::gl {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::ThrowsMessage;

Grid<float> counted(std::size_t rows, std::size_t columns)
{
    Grid<float> values(rows, columns);
    std::iota(values.values().begin(), values.values().end(), 0.5f);
    return values;
}

using TextureTest = GlTest;

TEST_F(TextureTest, GivesBackWhatItWasFilledWith)
{
    const Grid<float> values = counted(3, 5);
    Texture texture(TextureFormat::r32f, 5, 3);
    texture.upload(values);
    EXPECT_THAT(read_back<float>(texture).values(), ElementsAreArray(values.values()));
}

TEST_F(TextureTest, KeepsInfinitiesAndNoData)
{
    Grid<float> values(1, 3);
    values(0, 0) = std::numeric_limits<float>::infinity();
    values(0, 1) = -std::numeric_limits<float>::infinity();
    values(0, 2) = std::numeric_limits<float>::quiet_NaN();
    Texture texture(TextureFormat::r32f, 3, 1);
    texture.upload(values);
    const Grid<float> back = read_back<float>(texture);
    EXPECT_EQ(back(0, 0), values(0, 0));
    EXPECT_EQ(back(0, 1), values(0, 1));
    EXPECT_TRUE(std::isnan(back(0, 2)));
}

TEST_F(TextureTest, TakesARectangleOutOfALargerGrid)
{
    Grid<float> values = counted(6, 7);
    Texture texture(TextureFormat::r32f, 7, 6);
    texture.upload(Grid<float>(6, 7, -1.0f));
    texture.upload(values.view().window(2, 3, 3, 2), 2, 3);
    const Grid<float> back = read_back<float>(texture);
    for (std::size_t row = 0; row < 6; ++row)
        for (std::size_t column = 0; column < 7; ++column) {
            const bool inside = row >= 2 && row < 5 && column >= 3 && column < 5;
            EXPECT_EQ(back(row, column), inside ? values(row, column) : -1.0f) << row << ", " << column;
        }
}

TEST_F(TextureTest, HoldsSeveralChannelsAndIntegers)
{
    Texture colours(TextureFormat::rgba8, 1, 1);
    colours.upload(Grid<std::array<std::uint8_t, 4>>(1, 1, {1, 2, 3, 255}));
    EXPECT_EQ((read_back<std::array<std::uint8_t, 4>>(colours)(0, 0)),
              (std::array<std::uint8_t, 4>{1, 2, 3, 255}));

    Texture pointers(TextureFormat::rg32i, 1, 1);
    pointers.upload(Grid<std::array<std::int32_t, 2>>(1, 1, {-7, 70000}));
    EXPECT_EQ((read_back<std::array<std::int32_t, 2>>(pointers)(0, 0)),
              (std::array<std::int32_t, 2>{-7, 70000}));
}

TEST_F(TextureTest, RefusesSizesAndRectanglesInWords)
{
    EXPECT_THAT([] { Texture(TextureFormat::r8, 0, 3); },
                ThrowsMessage<InvalidInput>(HasSubstr("got 0 x 3")));
    EXPECT_THAT([] { Texture(TextureFormat::r8, 3, 1 << 20); },
                ThrowsMessage<InvalidInput>(HasSubstr("3 x 1048576")));
    EXPECT_THAT([] { Texture(TextureFormat::r8, 4, 4, 4); },
                ThrowsMessage<InvalidInput>(HasSubstr("4 levels")));
    Texture texture(TextureFormat::r32f, 4, 4);
    EXPECT_THAT([&] { texture.upload(Grid<float>(2, 2, 0.0f).view(), 3, 0); },
                ThrowsMessage<InvalidInput>(HasSubstr("row 3")));
}

TEST_F(TextureTest, IsDrawnInto)
{
    ShaderSources sources;
    sources.add("place.frag.glsl", "#version 430 core\nout vec4 colour;\n"
                                   "void main() { colour = vec4(gl_FragCoord.xy, 7.0, 1.0); }\n");
    const Program program(sources, {{"full_screen.vert.glsl", "place.frag.glsl"}});
    const Texture target(TextureFormat::rgba32f, 3, 2);
    const Framebuffer framebuffer({&target});
    framebuffer.clear({9.0f, 9.0f, 9.0f, 9.0f});
    EXPECT_EQ((read_back<std::array<float, 4>>(target)(1, 2)[0]), 9.0f);
    framebuffer.bind();
    program.use();
    VertexArray().draw(VertexArray::Shape::triangles, 0, 3);
    const auto back = read_back<std::array<float, 4>>(target);
    EXPECT_EQ(back(1, 2), (std::array<float, 4>{2.5f, 1.5f, 7.0f, 1.0f}));
    EXPECT_EQ(back(0, 0), (std::array<float, 4>{0.5f, 0.5f, 7.0f, 1.0f}));
}

TEST_F(TextureTest, PicturesHaveTheirTopRowFirst)
{
    Texture target(TextureFormat::rgba8, 1, 2);
    Grid<std::array<std::uint8_t, 4>> rows(2, 1, {0, 0, 0, 255});
    rows(1, 0) = {255, 0, 0, 255}; // OpenGL's upper row
    target.upload(rows);
    const Framebuffer framebuffer({&target});
    framebuffer.bind();
    EXPECT_EQ(read_back_picture(1, 2)(0, 0)[0], 255);
}

TEST_F(TextureTest, FramebuffersRefuseTexturesOfDifferentSizes)
{
    const Texture colour(TextureFormat::rgba8, 4, 4);
    const Texture depth(TextureFormat::depth32f, 4, 5);
    EXPECT_THAT([&] { Framebuffer({&colour}, &depth); },
                ThrowsMessage<InvalidInput>(HasSubstr("4 x 4 and 4 x 5")));
    EXPECT_THROW(Framebuffer({}), InvalidInput);
}

} // namespace
} // namespace duskline::gl
