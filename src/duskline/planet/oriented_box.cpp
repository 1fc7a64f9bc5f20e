#include <duskline/planet/oriented_box.h>

#include <algorithm>
#include <cmath>

namespace duskline {

double distance_m(const Vector3& point_m, const OrientedBox& box)
{
    const Vector3 from_centre = point_m - box.centre_m;
    const auto beyond = [&](std::size_t i) {
        return std::max(0.0, std::abs(dot(from_centre, box.axes.at(i))) - box.half_m.at(i));
    };
    return length({beyond(0), beyond(1), beyond(2)});
}

double reach_m(const OrientedBox& box, const Vector3& direction)
{
    double reach_m = 0.0;
    for (std::size_t i = 0; i < box.axes.size(); ++i)
        reach_m += std::abs(dot(direction, box.axes.at(i))) * box.half_m.at(i);
    return reach_m;
}

} // namespace duskline
