#include "gl/gl_test.h"

#include <duskline/geometry/invalid_input.h>

#include <gmock/gmock.h>

namespace duskline::gl {

void GlTest::SetUp()
{
    try {
        context_.emplace();
    } catch (const UnsupportedOnThisMachine& reason) {
        GTEST_SKIP() << reason.what();
    }
    messages_.emplace();
}

void GlTest::TearDown()
{
    if (messages_) {
        EXPECT_THAT(messages_->take(), testing::IsEmpty());
    }
    messages_.reset();
    context_.reset();
}

} // namespace duskline::gl
