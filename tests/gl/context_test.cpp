#include "gl/gl_test.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/buffer.h>
#include <duskline/gl/context.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/live_objects.h>
#include <duskline/gl/texture.h>
#include <duskline/gl/timer_query.h>

#include <gmock/gmock.h>

#include <utility>

namespace duskline::gl {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

using Context = GlTest;

TEST_F(Context, WithoutAWindowIsOpenGl43OrLater)
{
    const ContextInfo info = current_context();
    EXPECT_GE(info.major_version * 10 + info.minor_version, 43);
    EXPECT_THAT(info.renderer, Not(IsEmpty()));
    EXPECT_GE(info.largest_texture, 16384);
}

TEST_F(Context, TwoMayBeThereAndEitherBeCurrent)
{
    HeadlessContext other;
    const Texture in_other(TextureFormat::r32f, 1, 1);
    HeadlessContext moved = std::move(other);
    moved.make_current();
    EXPECT_NO_THROW(current_context());
}

TEST_F(Context, NoneIsSaidInWords)
{
    {
        const HeadlessContext passing; // leaves none current when it goes
    }
    EXPECT_THAT([] { current_context(); },
                ThrowsMessage<UnsupportedOnThisMachine>(HasSubstr("no OpenGL context is current")));
}

TEST_F(Context, IsKeptWhileNothingHappensToIt)
{
    EXPECT_NO_THROW(require_context_kept());
}

TEST_F(Context, CountsTheObjectsThatAreThere)
{
    const LiveObjects before = live_objects();
    {
        const Texture texture(TextureFormat::r32f, 4, 4);
        const Framebuffer framebuffer({&texture});
        Buffer buffer(16);
        buffer.bind_as_storage(0);
        const LiveObjects with = live_objects();
        EXPECT_EQ(with.textures, before.textures + 1);
        EXPECT_EQ(with.framebuffers, before.framebuffers + 1);
        EXPECT_EQ(with.buffers, before.buffers + 1);
        EXPECT_EQ(with.programs, before.programs);
    }
    EXPECT_EQ(live_objects(), before);
}

TEST_F(Context, ComplaintsOfTheDriverAreHeard)
{
    Texture texture(TextureFormat::rgba8, 4, 4);
    texture.bind(100000); // far more units than there are
    EXPECT_THAT(complaints(), Not(IsEmpty()));
}

TEST_F(Context, ListenersAreHeardInTurn)
{
    Texture texture(TextureFormat::rgba8, 4, 4);
    {
        DebugMessages inner;
        texture.bind(100000);
        EXPECT_THROW(inner.throw_if_any("binding"), std::runtime_error);
        EXPECT_NO_THROW(inner.throw_if_any("binding"));
    }
    EXPECT_THAT(complaints(), IsEmpty());
    texture.bind(100000);
    EXPECT_THAT(complaints(), Not(IsEmpty()));
}

TEST_F(Context, TimesWhatTheCardDoes)
{
    const TimerQuery timer;
    timer.begin();
    const Texture texture(TextureFormat::r32f, 256, 256);
    timer.end();
    EXPECT_GE(timer.wait_for_milliseconds(), 0.0);
    EXPECT_TRUE(timer.milliseconds().has_value());
}

} // namespace
} // namespace duskline::gl
