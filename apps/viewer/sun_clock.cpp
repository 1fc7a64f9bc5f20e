#include "sun_clock.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/light/day.h>
#include <duskline/products/day_cycle.h>

#include <algorithm>

namespace duskline::viewer {

SunClock::SunClock(const cli::LightSite& site, const cli::SunlightOptions& options,
                   std::optional<double> sun_size_deg)
    : site_(site), air_(options.air), sun_size_(Angle::from_degrees(sun_size_deg.value_or(0.533)))
{
    if (site.body == "Earth")
        place_ = options.at ? options.at : site.place;
}

void SunClock::bring_up_to_date(ViewerLight& light) const
{
    if (!light.time)
        return;
    if (!place_)
        throw InvalidInput(
            "the sun of a time is known on the Earth at a known place only: give --at LON,LAT, or the "
            "light by angles");
    const SunPosition sun = sun_position(light.time->utc, *place_, {.air = air_});
    const Angle from_map_north = sun.azimuth + site_.true_to_grid_north - site_.map_to_grid_north;
    light.azimuth_deg = wrapped_to_circle(from_map_north).degrees();
    light.altitude_deg = sun.apparent_altitude().degrees();
}

DirectionalLight SunClock::on_grid(const ViewerLight& light) const
{
    return {.azimuth = wrapped_to_circle(Angle::from_degrees(light.azimuth_deg) + site_.map_to_grid_north),
            .altitude = Angle::from_degrees(light.altitude_deg),
            .angular_diameter = sun_size_};
}

LightCourse SunClock::course(const ViewerLight& light, std::size_t lights) const
{
    if (light.time && place_)
        return day_course(*light.time, lights);
    LightCourse circle = {.closed = true};
    for (std::size_t i = 0; i < lights; ++i) {
        ViewerLight turned = light;
        turned.azimuth_deg = 360.0 * static_cast<double>(i) / static_cast<double>(lights);
        circle.lights.push_back(on_grid(turned));
    }
    return circle;
}

LightCourse SunClock::day_course(const DateTime& time, std::size_t lights) const
{
    const auto local_day = std::chrono::floor<std::chrono::days>(time.utc + time.utc_offset);
    const SunDay day =
        sun_day(std::chrono::year_month_day(local_day), time.utc_offset, *place_, {.air = air_});
    const TimeSpan span = {day.sunrise.value_or(day.midnights.from), day.sunset.value_or(day.midnights.to)};
    LightCourse course;
    for (const UtcTime moment : evenly_spread(span, lights, Spread::ends)) {
        ViewerLight sun;
        sun.time = DateTime{moment, time.utc_offset};
        bring_up_to_date(sun);
        course.lights.push_back(on_grid(sun));
    }
    return course;
}

ViewerLight dragged(const ViewerLight& light, double right_px, double up_px, double picture_height_px)
{
    const double degrees_per_pixel = 90.0 / picture_height_px;
    ViewerLight result;
    result.azimuth_deg =
        wrapped_to_circle(Angle::from_degrees(light.azimuth_deg + 2.0 * degrees_per_pixel * right_px))
            .degrees();
    result.altitude_deg = std::clamp(light.altitude_deg + degrees_per_pixel * up_px, -5.0, 90.0);
    return result;
}

} // namespace duskline::viewer
