#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace duskline {

/// A moment, counted from 1970 in UTC days of 86400 seconds, to the microsecond. The inserted second of a leap
/// second is the same moment as the second after it.
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

using CalendarDate = std::chrono::year_month_day;

/// A moment and the clock it was told by.
struct DateTime {
    UtcTime utc;
    std::chrono::minutes utc_offset{0}; ///< of the local clock, east positive, -14:00 to +14:00
};

/// Reads an ISO 8601 date and time of the Gregorian calendar with its offset from UTC:
/// `2026-06-21T18:30-10:00`, `2026-06-22T04:30:15.25Z`, `2024-01-15T08:00+05:45`. A blank may stand for the T.
/// Years are 0001 to 9999. Second 60 is taken where a leap second may be: at 23:59 UTC on the last of June or
/// December. Throws InvalidInput on anything else, a missing offset above all: a time without one is a guess.
DateTime parse_date_time(std::string_view text);

/// Reads a date, `2026-06-21`. Throws InvalidInput when there is no such day.
CalendarDate parse_date(std::string_view text);

/// Reads `Z`, `+05:45`, `-1000` or `+02`. Throws InvalidInput beyond 14 hours.
std::chrono::minutes parse_utc_offset(std::string_view text);

/// `2026-06-21T18:30:00-10:00` by the local clock, rounded to the second; `Z` where the offset is none.
std::string to_iso8601(const DateTime& time);

/// The date by the local clock.
CalendarDate local_date(const DateTime& time);

/// Days since noon of 1 January 4713 BC (Julian calendar), UTC. Rounded to about 0.05 ms of time.
double julian_date(UtcTime time);

} // namespace duskline
