// The line from one point to the other is a ray of parallel light along it that ends at the other point: in the plane of the
// centre and both points it keeps its distance rho from the axis through the centre along the line.
//
//            from o---------->o to
//               / |          / \              rho    distance of the line from the centre
//              /  | rho    /    \             theta  angle at the centre from the line's direction: falls from `from` to `to`
//             |   +- - - -+- - - - - -> axis
//              \ centre       /

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/ground_march.h>
#include <duskline/planet/planet_sight.h>

#include <cmath>
#include <string>
#include <utility>

namespace duskline {

namespace {

// Lines that pass the centre nearer than this share of a point's distance from it go straight up, down or through it.
constexpr double kThroughCentre = 1e-14;

void require_outside_centre(const Vector3& point_m)
{
    const double radius_m = length(point_m);
    if (!(radius_m > 0.0 && std::isfinite(radius_m)))
        throw InvalidInput("a point about a planet must be finite and not its centre, got ("
                           + std::to_string(point_m.x) + ", " + std::to_string(point_m.y) + ", "
                           + std::to_string(point_m.z) + ")");
}

} // namespace

PlanetSight::PlanetSight(PlanetLevel ground) : ground_(std::move(ground))
{
    require_valid(ground_);
}

bool PlanetSight::sees(const Vector3& from_m, const Vector3& to_m) const
{
    require_outside_centre(from_m);
    require_outside_centre(to_m);
    const Vector3 way_m = to_m - from_m;
    if (!(length(way_m) > 0.0))
        return true;
    const Vector3 towards = normalized(way_m);
    // Twice, because once loses digits where the line is steep.
    Vector3 away_m = from_m - towards * dot(from_m, towards);
    away_m = away_m - towards * dot(away_m, towards);
    const double rho_m = length(away_m);
    if (rho_m <= kThroughCentre * length(from_m))
        return dot(from_m, to_m) > 0.0;
    GroundMarch march(ground_, {towards, away_m * (1.0 / rho_m)}, rho_m, true);
    const double from_theta = std::atan2(rho_m, dot(from_m, towards));
    const double to_theta = std::atan2(rho_m, dot(to_m, towards));
    return !(march.greatest_rho_m(from_theta, to_theta) > rho_m);
}

} // namespace duskline
