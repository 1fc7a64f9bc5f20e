#pragma once

#include <duskline/light/directional_light.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// The way a light goes, as lights along it: a day's suns, or a circle of the compass.
struct LightCourse {
    std::vector<DirectionalLight> lights = {};
    bool closed = false; ///< from the last one on to the first
};

/// Between which two lights of a course another one stands, and how far it is on the way from one to the other.
struct PlaceOnCourse {
    std::size_t before = 0;
    std::size_t after = 0; ///< `before` itself where that is the place
    double share = 0.0;    ///< 0 at `before`, to below 1
};

/// The place on a course that is nearest to a light, which need not lie on it; of two as near the first. Courses are
/// straight between their lights. Throws InvalidInput for a course without lights. Cost: O(lights).
PlaceOnCourse nearest_place(const LightCourse& course, const DirectionalLight& light);

} // namespace duskline
