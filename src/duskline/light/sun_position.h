#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/light/date_time.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/place.h>

#include <optional>

namespace duskline {

/// The air that lifts the sun near the horizon.
struct Air {
    double pressure_mbar = 1010.0; ///< at the place itself, not reduced to sea level; 0 to 1200
    double temperature_c = 10.0;   ///< -100 to 100
};

struct SunOptions {
    std::optional<Air> air = Air{}; ///< none: no refraction
    std::optional<double> delta_t_s =
        {}; ///< TT - UT; else from leap seconds, before 1972 from Espenak and Meeus
};

/// Where the sun's centre is seen from a place.
struct SunPosition {
    Angle azimuth;            ///< clockwise from true north, [0, 360) degrees
    Angle geometric_altitude; ///< above the horizontal, as if there were no air; parallax included
    Angle refraction;         ///< how much the air lifts it; 0 below -0.8333 degrees and without air
    Angle angular_diameter;   ///< of the disc at that moment, 0.524 to 0.542 degrees
    double distance_au = 1.0; ///< from the place to the sun's centre

    Angle apparent_altitude() const { return geometric_altitude + refraction; }
};

/// The sun's position from the IAU models of ERFA: VSOP2000-based ephemeris of the earth (Epv00), precession
/// IAU 2006 and nutation 2000B, light time, aberration, and the place on the WGS 84 ellipsoid (parallax). UT1 is
/// taken as UTC, as the NREL SPA does: at most 0.9 s, or 0.004 degrees of the earth's turning. Otherwise right
/// to about 0.0003 degrees from 1900 to 2100 and 0.003 degrees in the years taken, 1600 to 2400; at the poles
/// the azimuth counts from the meridian of the place's longitude. About 40 microseconds.
///
/// Throws InvalidInput on years outside 1600 to 2400, latitudes beyond 90 degrees, and what is not finite.
SunPosition sun_position(UtcTime time, const Place& place, const SunOptions& options = {});

/// The direction from the earth's centre to the sun, unit length, in the frame that turns with the earth: x to longitude 0,
/// z to the north pole. The same models; for light on the whole globe, whose places see the sun up to 0.0025 degrees aside
/// (parallax). Throws InvalidInput on years outside 1600 to 2400.
Vector3 sun_direction(UtcTime time, const SunOptions& options = {});

/// How much air lifts a light seen at that altitude above the horizontal without it. The formula of Bennett and
/// Saemundsson as in the NREL SPA (Reda and Andreas, TP-560-34302, 2008, equation 42), for the whole sun: 0 when
/// its upper limb stays below the horizon even so, at altitudes below -0.8333 degrees.
Angle refraction(Angle geometric_altitude, const Air& air);

/// The sun as a light for a terrain whose columns do not run to true north. `true_to_grid_north` is added to
/// the sun's azimuth: minus the meridian convergence, the angle from true north clockwise to the grid's.
DirectionalLight sunlight(const SunPosition& sun, Angle true_to_grid_north = {});

/// Apparent minus mean solar time, minutes: what a sundial is ahead of a clock.
double equation_of_time_min(UtcTime time, const SunOptions& options = {});

/// TT - UT in seconds: 32.184 and the leap seconds from 1972 to 2035, else the polynomials of Espenak and Meeus
/// (Five Millennium Canon of Solar Eclipses, NASA/TP-2006-214141). Years 1600 to 2400.
double delta_t_s(UtcTime time);

/// The polynomials of Espenak and Meeus alone, for a year with its fraction (1985.125 is mid-February).
double delta_t_of_espenak_and_meeus_s(double year);

} // namespace duskline
