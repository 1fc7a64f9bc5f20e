#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>

namespace duskline {

/// How the sun moves from one frame to the next, and where it is going to be. All directions are unit vectors.
class SunMotion {
public:
    explicit SunMotion(const Vector3& to_sun) : now_(to_sun) {}

    /// Where it is in the next frame.
    void follow(const Vector3& to_sun);

    /// Whether it has not moved in the last frame.
    bool stands() const;

    /// Whether it goes on in the direction in which it has gone before, however fast.
    bool is_steady() const;

    /// Where it is after so many frames more, if it moves steadily; else where it is. At most kFarthestAhead from there.
    Vector3 ahead(double frames) const;

    static constexpr Angle kFarthestAhead = Angle::from_degrees(5.0);

private:
    Vector3 now_;
    Vector3 turn_ = {}; ///< of the last frame: an axis as long as the angle, radians
    Vector3 turn_before_ = {};
    Vector3 usual_turn_ = {}; ///< of the frames since it has moved steadily
};

} // namespace duskline
