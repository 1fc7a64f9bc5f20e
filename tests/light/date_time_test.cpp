#include <duskline/geometry/invalid_input.h>
#include <duskline/light/date_time.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace duskline {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

std::string in_utc(std::string_view text)
{
    return to_iso8601({parse_date_time(text).utc});
}

TEST(DateTimeText, TurnsLocalTimeIntoUtc)
{
    EXPECT_EQ(in_utc("2026-06-21T18:30-10:00"), "2026-06-22T04:30:00Z");
    EXPECT_EQ(in_utc("2024-01-15T08:00+05:45"), "2024-01-15T02:15:00Z");
    EXPECT_EQ(in_utc("2024-01-01T00:00:00+14:00"), "2023-12-31T10:00:00Z");
    EXPECT_EQ(in_utc("2024-02-29T23:59:59-14:00"), "2024-03-01T13:59:59Z");
    EXPECT_EQ(in_utc("1600-01-01T00:00Z"), "1600-01-01T00:00:00Z");
}

TEST(DateTimeText, TakesTheSpellingsPeopleUse)
{
    for (const char* text :
         {"2026-06-21T18:30Z", "2026-06-21 18:30Z", "2026-06-21t18:30z", "2026-06-21T18:30:00Z",
          "2026-06-21T18:30:00.000Z", "2026-06-21T18:30+00:00", "2026-06-21T18:30-00:00",
          "2026-06-21T20:30+02", "2026-06-21T20:30+0200", "2026-06-21T13:00-05:30"})
        EXPECT_EQ(in_utc(text), "2026-06-21T18:30:00Z") << text;
}

TEST(DateTimeText, KeepsFractionsOfASecondToTheMicrosecond)
{
    const UtcTime whole = parse_date_time("2026-06-21T18:30:15Z").utc;
    EXPECT_EQ(parse_date_time("2026-06-21T18:30:15.25Z").utc - whole, 250ms);
    EXPECT_EQ(parse_date_time("2026-06-21T18:30:15,000001Z").utc - whole, 1us);
    EXPECT_EQ(parse_date_time("2026-06-21T18:30:15.0000019Z").utc - whole, 1us);
}

TEST(DateTimeText, TakesALeapSecondWhereOneMayBe)
{
    EXPECT_EQ(in_utc("2016-12-31T23:59:60Z"), "2017-01-01T00:00:00Z");
    EXPECT_EQ(in_utc("2017-01-01T01:59:60+02:00"), "2017-01-01T00:00:00Z");
    EXPECT_EQ(in_utc("2012-06-30T23:59:60.5Z"),
              "2012-07-01T00:00:00Z"); // shown cut to seconds, rounded to even
    for (const char* text : {"2016-12-30T23:59:60Z", "2016-12-31T22:59:60Z", "2016-12-31T23:59:60+02:00"})
        EXPECT_THROW(parse_date_time(text), InvalidInput) << text;
}

TEST(DateTimeText, RemembersTheOffsetOfTheClock)
{
    const DateTime time = parse_date_time("2026-06-21T18:30-10:00");
    EXPECT_EQ(time.utc_offset, -10h);
    EXPECT_EQ(to_iso8601(time), "2026-06-21T18:30:00-10:00");
    EXPECT_EQ(local_date(time), parse_date("2026-06-21"));
    EXPECT_EQ(local_date({time.utc}), parse_date("2026-06-22"));
    EXPECT_EQ(to_iso8601(parse_date_time("2026-06-21T18:30-03:30")), "2026-06-21T18:30:00-03:30");
}

struct WrongText {
    const char* text;
    const char* says;
};

void PrintTo(const WrongText& wrong, std::ostream* out)
{
    *out << '\'' << wrong.text << '\'';
}

class WrongDateTime : public ::testing::TestWithParam<WrongText> {};

