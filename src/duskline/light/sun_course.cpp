#include <duskline/geometry/invalid_input.h>
#include <duskline/light/sun_course.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

using std::chrono::microseconds;

constexpr microseconds kLook = std::chrono::minutes(15);

// From here up steps are as long as they may be.
constexpr double kHighSun_deg = 15.0;
constexpr double kShortestStep = 0.1;

double radii_above_centre(Limb limb)
{
    switch (limb) {
    case Limb::upper:
        return 1.0;
    case Limb::lower:
        return -1.0;
    case Limb::centre:
        break;
    }
    return 0.0;
}

// When `is_up` changes between two moments; it is as at `to` from then on.
UtcTime change_between(UtcTime from, UtcTime to, const std::function<bool(UtcTime)>& is_up)
{
    const bool at_first = is_up(from);
    while (to - from > std::chrono::milliseconds(1)) {
        const UtcTime middle = from + (to - from) / 2;
        (is_up(middle) == at_first ? from : to) = middle;
    }
    return to;
}

microseconds step_at(Angle altitude, microseconds longest)
{
    const double share = std::clamp(altitude.degrees() / kHighSun_deg, kShortestStep, 1.0);
    return microseconds(std::llround(share * static_cast<double>(longest.count())));
}

} // namespace

DirectionalLight sunlight_at(UtcTime time, const SunView& view)
{
    DirectionalLight light = sunlight(sun_position(time, view.place, view.options), view.true_to_grid_north);
    const double altitude_deg =
        light.altitude.degrees() + radii_above_centre(view.limb) * light.angular_diameter.degrees() / 2.0;
    light.altitude = Angle::from_degrees(std::min(altitude_deg, 90.0));
    return light;
}

std::vector<TimeSpan> spans_above_horizon(const TimeSpan& whole,
                                          const std::function<Angle(UtcTime)>& altitude)
{
    const auto is_up = [&](UtcTime time) { return altitude(time) > Angle(); };
    std::vector<TimeSpan> spans;
    bool up = is_up(whole.from);
    if (up)
        spans.push_back(whole);
    for (UtcTime time = whole.from; time < whole.to;) {
        const UtcTime next = std::min(time + kLook, whole.to);
        if (is_up(next) != up) {
            const UtcTime change = change_between(time, next, is_up);
            if (up)
                spans.back().to = change;
            else
                spans.push_back({change, whole.to});
            up = !up;
        }
        time = next;
    }
    return spans;
}

std::vector<TimeSpan> daylight_spans(const TimeSpan& whole, const SunView& view)
{
    return spans_above_horizon(whole, [&view](UtcTime time) { return sunlight_at(time, view).altitude; });
}

std::vector<SunSample> sample_sun(const TimeSpan& whole, const SunView& view, microseconds longest_step)
{
    if (!(longest_step > microseconds(0)))
        throw InvalidInput("a step between suns must be above 0, got " + std::to_string(longest_step.count())
                           + " microseconds");
    std::vector<SunSample> samples;
    for (const TimeSpan& daylight : daylight_spans(whole, view)) {
        for (UtcTime from = daylight.from; from < daylight.to;) {
            const microseconds step =
                std::max(step_at(sunlight_at(from, view).altitude, longest_step), microseconds(1));
            const TimeSpan span = {from, std::min(from + step, daylight.to)};
            samples.push_back({span, span.middle(), sunlight_at(span.middle(), view)});
            from = span.to;
        }
    }
    return samples;
}

} // namespace duskline
