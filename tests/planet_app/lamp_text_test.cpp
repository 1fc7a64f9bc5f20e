#include "exit_code.h"
#include "lamp_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace duskline::planet_app {
namespace {

using testing::HasSubstr;

std::string refusal_of(PlacedLamp (*read)(const std::string&), const std::string& typed)
{
    try {
        read(typed);
    } catch (const cli::UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(LampText, OfALampSaysItsPlaceAndWhatIsNotUsual)
{
    const PlacedLamp lamp = parse_lamp("-155.62,20.1,30");
    EXPECT_DOUBLE_EQ(lamp.place.longitude.degrees(), -155.62);
    EXPECT_DOUBLE_EQ(lamp.place.latitude.degrees(), 20.1);
    EXPECT_EQ(lamp.clearance_m, 30.0);
    EXPECT_FALSE(lamp.beam);
    EXPECT_EQ(option_of(lamp), "--lamp -155.62,20.1,30");

    const PlacedLamp named = parse_lamp("200,-20.125,0.5,strength=2.5,reach=20,range=300,colour=ffcc88");
    EXPECT_EQ(named.strength, 2.5);
    EXPECT_EQ(named.reach_m, 20.0);
    EXPECT_EQ(named.range_m, 300.0);
    EXPECT_EQ(named.colour, (Colour{1.0f, 204.0f / 255.0f, 136.0f / 255.0f}));
    EXPECT_EQ(option_of(named), "--lamp 200,-20.125,0.5,strength=2.5,reach=20,range=300,colour=#ffcc88");
}

TEST(LampText, OfASearchlightSaysItsBeamAndComesBackTheSame)
{
    const PlacedLamp lamp = parse_searchlight("10,-45,2,220,-7.5,8");
    ASSERT_TRUE(lamp.beam);
    EXPECT_DOUBLE_EQ(lamp.beam->azimuth.degrees(), 220.0);
    EXPECT_DOUBLE_EQ(lamp.beam->altitude.degrees(), -7.5);
    EXPECT_DOUBLE_EQ(lamp.beam->half_angle.degrees(), 8.0);
    EXPECT_GT(lamp.reach_m, parse_lamp("10,-45,2").reach_m);
    for (const char* text : {"10,-45,2,220,-7.5,8", "10.000001,-45,2.25,-20,90,60,edge=0.5",
                             "0,0,1000,0,0,179,strength=0.001,range=1e+06,colour=#010203"}) {
        const std::string option = option_of(parse_searchlight(text));
        const std::string again = option.substr(option.find(' ') + 1);
        EXPECT_EQ(option_of(parse_searchlight(again)), option) << text;
        EXPECT_THAT(option, HasSubstr("--searchlight ")) << text;
    }
}

TEST(LampText, BeyondItsRangesIsRefusedWithWhatIsRight)
{
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20"),
                HasSubstr("--lamp must be LON,LAT,HEIGHT[,NAME=VALUE...]"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,strength=2"), HasSubstr("got '-155,20,strength=2'"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,3,4"), HasSubstr("--lamp has no '4'; there are: strength"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-155,20,3,size=4"), HasSubstr("--lamp has no 'size=4'"));
    EXPECT_THAT(refusal_of(&parse_lamp, "-200,20,3"),
                HasSubstr("longitude of --lamp must be from -180 to 360"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,0"),
                HasSubstr("height over the ground of --lamp must be from 0.1"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,strength=0"),
                HasSubstr("must be above 0 to 1000000, got 0"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,reach=far"),
                HasSubstr("reach of --lamp must be a finite number"));
    EXPECT_THAT(refusal_of(&parse_lamp, "10,20,3,colour=red"), HasSubstr("must be #RRGGBB"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3"), HasSubstr("AZIMUTH,ALTITUDE,HALF_ANGLE"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3,0,91,5"), HasSubstr("altitude of --searchlight"));
    EXPECT_THAT(refusal_of(&parse_searchlight, "10,20,3,0,0,180"), HasSubstr("half angle of --searchlight"));
}

} // namespace
} // namespace duskline::planet_app
