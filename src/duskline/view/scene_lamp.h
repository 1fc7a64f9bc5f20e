#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>

#include <array>
#include <cstddef>

namespace duskline {

/// A lamp or a searchlight in a picture: what it shines on, and how brightly.
///
///                 axis                 light on a surface = colour * (bright_m / d)^2 * cosine of incidence
///        * ------------------>          * (1 - (d / range_m)^4)^2     falls to nothing at the range
///       lamp \  half_angle              * the beam: 1 inside, 0 outside, smooth over `soft_edge` of it
///              \                        * what casters let through
///
/// Light is counted in suns: 1 is what a surface has that faces the sun. Frame and zero of positions are those of the
/// scene: a planet's, or a terrain's (view/camera.h).
struct SceneLamp {
    Vector3 position_m = {};
    Vector3 direction = {0.0, 0.0, -1.0}; ///< of the beam's axis, any length; of no meaning at 180 degrees
    Angle half_angle =
        Angle::from_degrees(180.0); ///< between axis and border of the beam, 0.5 to 180; 180 shines all round
    double soft_edge = 0.2; ///< share of the half angle, from its border inwards, where a beam fades; 0 to 1
    std::array<float, 3> colour = {1.0f, 1.0f, 1.0f}; ///< light: red, green, blue; 0 or above
    double bright_m = 100.0; ///< distance at which it is as bright as the sun; above 0
    double range_m = 5000.0; ///< farther away it lights nothing; 1 m to 10000 km

    bool operator==(const SceneLamp&) const;
};

/// So many lamps may shine at a time.
inline constexpr std::size_t kMostLamps = 8;

/// Whether it has a beam.
inline bool is_searchlight(const SceneLamp& lamp)
{
    return lamp.half_angle < Angle::from_degrees(180.0);
}

/// Throws InvalidInput, with the value, unless all is in its range and finite.
void require_valid(const SceneLamp& lamp);

/// Light at a distance on what faces it, in the middle of its beam with nothing in between: the formula above, in suns.
double light_at(const SceneLamp& lamp, double distance_m);

} // namespace duskline
