#include <duskline/products/daylight.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace duskline {

namespace {

// Wavelengths that stand for the primaries of a screen, micrometres.
constexpr std::array<double, 3> kWavelengths = {0.610, 0.550, 0.465};
constexpr double kTurbidity = 0.05;
constexpr double kColourSeen = 0.26; // of the logarithm of what the air takes
constexpr double kWhiteAltitude = 45.0;
constexpr double kReddestAltitude = 2.0;

Colour of_luminance_1(Colour c)
{
    return c * (1.0f / luminance(c));
}

// The air that sunlight passes through, 1 from straight overhead.
double air_mass(double altitude_degrees)
{
    const double sine = sine_cosine(Angle::from_degrees(altitude_degrees)).sine;
    return 1.0 / (sine + 0.50572 * std::pow(altitude_degrees + 6.07995, -1.6364));
}

double optical_depth(double wavelength)
{
    const double w2 = 1.0 / (wavelength * wavelength);
    const double rayleigh = 0.008569 * w2 * w2 * (1.0 + 0.0113 * w2 + 0.00013 * w2 * w2);
    return rayleigh + kTurbidity * std::pow(wavelength, -1.3);
}

// Sunlight at that altitude over sunlight at the white altitude.
Colour reddening(Angle altitude)
{
    const double degrees = std::max(kReddestAltitude, altitude.degrees());
    const double more_air = air_mass(degrees) - air_mass(kWhiteAltitude);
    const auto channel = [&](std::size_t i) {
        return static_cast<float>(std::exp(-kColourSeen * more_air * optical_depth(kWavelengths[i])));
    };
    return {channel(0), channel(1), channel(2)};
}

} // namespace

Daylight clear_daylight(Angle sun_altitude, double ambient)
{
    const auto share = static_cast<float>(ambient);
    const Colour white = {1.0f, 1.0f, 1.0f};
    const Colour sky = of_luminance_1({0.72f, 0.975f, 1.44f});
    const Colour sun_of_white = (white - sky * share) * (1.0f / (1.0f - share));
    const Colour positive = {std::max(0.0f, sun_of_white.red), std::max(0.0f, sun_of_white.green),
                             std::max(0.0f, sun_of_white.blue)};
    return {of_luminance_1(positive * reddening(sun_altitude)), sky};
}

} // namespace duskline
