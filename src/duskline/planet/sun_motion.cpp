#include <duskline/geometry/cross_product.h>
#include <duskline/planet/sun_motion.h>

#include <algorithm>
#include <cmath>

namespace duskline {

namespace {

// Two frames go the same way when their turns are less than 25 degrees apart.
constexpr double kSameWay = 0.9;

// Frames take different times: what the last one counts among those before.
constexpr double kShareOfLast = 0.25;

Vector3 turn_between(const Vector3& from, const Vector3& to)
{
    const Vector3 axis = cross(from, to);
    const double sine = length(axis);
    return sine > 0.0 ? axis * (std::atan2(sine, dot(from, to)) / sine) : Vector3{};
}

} // namespace

void SunMotion::follow(const Vector3& to_sun)
{
    turn_before_ = turn_;
    turn_ = turn_between(now_, to_sun);
    now_ = to_sun;
    usual_turn_ = is_steady() ? usual_turn_ * (1.0 - kShareOfLast) + turn_ * kShareOfLast : turn_;
}

bool SunMotion::stands() const
{
    return length(turn_) == 0.0;
}

bool SunMotion::is_steady() const
{
    const double both = length(turn_) * length(turn_before_);
    return both > 0.0 && dot(turn_, turn_before_) >= kSameWay * both;
}

Vector3 SunMotion::ahead(double frames) const
{
    const double radians = length(usual_turn_);
    if (!is_steady() || radians == 0.0)
        return now_;
    const double angle = std::min(frames * radians, kFarthestAhead.radians());
    const Vector3 axis = usual_turn_ * (1.0 / radians);
    return normalized(now_ * std::cos(angle) + cross(axis, now_) * std::sin(angle)
                      + axis * (dot(axis, now_) * (1.0 - std::cos(angle))));
}

} // namespace duskline
