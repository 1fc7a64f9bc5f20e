#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/view/camera.h>

#include <array>

namespace duskline {

/// A box with sides along the axes, metres.
struct Box {
    Vector3 low;
    Vector3 high;
};

/// How far a place lies from the nearest point of a box; 0 inside. Metres.
double distance_m(const Vector3& place_m, const Box& box);

/// The corner of a box that lies farthest in a direction.
Vector3 farthest_corner(const Box& box, const Vector3& direction);

/// What a camera sees, however far away: the space between four planes through the eye and one close before it.
class Frustum {
public:
    Frustum(const Camera& camera, double aspect, double nearest_m);

    /// False only for boxes of which nothing is seen; true for some that lie just beside.
    bool may_see(const Box& box) const;

private:
    struct Plane {
        Vector3 inwards;
        double offset_m = 0.0; ///< inside: inwards . (place - eye) >= offset
    };

    Vector3 eye_m_;
    std::array<Plane, 5> planes_;
};

} // namespace duskline
