#include "gl/gl_test.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/buffer.h>
#include <duskline/gl/live_objects.h>
#include <duskline/gl/program.h>

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace duskline::gl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Writes `number` and whatever the included text makes of it.
constexpr const char* kAnswer = R"(#version 430 core
#include "answer.glsl"
#include "answer.glsl"
layout(local_size_x = 2) in;
layout(std430, binding = 3) buffer Out { float values[]; };
uniform float number;
void main()
{
    values[gl_GlobalInvocationID.x] = answer(number) + OFFSET;
}
)";

ShaderSources answering_sources(const std::string& answer)
{
    ShaderSources sources;
    sources.add("answer.comp.glsl", kAnswer);
    sources.add("answer.glsl", answer);
    return sources;
}

std::vector<float> answers_of(const Program& program, float number)
{
    const Buffer out(4 * sizeof(float));
    out.bind_as_storage(3);
    program.set("number", number);
    dispatch(program, 3);
    return out.download<float>();
}

using ProgramTest = GlTest;

TEST_F(ProgramTest, ComputesWithDefinesAndIncludes)
{
    const auto sources = answering_sources("float answer(float x) { return 2.0 * x; }\n");
    const Program program(sources, {{"answer.comp.glsl"}, {{"OFFSET", "0.5"}}});
    EXPECT_THAT(answers_of(program, 3.0f), ElementsAre(6.5f, 6.5f, 6.5f, 6.5f)); // whole groups of two
}

TEST_F(ProgramTest, ErrorsNameTheIncludedFileAndItsLine)
{
    const auto sources = answering_sources("float twice(float x) { return 2.0 * x; }\n"
                                           "float answer(float x) { return twice(x, x); }\n");
    EXPECT_THAT(
        [&] {
            Program(sources, {{"answer.comp.glsl"}, {{"OFFSET", "0.5"}}});
        },
        ThrowsMessage<ShaderError>(
            AllOf(HasSubstr("answer.comp.glsl does not compile"), HasSubstr("answer.glsl:2"))));
}

TEST_F(ProgramTest, ErrorsBehindAnIncludeNameTheLineInTheirOwnFile)
{
    const auto sources = answering_sources("float answer(float x) { return 2.0 * x; }\n");
    EXPECT_THAT([&] { Program(sources, {{"answer.comp.glsl"}}); }, // OFFSET is not defined
                ThrowsMessage<ShaderError>(HasSubstr("answer.comp.glsl:9")));
}

TEST_F(ProgramTest, StagesThatDoNotFitAreNamed)
{
    ShaderSources sources;
    sources.add("paint.vert.glsl", "#version 430 core\nvoid main() { gl_Position = vec4(0.0); }\n");
    sources.add("paint.frag.glsl", "#version 430 core\nin vec2 missing;\nout vec4 colour;\n"
                                   "void main() { colour = missing.xyxy; }\n");
    EXPECT_THAT(
        [&] {
            Program(sources, {{"paint.vert.glsl", "paint.frag.glsl"}});
        },
        ThrowsMessage<ShaderError>(HasSubstr("paint.vert.glsl + paint.frag.glsl do not link")));
}

TEST_F(ProgramTest, FileNamesTellTheStage)
{
    ShaderSources sources;
    sources.add("paint.glsl", "#version 430 core\n");
    EXPECT_THAT([&] { Program(sources, {{"paint.glsl"}}); },
                ThrowsMessage<InvalidInput>(HasSubstr("pass.stage.glsl")));
}

TEST(ShaderSourcesTest, AMissingFileIsAskedForInALine)
{
    ShaderSources sources;
    sources.add("lost.comp.glsl", "#version 430 core\n\n#include \"nowhere.glsl\"\n");
    EXPECT_THAT([&] { expanded_shader(sources, "lost.comp.glsl"); },
                ThrowsMessage<ShaderError>(AllOf(HasSubstr("lost.comp.glsl:3"), HasSubstr("nowhere.glsl"))));
}

class LiveReload : public GlTest {
protected:
    void SetUp() override
    {
        GlTest::SetUp();
        folder_ = std::filesystem::path(testing::TempDir()) / "duskline_live_reload";
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override
    {
        std::filesystem::remove_all(folder_);
        GlTest::TearDown();
    }

    // As if it were saved so many seconds from now: file systems count time in steps.
    void save(const std::string& name, const std::string& text, int seconds)
    {
        std::ofstream(folder_ / name) << text;
        std::filesystem::last_write_time(folder_ / name, std::filesystem::file_time_type::clock::now()
                                                             + std::chrono::seconds(seconds));
    }

    std::filesystem::path folder_;
};

TEST_F(LiveReload, FollowsFilesAndKeepsWhatWorked)
{
    save("answer.glsl", "float answer(float x) { return x; }\n", 0);
    ShaderSources sources(folder_);
    sources.add("answer.comp.glsl", kAnswer);
    Program program(sources, {{"answer.comp.glsl"}, {{"OFFSET", "0.0"}}});
    EXPECT_FALSE(program.reload_if_changed(sources));
    EXPECT_EQ(answers_of(program, 3.0f).front(), 3.0f);

    save("answer.glsl", "float answer(float x) { return -x; }\n", 10);
    EXPECT_TRUE(program.reload_if_changed(sources));
    EXPECT_EQ(answers_of(program, 3.0f).front(), -3.0f);

    save("answer.glsl", "float answer(float x) { return }\n", 20);
    EXPECT_THROW(program.reload_if_changed(sources), ShaderError);
    EXPECT_FALSE(program.reload_if_changed(sources)); // said once
    EXPECT_EQ(answers_of(program, 3.0f).front(), -3.0f);
}

TEST_F(ProgramTest, GoesAtOnceEvenWhenItIsCurrent)
{
    const LiveObjects before = live_objects();
    {
        const Program program(ShaderSources(), {.stages = {"full_screen.vert.glsl", "sky.frag.glsl"}});
        program.use();
        EXPECT_EQ(live_objects().programs, before.programs + 1);
    }
    EXPECT_EQ(live_objects(), before);
}

} // namespace
} // namespace duskline::gl
