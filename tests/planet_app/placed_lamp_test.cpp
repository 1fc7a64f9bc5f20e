#include "exit_code.h"
#include "placed_lamp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace duskline::planet_app {
namespace {

using testing::HasSubstr;

PlacedLamp read(const std::string& typed)
{
    return placed_lamp(window::parse_lamp(lamp_place_form(), typed));
}

std::string refusal_of(const std::string& typed)
{
    try {
        read(typed);
    } catch (const cli::UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(PlacedLamp, StandsWhereItsOptionSaysAndComesBackTheSame)
{
    const PlacedLamp lamp = read("-155.62,20.1,30");
    EXPECT_DOUBLE_EQ(lamp.place.longitude.degrees(), -155.62);
    EXPECT_DOUBLE_EQ(lamp.place.latitude.degrees(), 20.1);
    EXPECT_EQ(lamp.clearance_m, 30.0);
    for (const char* text : {"-155.62,20.1,30", "10.000001,-45,2.25,reach=20", "200,-20.125,0.5"})
        EXPECT_EQ(option_of(read(text)), std::string("--lamp ") + text);
}

TEST(PlacedLamp, IsRefusedBesideThePlanetOrInTheGround)
{
    EXPECT_THAT(refusal_of("-155,20"), HasSubstr("--lamp must be LON,LAT,HEIGHT[,NAME=VALUE...]"));
    EXPECT_THAT(refusal_of("-200,20,3"), HasSubstr("longitude of --lamp must be from -180 to 360"));
    EXPECT_THAT(refusal_of("10,-90.5,3"), HasSubstr("latitude of --lamp must be from -90 to 90"));
    EXPECT_THAT(refusal_of("10,20,0"), HasSubstr("height over the ground of --lamp must be from 0.1"));
}

} // namespace
} // namespace duskline::planet_app
