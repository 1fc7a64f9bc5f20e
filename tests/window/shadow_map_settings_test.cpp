#include "exit_code.h"
#include "shadow_map_settings.h"

#include <duskline/geometry/invalid_input.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace duskline::window {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr auto kAll =
    "size=512,filter=disc,linear=off,penumbra=on,samples=12,spread=1.5,offset=2,faces=away,reach=20,"
    "wide=200,overcast=0.25,overlay=box";

template <typename Error>
std::string refusal_of(const std::string& text)
{
    try {
        if constexpr (std::is_same_v<Error, cli::UsageError>)
            parse_shadow_map_option(text);
        else
            parse_shadow_map(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ShadowMapSettings, AreWhatIsTyped)
{
    const ShadowMapSettings settings = parse_shadow_map(kAll);

    EXPECT_EQ(settings.options.size, 512U);
    EXPECT_EQ(settings.options.filter, gl::ShadowMapFilter::disc);
    EXPECT_FALSE(settings.options.linear_compare);
    EXPECT_TRUE(settings.options.penumbra_only);
    EXPECT_EQ(settings.options.samples, 12U);
    EXPECT_EQ(settings.options.spread, 1.5);
    EXPECT_EQ(settings.options.slope_offset, 2.0);
    EXPECT_EQ(settings.options.faces, gl::CasterFaces::away_from_light);
    EXPECT_EQ(settings.options.reach, 20.0);
    EXPECT_EQ(settings.options.wide_reach, 200.0);
    EXPECT_EQ(settings.look.overcast, 0.25);
    EXPECT_EQ(settings.look.overlay, gl::ShadowMapOverlay::box);
}

TEST(ShadowMapSettings, ComeBackFromTheirText)
{
    EXPECT_EQ(text_of(parse_shadow_map(kAll)), kAll);
    EXPECT_EQ(text_of(parse_shadow_map("filter=none")), "filter=none");
}

TEST(ShadowMapSettings, HaveUsualValuesThatNeedNoText)
{
    EXPECT_EQ(text_of(parse_shadow_map("")), "");
    EXPECT_EQ(text_of(parse_shadow_map("size=4096,filter=kernels,linear=on")), "");
}

TEST(ShadowMapSettings, AreRefusedByNameAndValueWithWhatWouldBeRight)
{
    EXPECT_THAT(refusal_of<InvalidInput>("colour=red"),
                HasSubstr("no setting 'colour=red'; there are: size"));
    EXPECT_THAT(refusal_of<InvalidInput>("filter"), HasSubstr("no setting 'filter'"));
    EXPECT_THAT(refusal_of<InvalidInput>("filter=blur"),
                HasSubstr("filter must be one of none, kernels, disc"));
    EXPECT_THAT(refusal_of<InvalidInput>("overcast=2"), HasSubstr("overcast must be 0 to 1, got '2'"));
    EXPECT_THAT(refusal_of<InvalidInput>("overcast=nan"), HasSubstr("got 'nan'"));
    EXPECT_THAT(refusal_of<InvalidInput>("samples=8.5"),
                HasSubstr("samples must be a whole number, got '8.5'"));
    EXPECT_THAT(refusal_of<InvalidInput>("reach=50,wide=50"), HasSubstr("above its reach of 50, got 50"));
}

TEST(ShadowMapSettings, NameTheirOptionWhenTypedWrong)
{
    EXPECT_THAT(refusal_of<cli::UsageError>("overcast=2"), StartsWith("--shadow-map: "));
}

} // namespace
} // namespace duskline::window
