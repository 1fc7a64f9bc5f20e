#include <duskline/light/day.h>
#include <duskline/light/sun_course.h>

#include <cmath>
#include <vector>

namespace duskline {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::minutes;

constexpr microseconds kMeanDay = hours(24);

// When the sun crosses the place's meridian, nearest to `guess`.
UtcTime solar_noon(UtcTime guess, const Place& place, const SunOptions& options)
{
    const UtcTime midday = std::chrono::floor<std::chrono::days>(guess) + hours(12);
    UtcTime noon = guess;
    // The equation of time moves by at most 30 s a day, so the third step is exact to the microsecond.
    for (int i = 0; i < 3; ++i) {
        const double east_min = 4.0 * place.longitude.degrees();
        const double ahead_min = east_min + equation_of_time_min(noon, options);
        noon = midday - microseconds(std::llround(ahead_min * 60.0e6));
        noon += std::llround((guess - noon) / std::chrono::duration<double, microseconds::period>(kMeanDay))
                * kMeanDay;
    }
    return noon;
}

// One change from night to day or back.
struct Crossing {
    UtcTime time;
    bool rises;
};

// Sunrises and sunsets in the order they come.
std::vector<Crossing> crossings_of(const std::vector<TimeSpan>& light, const TimeSpan& whole)
{
    std::vector<Crossing> crossings;
    for (const TimeSpan& span : light) {
        if (span.from != whole.from)
            crossings.push_back({span.from, true});
        if (span.to != whole.to)
            crossings.push_back({span.to, false});
    }
    return crossings;
}

} // namespace

SunDay sun_day(CalendarDate date, minutes utc_offset, const Place& place, const SunOptions& options)
{
    SunDay day;
    day.noon = solar_noon(std::chrono::sys_days(date) + hours(12) - utc_offset, place, options);
    SunOptions without_air = options;
    without_air.air.reset();
    day.noon_altitude = sun_position(day.noon, place, without_air).geometric_altitude;

    day.midnights = {day.noon - kMeanDay / 2, day.noon + kMeanDay / 2};
    const std::vector<TimeSpan> light = spans_above_horizon(day.midnights, [&](UtcTime time) {
        return sun_position(time, place, without_air).geometric_altitude - kSunriseAltitude;
    });
    for (const TimeSpan& span : light)
        day.daylight += span.length();
    const std::vector<Crossing> crossings = crossings_of(light, day.midnights);
    if (crossings.empty()) {
        day.kind = light.empty() ? SunDayKind::polar_night : SunDayKind::polar_day;
        return day;
    }
    // The last sunrise before noon and the first sunset after it; at the poles, where the sun takes half a year
    // between them, whichever there is.
    for (const auto& [time, rises] : crossings) {
        if (rises && (!day.sunrise || time <= day.noon))
            day.sunrise = time;
        if (!rises && (!day.sunset || *day.sunset < day.noon))
            day.sunset = time;
    }
    return day;
}

} // namespace duskline
