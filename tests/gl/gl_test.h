#pragma once

#include <duskline/gl/debug_messages.h>
#include <duskline/gl/headless_context.h>

#include <gtest/gtest.h>

#include <optional>

namespace duskline::gl {

/// A test with an OpenGL context of its own. Skipped, with the reason, on machines that have no device for one; fails
/// when the driver finds fault with what was done.
class GlTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// What the driver has complained of so far; it then no longer fails the test.
    std::vector<std::string> complaints() { return messages_->take(); }

private:
    std::optional<HeadlessContext> context_;
    std::optional<DebugMessages> messages_;
};

} // namespace duskline::gl
