#include <duskline/geometry/invalid_input.h>
#include <duskline/light/point_light.h>

#include <cmath>
#include <string>

namespace duskline {

namespace {

void require_number(const char* what, const char* unit, double value)
{
    // The farthest place whose neighbours a double can still name.
    constexpr double farthest = 4503599627370496.0;
    if (!(std::abs(value) <= farthest))
        throw InvalidInput(std::string(what) + " of a point light must be a finite number of " + unit
                           + ", at most 2^52, got " + std::to_string(value));
}

} // namespace

void require_valid(const PointLight& light)
{
    require_number("the row", "cells", light.position.row);
    require_number("the column", "cells", light.position.column);
    require_number("the height", "metres", light.position.height_m);
}

} // namespace duskline
