#include "sun_clock.h"

#include <duskline/geometry/invalid_input.h>

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
