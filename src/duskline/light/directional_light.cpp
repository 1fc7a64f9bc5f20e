#include <duskline/geometry/invalid_input.h>
#include <duskline/light/directional_light.h>

#include <cmath>
#include <string>

namespace duskline {

void require_valid(const DirectionalLight& light)
{
    if (!std::isfinite(light.azimuth.degrees()))
        throw InvalidInput("azimuth must be a finite number of degrees, got "
                           + std::to_string(light.azimuth.degrees()));
    const double altitude = light.altitude.degrees();
    if (!(altitude >= -90.0 && altitude <= 90.0))
        throw InvalidInput("altitude must be from -90 to 90 degrees, got " + std::to_string(altitude));
    const double diameter = light.angular_diameter.degrees();
    if (!(diameter >= 0.0 && diameter <= 180.0))
        throw InvalidInput("angular diameter must be from 0 to 180 degrees, got " + std::to_string(diameter));
}

Vector3 direction_towards(const DirectionalLight& light)
{
    const auto [sin_azimuth, cos_azimuth] = sine_cosine(light.azimuth);
    const auto [sin_altitude, cos_altitude] = sine_cosine(light.altitude);
    return {sin_azimuth * cos_altitude, cos_azimuth * cos_altitude, sin_altitude};
}

} // namespace duskline
