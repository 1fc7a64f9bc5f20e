#include "exit_code.h"
#include "lamp_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace duskline::window {
namespace {

using testing::HasSubstr;

constexpr LampPlaceForm kForm = {"A,B,C", "1,2,3", "at a place"};

using ParseLamp = TypedLamp (*)(const LampPlaceForm& form, const std::string& typed);

std::string refusal_of(ParseLamp parse, const std::string& typed)
{
    try {
        parse(kForm, typed);
    } catch (const cli::UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(LampSettings, OfALampSayWhatIsNotUsual)
{
    const TypedLamp lamp = parse_lamp(kForm, "-155.62,20.1,+30");
    EXPECT_EQ(lamp.option, "--lamp");
    EXPECT_THAT(lamp.place, testing::ElementsAre("-155.62", "20.1", "+30"));
    EXPECT_EQ(lamp.light, usual_lamp());
    EXPECT_EQ(option_of("1,2,3", lamp.light), "--lamp 1,2,3");

    const LampSettings named =
        parse_lamp(kForm, "200,-20.125,0.5,strength=2.5,reach=20,range=300,colour=ffcc88").light;
    EXPECT_EQ(named.strength, 2.5);
    EXPECT_EQ(named.reach_m, 20.0);
    EXPECT_EQ(named.range_m, 300.0);
    EXPECT_EQ(named.colour, (Colour{1.0f, 204.0f / 255.0f, 136.0f / 255.0f}));
    EXPECT_EQ(option_of("1,2,3", named), "--lamp 1,2,3,strength=2.5,reach=20,range=300,colour=#ffcc88");
}

TEST(LampSettings, OfASearchlightSayItsBeamAndComeBackTheSame)
{
    const TypedLamp lamp = parse_searchlight(kForm, "10,-45,2,220,-7.5,8");
    ASSERT_TRUE(lamp.light.beam);
    EXPECT_EQ(lamp.option, "--searchlight");
    EXPECT_DOUBLE_EQ(lamp.light.beam->azimuth.degrees(), 220.0);
    EXPECT_DOUBLE_EQ(lamp.light.beam->altitude.degrees(), -7.5);
    EXPECT_DOUBLE_EQ(lamp.light.beam->half_angle.degrees(), 8.0);
    EXPECT_GT(lamp.light.reach_m, usual_lamp().reach_m);
    for (const char* text : {"1,2,3,220,-7.5,8", "1,2,3,-20,90,60,edge=0.5",
                             "1,2,3,0,0,179,strength=0.001,range=1e+06,colour=#010203"}) {
        const std::string option = option_of("1,2,3", parse_searchlight(kForm, text).light);
        const std::string again = option.substr(option.find(' ') + 1);
        EXPECT_EQ(option_of("1,2,3", parse_searchlight(kForm, again).light), option) << text;
        EXPECT_THAT(option, HasSubstr("--searchlight ")) << text;
    }
}

TEST(LampSettings, BeyondTheirRangesAreRefusedWithWhatIsRight)
{
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20"), HasSubstr("--lamp must be A,B,C[,NAME=VALUE...]"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,strength=2"), HasSubstr("got '-155,20,strength=2'"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,3,4"), HasSubstr("--lamp has no '4'; there are: strength"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,3,size=4"), HasSubstr("--lamp has no 'size=4'"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,strength=0"),
                HasSubstr("must be above 0 to 1000000, got 0"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,reach=far"),
                HasSubstr("reach of --lamp must be a finite number"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,colour=red"), HasSubstr("must be #RRGGBB"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3"), HasSubstr("AZIMUTH,ALTITUDE,HALF_ANGLE"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3,0,91,5"), HasSubstr("altitude of --searchlight"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3,0,0,180"), HasSubstr("half angle of --searchlight"));
}

TEST(LampSettings, BecomeALampOfTheSceneAsBrightAtItsReachAsItIsStrong)
{
    LampSettings settings = usual_lamp();
    settings.strength = 4.0;
    settings.reach_m = 50.0;
    const SceneLamp lamp = scene_lamp(settings, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0});
    EXPECT_NEAR(light_at(lamp, 50.0), 4.0, 1e-6);
    EXPECT_FALSE(is_searchlight(lamp));
    const SceneLamp beam = scene_lamp(usual_searchlight({}), {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0});
    EXPECT_TRUE(is_searchlight(beam));
    EXPECT_EQ(beam.direction.y, 1.0);
}

} // namespace
} // namespace duskline::window