TEST_P(WrongDateTime, IsRefusedAndSaysWhatWouldBeRight)
{
    try {
        parse_date_time(GetParam().text);
        FAIL() << "was taken";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("'" + std::string(GetParam().text) + "'"));
        EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongDateTime,
    ::testing::Values(WrongText{"2026-06-21T18:30", "no offset from UTC; add Z or one like -10:00"},
                      WrongText{"2026-06-21", "no time of day"}, WrongText{"2026-06-21T", "no time of day"},
                      WrongText{"2026-02-30T12:00Z", "February 2026 has 28 days"},
                      WrongText{"2023-02-29T12:00Z", "February 2023 has 28 days"},
                      WrongText{"2026-04-31T12:00Z", "April 2026 has 30 days"},
                      WrongText{"2026-06-00T12:00Z", "June 2026 has 30 days"},
                      WrongText{"2026-13-01T12:00Z", "months are 01 to 12"},
                      WrongText{"0000-01-01T12:00Z", "before the year 0001"},
                      WrongText{"2026-06-21T24:00Z", "hours are 00 to 23"},
                      WrongText{"2026-06-21T18:60Z", "minutes are 00 to 59"},
                      WrongText{"2026-06-21T18:30:61Z", "seconds are 00 to 59"},
                      WrongText{"2026-06-21T18:30:15.Z", "digits after its decimal point"},
                      WrongText{"2026-06-21T18:30:1Z", "two digits of seconds"},
                      WrongText{"2026-06-21T18Z", "no time of day such as 18:30"},
                      WrongText{"2026-06-21T18:30+15:00", "more than 14 hours"},
                      WrongText{"2026-06-21T18:30+14:01", "more than 14 hours"},
                      WrongText{"2026-06-21T18:30+2:00", "no offset from UTC such as +05:45"},
                      WrongText{"2026-06-21T18:30+05:", "no offset from UTC such as +05:45"},
                      WrongText{"2026-06-21T18:30+05:60", "no offset from UTC such as +05:45"},
                      WrongText{"2026-06-21T18:30Zulu", "goes on after its offset"},
                      WrongText{"2026-06-21T18:30 PM", "no offset from UTC"},
                      WrongText{"21.6.2026 18:30", "does not begin with a date"},
                      WrongText{"26-06-21T18:30Z", "does not begin with a date"},
                      WrongText{"2026-6-21T18:30Z", "does not begin with a date"}, //
                      WrongText{"now", "does not begin with a date"},
                      WrongText{"", "does not begin with a date"}));

TEST(DateText, ReadsADayAndRefusesWhatIsNone)
{
    EXPECT_EQ(parse_date("2024-02-29"), CalendarDate(std::chrono::year(2024) / 2 / 29));
    for (const char* text : {"2023-02-29", "2024-02-29T12:00Z", "2024-2-29", "", "yesterday"})
        EXPECT_THROW(parse_date(text), InvalidInput) << text;
}

TEST(UtcOffsetText, ReadsHoursAndMinutes)
{
    EXPECT_EQ(parse_utc_offset("Z"), 0min);
    EXPECT_EQ(parse_utc_offset("+05:45"), 345min);
    EXPECT_EQ(parse_utc_offset("-1000"), -600min);
    EXPECT_EQ(parse_utc_offset("+02"), 120min);
    for (const char* text : {"", "2", "02:00", "+2", "+15:00", "CET", "+02:00h"})
        EXPECT_THROW(parse_utc_offset(text), InvalidInput) << text;
}

TEST(JulianDate, AgreesWithTheTableOfTheSolarPositionAlgorithm)
{
    // Reda and Andreas, table A4.1, as far as it is in the Gregorian calendar.
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("2000-01-01T12:00Z").utc), 2451545.0);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1999-01-01T00:00Z").utc), 2451179.5);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1987-01-27T00:00Z").utc), 2446822.5);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1988-06-19T12:00Z").utc), 2447332.0);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1900-01-01T00:00Z").utc), 2415020.5);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1600-01-01T00:00Z").utc), 2305447.5);
    EXPECT_DOUBLE_EQ(julian_date(parse_date_time("1600-12-31T00:00Z").utc), 2305812.5);
    // 10 April 837 in the Julian calendar of its time is 14 April in ISO 8601's.
    EXPECT_NEAR(julian_date(parse_date_time("0837-04-14T07:12Z").utc), 2026871.8, 1e-6);
}

} // namespace
} // namespace duskline
