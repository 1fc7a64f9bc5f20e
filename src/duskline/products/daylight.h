#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/products/colour.h>

namespace duskline {

/// The colours of sunlight and of the light of the sky, each of luminance 1.
struct Daylight {
    Colour sun = {1.0f, 1.0f, 1.0f};
    Colour sky = {1.0f, 1.0f, 1.0f};
};

/// Daylight under a clear sky, as eyes and cameras see it: white is level ground that gets `ambient` (0 to
/// below 1) of its light from a blue sky and the rest from a sun 45 degrees high; then the sun alone is
/// slightly warm. Lower, it reddens: by Rayleigh scattering (Hansen and Travis, Light scattering in planetary
/// atmospheres, 1974) and haze (Angstrom 1929, turbidity 0.05) along the path of Kasten and Young (Revised
/// optical air mass tables and approximation formula, 1989), of which the eye takes a quarter for colour and
/// the rest for white. Below 2 degrees it reddens no more.
Daylight clear_daylight(Angle sun_altitude, double ambient);

} // namespace duskline
