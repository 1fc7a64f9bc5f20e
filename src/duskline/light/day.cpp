#include <duskline/light/day.h>

#include <cmath>
#include <vector>

namespace duskline {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::minutes;

constexpr microseconds kMeanDay = hours(24);
constexpr microseconds kStep = minutes(15);

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

class Horizon {
public:
    Horizon(const Place& place, const SunOptions& options) : place_(place), options_(options)
    {
        options_.air.reset();
    }

    bool is_above(UtcTime time) const
    {
        return sun_position(time, place_, options_).geometric_altitude > kSunriseAltitude;
    }

    // When the sun crosses between two moments on different sides of the horizon.
    UtcTime crossing(UtcTime from, UtcTime to) const
    {
        const bool above_at_first = is_above(from);
        while (to - from > std::chrono::milliseconds(1)) {
            const UtcTime middle = from + (to - from) / 2;
            (is_above(middle) == above_at_first ? from : to) = middle;
        }
        return to;
    }

private:
    Place place_;
    SunOptions options_;
};

// One change from night to day or back.
struct Crossing {
    UtcTime time;
    bool rises;
};

struct Course {
    std::vector<Crossing> crossings;
    bool starts_above;
    microseconds above{0};
};

Course course_around(UtcTime noon, const Horizon& horizon)
{
    const UtcTime first = noon - kMeanDay / 2;
    const UtcTime last = noon + kMeanDay / 2;
    Course course{.crossings = {}, .starts_above = horizon.is_above(first)};
    bool above = course.starts_above;
    UtcTime since = first;
    for (UtcTime time = first + kStep; time <= last; time += kStep) {
        if (horizon.is_above(time) == above)
            continue;
        const UtcTime change = horizon.crossing(time - kStep, time);
        if (above)
            course.above += change - since;
        above = !above;
        since = change;
        course.crossings.push_back({change, above});
    }
    if (above)
        course.above += last - since;
    return course;
}

} // namespace

SunDay sun_day(CalendarDate date, minutes utc_offset, const Place& place, const SunOptions& options)
{
    SunDay day;
    day.noon = solar_noon(std::chrono::sys_days(date) + hours(12) - utc_offset, place, options);
    SunOptions without_air = options;
    without_air.air.reset();
    day.noon_altitude = sun_position(day.noon, place, without_air).geometric_altitude;

    const Course course = course_around(day.noon, Horizon(place, options));
    day.daylight = course.above;
    if (course.crossings.empty()) {
        day.kind = course.starts_above ? SunDayKind::polar_day : SunDayKind::polar_night;
        return day;
    }
    // The last sunrise before noon and the first sunset after it; at the poles, where the sun takes half a year
    // between them, whichever there is.
    for (const auto& [time, rises] : course.crossings) {
        if (rises && (!day.sunrise || time <= day.noon))
            day.sunrise = time;
        if (!rises && (!day.sunset || *day.sunset < day.noon))
            day.sunset = time;
    }
    return day;
}

} // namespace duskline
