// In the half-plane of a ray (a fixed turn about its axis) the ground is a curve rho(theta), and the ray's beginning is in
// shadow when that curve is anywhere ahead of it as far from the axis:
//
//       rho ^          __
//           |        _/  \__     .......... p      the ray goes left, towards the light, and keeps its rho
//           |     _./  .     \__/
//           |  _./     |
//           +-'--------+---------+----------> theta
//           0 sun      |         90 terminator     nothing to the left of | reaches rho(p): (radius + highest) sin theta
//                                                  only falls from there on
//
// The light of a lamp ends at the lamp's own theta, that of the sun at 0. On a face of the cube the half-plane is a straight
// line in (u, v), so crossings with rows and columns are counted, not searched. Between two samples the straight line in
// space has 1 / depth linear in u or v, where depth is the coordinate along the face's axis: |(1, u, v)| / depth is the
// radius' inverse.

#include <duskline/planet/ground_march.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace duskline {

namespace {

constexpr double kPi = std::numbers::pi;

// Crossings nearer than this to an end are the end itself, in samples.
constexpr double kOwnGround = 1e-6;

} // namespace

GroundMarch::GroundMarch(const PlanetLevel& ground, const RayPlane& plane, double known_rho_m,
                         bool stop_at_first)
    : ground_(ground), plane_(plane), samples_(std::int64_t{kTileSquares} << ground.level),
      step_(2.0 / static_cast<double>(samples_)), section_(ground.globe, plane.towards, plane.outward),
      falls_below_(std::min(section_.widest_theta(), kPi / 2.0)), rho_m_(known_rho_m),
      stop_at_first_(stop_at_first)
{}

double GroundMarch::greatest_rho_m(double from_theta, double to_theta)
{
    end_ = to_theta;
    start_ = end_ > 0.0 ? from_theta : first_theta_that_counts(from_theta);
    struct OnFace {
        std::uint32_t face;
        ThetaRange thetas;
    };
    std::array<OnFace, kCubeFaces> faces = {};
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        faces.at(face) = {face, thetas_on(face)};
    std::sort(faces.begin(), faces.end(),
              [](const OnFace& a, const OnFace& b) { return a.thetas.high > b.thetas.high; });
    for (const OnFace& part : faces)
        if (part.thetas.low < part.thetas.high && !ended_)
            walk_over(part.face, part.thetas);
    return rho_m_;
}

// Towards the sun, far beyond the terminator, the ground is nearer to the axis than the ground at the terminator, however high it is.
double GroundMarch::first_theta_that_counts(double theta) const
{
    const double widest = std::max(section_.widest_theta(), kPi / 2.0);
    if (theta <= widest)
        return theta;
    const double spacing = spacing_m(ground_.globe, ground_.level);
    const double sag_m = spacing * spacing / (2.0 * ground_.globe.polar_radius_m);
    const double sure_m =
        section_.greatest_rho_m() - sag_m - std::abs(static_cast<double>(ground_.range.lowest_m));
    if (reach_m(theta) >= sure_m)
        return theta;
    double near = widest;
    double far = theta;
    for (int i = 0; i < 50; ++i) {
        const double middle = (near + far) / 2.0;
        (reach_m(middle) >= sure_m ? near : far) = middle;
    }
    return far;
}

// How far from the axis ground can be at all.
double GroundMarch::reach_m(double theta) const
{
    return (section_.radius_m(theta) + static_cast<double>(ground_.range.highest_m)) * std::sin(theta);
}

GroundMarch::ThetaRange GroundMarch::thetas_on(std::uint32_t face) const
{
    const CubeFaceAxes axes = axes_of_face(face);
    ThetaRange range = {end_, start_};
    for (const Vector3& side :
         {axes.axis + axes.right, axes.axis - axes.right, axes.axis + axes.up, axes.axis - axes.up}) {
        const ThetaRange inside = not_below_zero(dot(plane_.towards, side), dot(plane_.outward, side));
        range = {std::max(range.low, inside.low), std::min(range.high, inside.high)};
    }
    return range;
}

void GroundMarch::walk_over(std::uint32_t face, ThetaRange thetas)
{
    for (const LinesAlong lines : {LinesAlong::u, LinesAlong::v})
        cross_lines(face, lines, thetas);
    ended_ = ended_ || (thetas.low < falls_below_ && reach_m(thetas.low) <= rho_m_);
}

