// Where the sun is, by ERFA, the freely licensed copy of the IAU's Standards of Fundamental Astronomy.
//
//   earth around the sun (Epv00)  ->  direction to the sun, aberrated (Ab)  ->  turned into the earth's own
//   frame at that moment (C2t00b)  ->  seen from the place instead of the earth's centre  ->  east, north, up

#include <duskline/geometry/invalid_input.h>
#include <duskline/light/sun_position.h>

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

namespace duskline {
namespace {

// The semidiameter of the sun at one astronomical unit (Auwers, the value of almanacs).
constexpr Angle kSemidiameterAt1Au = Angle::from_degrees(959.63 / 3600.0);

constexpr double kEarthTurn_rad_per_s = 7.292115e-5;
constexpr double kLightSpeed_m_per_s = ERFA_CMPS;
constexpr double kSunsetLimit_deg = -0.8333; // upper limb on the horizon: 0.5667 refraction, 0.2667 radius

// One moment in the two time scales that matter, each as a Julian date in two parts.
struct Epoch {
    double day = 2440587.5; // of 1 January 1970
    double ut = 0.0;
    double tt = 0.0;
};

double days_since_1970(UtcTime time)
{
    return std::chrono::duration<double, std::chrono::days::period>(time.time_since_epoch()).count();
}

int year_of(UtcTime time)
{
    return static_cast<int>(CalendarDate(std::chrono::floor<std::chrono::days>(time)).year());
}

void require_covered(UtcTime time)
{
    const int year = year_of(time);
    if (year < 1600 || year > 2400)
        throw InvalidInput("the sun's position is known for the years 1600 to 2400, got "
                           + std::to_string(year));
}

Epoch epoch(UtcTime time, const SunOptions& options)
{
    require_covered(time);
    const double delta_t = options.delta_t_s.value_or(delta_t_s(time));
    if (!std::isfinite(delta_t))
        throw InvalidInput("delta T must be a finite number of seconds, got " + std::to_string(delta_t));
    Epoch epoch;
    epoch.ut = days_since_1970(time);
    epoch.tt = epoch.ut + delta_t / ERFA_DAYSEC;
    return epoch;
}

// From the earth's centre to the sun as it is seen, astronomical units, in the frame that turns with the earth
// (ITRS: x to the meridian of Greenwich, z to the north pole). Polar motion, under 0.5", is left out.
Vector3 sun_from_earth_au(const Epoch& epoch)
{
    double heliocentric[2][3];
    double barycentric[2][3];
    eraEpv00(epoch.day, epoch.tt, heliocentric, barycentric);

    // The sun hardly moves while its light is on the way, so where it is now is where it is seen but for
    // aberration.
    double towards_sun[3];
    double distance_au = 0.0;
    eraPn(heliocentric[0], &distance_au, towards_sun);
    eraSxp(-1.0, towards_sun, towards_sun);

    double velocity_in_c[3];
    eraSxp(ERFA_DAU / ERFA_DAYSEC / kLightSpeed_m_per_s, barycentric[1], velocity_in_c);
    const double lorentz_inverse = std::sqrt(1.0 - eraPdp(velocity_in_c, velocity_in_c));
    double apparent[3];
    eraAb(towards_sun, velocity_in_c, distance_au, lorentz_inverse, apparent);

    double celestial_to_earth[3][3];
    eraC2t00b(epoch.day, epoch.tt, epoch.day, epoch.ut, 0.0, 0.0, celestial_to_earth);
    double turned[3];
    eraRxp(celestial_to_earth, apparent, turned);
    return Vector3{turned[0], turned[1], turned[2]} * distance_au;
}

void require_valid(const Place& place)
{
    const double latitude = place.latitude.degrees();
    if (!(latitude >= -90.0 && latitude <= 90.0))
        throw InvalidInput("latitude must be from -90 to 90 degrees, got " + std::to_string(latitude));
    const double longitude = place.longitude.degrees();
    if (!(longitude >= -360.0 && longitude <= 360.0))
        throw InvalidInput("longitude must be from -180 to 360 degrees, got " + std::to_string(longitude));
    if (!(std::abs(place.height_m) <= 1.0e6))
        throw InvalidInput("height of a place must be from -1000000 to 1000000 metres, got "
                           + std::to_string(place.height_m));
}

void require_valid(const Air& air)
{
    if (!(air.pressure_mbar >= 0.0 && air.pressure_mbar <= 1200.0))
        throw InvalidInput("pressure must be from 0 to 1200 mbar, got " + std::to_string(air.pressure_mbar));
    if (!(air.temperature_c >= -100.0 && air.temperature_c <= 100.0))
        throw InvalidInput("temperature must be from -100 to 100 degrees Celsius, got "
                           + std::to_string(air.temperature_c));
}

Vector3 position_m(const Place& place)
{
    double xyz[3];
    eraGd2gc(ERFA_WGS84, place.longitude.radians(), place.latitude.radians(), place.height_m, xyz);
    return {xyz[0], xyz[1], xyz[2]};
}

// The sun as seen from a place that is carried round by the earth: parallax, and the aberration of its speed.
Vector3 sun_from_place_au(Vector3 from_earth_au, Vector3 place_m)
{
    const Vector3 from_place_au = from_earth_au - place_m * (1.0 / ERFA_DAU);
    const Vector3 velocity_in_c =
        Vector3{-place_m.y, place_m.x, 0.0} * (kEarthTurn_rad_per_s / kLightSpeed_m_per_s);
    return from_place_au + velocity_in_c * length(from_place_au);
}

struct EastNorthUp {
    double east;
    double north;
    double up;
};

EastNorthUp on_the_horizon(Vector3 v, const Place& place)
{
    const auto [sin_lon, cos_lon] = sine_cosine(place.longitude);
    const auto [sin_lat, cos_lat] = sine_cosine(place.latitude);
    const double outwards = cos_lon * v.x + sin_lon * v.y;
    return {.east = cos_lon * v.y - sin_lon * v.x,
            .north = cos_lat * v.z - sin_lat * outwards,
            .up = cos_lat * outwards + sin_lat * v.z};
}

struct Polynomial {
    double until_year = 0.0;
    double origin = 0.0;
    std::array<double, 8> coefficients = {}; // of rising powers of (year - origin) / unit
    double unit = 1.0;
};

double value_at(const Polynomial& polynomial, double year)
{
    const double t = (year - polynomial.origin) / polynomial.unit;
    double sum = 0.0;
    for (std::size_t i = polynomial.coefficients.size(); i-- > 0;)
        sum = sum * t + polynomial.coefficients.at(i);
    return sum;
}

constexpr Polynomial kDeltaT[] = {
    {1700, 1600, {120.0, -0.9808, -0.01532, 1.0 / 7129.0}},
    {1800, 1700, {8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000.0}},
    {1860,
     1800,
     {13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699, 0.000000000875}},
    {1900, 1860, {7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174.0}},
    {1920, 1900, {-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197}},
    {1941, 1920, {21.20, 0.84493, -0.076100, 0.0020936}},
    {1961, 1950, {29.07, 0.407, -1.0 / 233.0, 1.0 / 2547.0}},
    {1986, 1975, {45.45, 1.067, -1.0 / 260.0, -1.0 / 718.0}},
    {2005, 2000, {63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599}},
    {2050, 2000, {62.92, 0.32217, 0.005589}},
    // -20 + 32 u^2 - 0.5628 (2150 - year), u = (year - 1820) / 100 centuries
    {2150, 1820, {-20.0 - 0.5628 * 330.0, 56.28, 32.0}, 100.0},
    {HUGE_VAL, 1820, {-20.0, 0.0, 32.0}, 100.0},
};

} // namespace

SunPosition sun_position(UtcTime time, const Place& place, const SunOptions& options)
{
    require_valid(place);
    const Vector3 sun_au = sun_from_place_au(sun_from_earth_au(epoch(time, options)), position_m(place));
    const auto [east, north, up] = on_the_horizon(sun_au, place);

    SunPosition sun;
    sun.azimuth = wrapped_to_circle(Angle::from_radians(std::atan2(east, north)));
    sun.geometric_altitude = Angle::from_radians(std::atan2(up, std::hypot(east, north)));
    if (options.air)
        sun.refraction = refraction(sun.geometric_altitude, *options.air);
    sun.distance_au = length(sun_au);
    sun.angular_diameter =
        Angle::from_radians(2.0 * std::asin(std::sin(kSemidiameterAt1Au.radians()) / sun.distance_au));
    return sun;
}

Vector3 sun_direction(UtcTime time, const SunOptions& options)
{
    return normalized(sun_from_earth_au(epoch(time, options)));
}

Angle refraction(Angle geometric_altitude, const Air& air)
{
    require_valid(air);
    const double e0 = geometric_altitude.degrees();
    if (!(e0 >= kSunsetLimit_deg))
        return {};
    const Angle lifted = Angle::from_degrees(e0 + 10.3 / (e0 + 5.11));
    const double density = air.pressure_mbar / 1010.0 * 283.0 / (273.0 + air.temperature_c);
    return Angle::from_degrees(density * 1.02 / (60.0 * tangent(lifted)));
}

DirectionalLight sunlight(const SunPosition& sun, Angle true_to_grid_north)
{
    DirectionalLight light;
    light.azimuth = wrapped_to_circle(sun.azimuth + true_to_grid_north);
    light.altitude = std::min(sun.apparent_altitude(), Angle::from_degrees(90.0));
    light.angular_diameter = sun.angular_diameter;
    return light;
}

double equation_of_time_min(UtcTime time, const SunOptions& options)
{
    const Vector3 sun = sun_from_earth_au(epoch(time, options));
    const double subsolar_longitude_deg = Angle::from_radians(std::atan2(sun.y, sun.x)).degrees();
    const double day = days_since_1970(time);
    const double since_mean_noon_deg = (day - std::floor(day) - 0.5) * 360.0;
    constexpr double minutes_per_degree = 4.0;
    return std::remainder(-subsolar_longitude_deg - since_mean_noon_deg, 360.0) * minutes_per_degree;
}

double delta_t_of_espenak_and_meeus_s(double year)
{
    return value_at(*std::ranges::find_if(kDeltaT, [year](const auto& p) { return year < p.until_year; }),
                    year);
}

double delta_t_s(UtcTime time)
{
    require_covered(time);
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const CalendarDate date(day);
    const int year = static_cast<int>(date.year());
    if (year < 1972 || year > 2035) {
        const auto month = static_cast<unsigned>(date.month());
        return delta_t_of_espenak_and_meeus_s(year + (month - 0.5) / 12.0);
    }
    double tai_minus_utc_s = 0.0;
    eraDat(year, static_cast<int>(static_cast<unsigned>(date.month())),
           static_cast<int>(static_cast<unsigned>(date.day())), 0.0, &tai_minus_utc_s);
    return ERFA_TTMTAI + tai_minus_utc_s;
}

} // namespace duskline
