#include <duskline/geometry/invalid_input.h>
#include <duskline/view/scene_lamp.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {

namespace {

constexpr double kLeastRange_m = 1.0;
constexpr double kMostRange_m = 1e7;

bool is_finite(const Vector3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string text(const Vector3& v)
{
    return std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z);
}

std::array<double, 3> parts(const Vector3& v)
{
    return {v.x, v.y, v.z};
}

void require_place(const SceneLamp& lamp)
{
    if (!is_finite(lamp.position_m))
        throw InvalidInput("a lamp's place must be finite numbers of metres, got " + text(lamp.position_m));
    if (is_searchlight(lamp) && (!is_finite(lamp.direction) || !(length(lamp.direction) > 0.0)))
        throw InvalidInput("a searchlight must shine in some direction, got " + text(lamp.direction));
}

void require_beam(const SceneLamp& lamp)
{
    if (!(lamp.half_angle.degrees() >= 0.5 && lamp.half_angle.degrees() <= 180.0))
        throw InvalidInput("a lamp's half angle must be 0.5 to 180 degrees, got "
                           + std::to_string(lamp.half_angle.degrees()));
    if (!(lamp.soft_edge >= 0.0 && lamp.soft_edge <= 1.0))
        throw InvalidInput("the soft edge of a lamp's beam must be 0 to 1 of its half angle, got "
                           + std::to_string(lamp.soft_edge));
}

void require_strength(const SceneLamp& lamp)
{
    for (const float part : lamp.colour)
        if (!(part >= 0.0f && std::isfinite(part)))
            throw InvalidInput("a lamp's colour must be finite numbers of 0 or more, got "
                               + std::to_string(part));
    if (!(lamp.bright_m > 0.0 && lamp.bright_m <= kMostRange_m))
        throw InvalidInput("a lamp must be as bright as the sun from above 0 to 10000000 m, got "
                           + std::to_string(lamp.bright_m));
    if (!(lamp.range_m >= kLeastRange_m && lamp.range_m <= kMostRange_m))
        throw InvalidInput("a lamp's range must be 1 to 10000000 m, got " + std::to_string(lamp.range_m));
}

} // namespace

bool SceneLamp::operator==(const SceneLamp& other) const
{
    return parts(position_m) == parts(other.position_m) && parts(direction) == parts(other.direction)
           && half_angle == other.half_angle && soft_edge == other.soft_edge && colour == other.colour
           && bright_m == other.bright_m && range_m == other.range_m;
}

void require_valid(const SceneLamp& lamp)
{
    require_place(lamp);
    require_beam(lamp);
    require_strength(lamp);
}

// Inverse square, and a window that ends it: B. Karis, Real shading in Unreal Engine 4, 2013.
double light_at(const SceneLamp& lamp, double distance_m)
{
    const double of_range = distance_m / lamp.range_m;
    const double window = std::max(0.0, 1.0 - of_range * of_range * of_range * of_range);
    const double of_bright = lamp.bright_m / distance_m;
    return of_bright * of_bright * window * window;
}

} // namespace duskline