void GroundMarch::cross_lines(std::uint32_t face, LinesAlong lines, ThetaRange thetas)
{
    const FaceVector towards = on_face(plane_.towards, face, lines);
    const FaceVector outward = on_face(plane_.outward, face, lines);
    const BeamLine beam(towards, outward);
    const auto line_at = [&](double theta) {
        const double ahead = std::cos(theta) * towards.ahead + std::sin(theta) * outward.ahead;
        const double y = std::cos(theta) * towards.y + std::sin(theta) * outward.y;
        return (y / ahead + 1.0) / step_;
    };
    const double from = line_at(thetas.high);
    const double to = line_at(thetas.low);
    // The line under an end is its own, on both faces if it is on an edge; other lines on edges belong to both.
    const bool at_start = start_ - thetas.high < kOwnGround * step_;
    const bool at_end = end_ > 0.0 && thetas.low - end_ < kOwnGround * step_;
    const double leave = at_start ? kOwnGround : -kOwnGround;
    const double reach = at_end ? -kOwnGround : kOwnGround;
    if (std::abs(to - from) <= kOwnGround) // along the lines
        return;
    if (to > from)
        for (auto line = index_above(from + leave); line <= index_below(to + reach); ++line) {
            if (!cross(face, lines, beam, line))
                return;
        }
    else
        for (auto line = index_below(from - leave); line >= index_above(to - reach); --line)
            if (!cross(face, lines, beam, line))
                return;
}

std::int64_t GroundMarch::index_above(double line) const
{
    return static_cast<std::int64_t>(std::ceil(std::max(line, 0.0)));
}
std::int64_t GroundMarch::index_below(double line) const
{
    return static_cast<std::int64_t>(std::floor(std::min(line, static_cast<double>(samples_))));
}

// False when no more crossings of these lines can count.
bool GroundMarch::cross(std::uint32_t face, LinesAlong lines, const BeamLine& beam, std::int64_t line)
{
    const double y = static_cast<double>(line) * step_ - 1.0;
    const double at = std::clamp((beam.x_at(y) + 1.0) / step_, 0.0, static_cast<double>(samples_));
    const auto left = std::min(static_cast<std::int64_t>(at), samples_ - 1);
    const double share = at - static_cast<double>(left);
    const double x = at * step_ - 1.0;
    const double inverse_depth = (1.0 - share) * inverse_depth_at(face, lines, line, left)
                                 + share * inverse_depth_at(face, lines, line, left + 1);
    const double part = beam.axis_part(x, y);
    if (part / inverse_depth > rho_m_) {
        rho_m_ = part / inverse_depth;
        if (stop_at_first_) {
            ended_ = true;
            return false;
        }
    }
    const FaceVector towards = on_face(plane_.towards, face, lines);
    const double theta = std::atan2(part, towards.ahead + towards.x * x + towards.y * y);
    return !(theta < falls_below_ && reach_m(theta) <= rho_m_);
}

double GroundMarch::inverse_depth_at(std::uint32_t face, LinesAlong lines, std::int64_t line,
                                     std::int64_t cell)
{
    const std::int64_t row = lines == LinesAlong::u ? line : cell;
    const std::int64_t column = lines == LinesAlong::u ? cell : line;
    const std::int64_t last = (std::int64_t{1} << ground_.level) - 1;
    const std::int64_t tile_row = std::min(row / kTileSquares, last);
    const std::int64_t tile_column = std::min(column / kTileSquares, last);
    const PlanetTile tile = {face, ground_.level, static_cast<std::uint32_t>(tile_row),
                             static_cast<std::uint32_t>(tile_column)};
    if (heights_ == nullptr || tile != tile_) {
        tile_ = tile;
        heights_ = &ground_.heights_of(tile);
    }
    const double u = static_cast<double>(column) * step_ - 1.0;
    const double v = static_cast<double>(row) * step_ - 1.0;
    const float height_m = heights_->height_m(static_cast<std::int32_t>(row - tile_row * kTileSquares),
                                              static_cast<std::int32_t>(column - tile_column * kTileSquares));
    return std::sqrt(1.0 + u * u + v * v)
           / (base_radius_m(ground_.globe, direction_of(face, {u, v})) + static_cast<double>(height_m));
}

// Where cos(theta) a + sin(theta) b is not below 0, for theta from 0 to pi: one range.
GroundMarch::ThetaRange GroundMarch::not_below_zero(double a, double b)
{
    const double middle = std::atan2(b, a);
    if (b >= 0.0)
        return {middle - kPi / 2.0, middle + kPi / 2.0};
    return a > 0.0 ? ThetaRange{0.0, middle + kPi / 2.0} : ThetaRange{middle + 1.5 * kPi, kPi};
}

} // namespace duskline
