#pragma once

#include <duskline/geometry/angle.h>

namespace duskline {

/// A place on the earth.
///
///   longitude   east of Greenwich, -180 to 360 degrees
///   latitude    geodetic (WGS 84), north of the equator, -90 to 90 degrees
///   height_m    above the ellipsoid, metres; a few kilometres change nothing that matters to shadows
struct Place {
    Angle longitude;
    Angle latitude;
    double height_m = 0.0;
};

} // namespace duskline
