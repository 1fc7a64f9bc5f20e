#include <duskline/view/frustum.h>

#include <algorithm>

namespace duskline {

namespace {

double beyond(double value, double low, double high)
{
    return std::max({0.0, low - value, value - high});
}

} // namespace

double distance_m(const Vector3& place_m, const Box& box)
{
    return length({beyond(place_m.x, box.low.x, box.high.x), beyond(place_m.y, box.low.y, box.high.y),
                   beyond(place_m.z, box.low.z, box.high.z)});
}

Vector3 farthest_corner(const Box& box, const Vector3& direction)
{
    return {direction.x > 0.0 ? box.high.x : box.low.x, direction.y > 0.0 ? box.high.y : box.low.y,
            direction.z > 0.0 ? box.high.z : box.low.z};
}

Frustum::Frustum(const Camera& camera, double aspect, double nearest_m) : eye_m_(camera.position_m)
{
    const auto [forward, right, up] = axes_of(camera);
    const double half_height = tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    const double half_width = half_height * aspect;
    planes_ = {Plane{forward, nearest_m}, Plane{forward * half_width + right, 0.0},
               Plane{forward * half_width - right, 0.0}, Plane{forward * half_height + up, 0.0},
               Plane{forward * half_height - up, 0.0}};
}

bool Frustum::may_see(const Box& box) const
{
    return std::ranges::all_of(planes_, [&](const Plane& plane) {
        return dot(plane.inwards, farthest_corner(box, plane.inwards) - eye_m_) >= plane.offset_m;
    });
}

} // namespace duskline
