// In the half-plane of a point (a fixed turn about the light's axis) the ground is a curve rho(theta), and the point is in
// shadow when that curve is anywhere nearer to the sun as far from the axis as the point:
//
//       rho ^          __
//           |        _/  \__     .......... p      the ray goes left, towards the sun, and keeps its rho
//           |     _./  .     \__/
//           |  _./     |
//           +-'--------+---------+----------> theta
//           0 sun      |         90 terminator     nothing to the left of | reaches rho(p): (radius + highest) sin theta
//                                                  only falls from there on
//
// On a face of the cube the half-plane is a straight line in (u, v), so crossings with rows and columns are counted, not
// searched. Between two samples the straight line in space has 1 / depth linear in u or v, where depth is the coordinate
// along the face's axis: |(1, u, v)| / depth is the radius' inverse.

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/light_section.h>
#include <duskline/planet/planet_ray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace duskline {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

// Crossings nearer than this to the start are the start itself, in samples.
constexpr double kOwnGround = 1e-6;

struct ThetaRange {
    double low;
    double high;
};

// Where cos(theta) a + sin(theta) b is not below 0, for theta from 0 to pi: one range.
ThetaRange not_below_zero(double a, double b)
{
    const double middle = std::atan2(b, a);
    if (b >= 0.0)
        return {middle - kPi / 2.0, middle + kPi / 2.0};
    return a > 0.0 ? ThetaRange{0.0, middle + kPi / 2.0} : ThetaRange{middle + 1.5 * kPi, kPi};
}

// One walk towards the sun.
class March {
public:
    March(const PlanetLevel& ground, const Vector3& to_sun, const Vector3& outward, double known_rho_m,
          bool stop_at_first)
        : ground_(ground), to_sun_(to_sun), outward_(outward),
          samples_(std::int64_t{kTileSquares} << ground.level), step_(2.0 / static_cast<double>(samples_)),
          section_(ground.globe, to_sun, outward),
          falling_below_(std::min(section_.widest_theta(), kPi / 2.0)), rho_m_(known_rho_m),
          stop_at_first_(stop_at_first)
    {}

    double greatest_rho_m(double theta)
    {
        start_ = first_theta_that_counts(theta);
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

private:
    // Far beyond the terminator the ground is nearer to the axis than the ground at the terminator, however high it is.
    double first_theta_that_counts(double theta) const
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
    double reach_m(double theta) const
    {
        return (section_.radius_m(theta) + static_cast<double>(ground_.range.highest_m)) * std::sin(theta);
    }

    ThetaRange thetas_on(std::uint32_t face) const
    {
        const CubeFaceAxes axes = axes_of_face(face);
        ThetaRange range = {0.0, start_};
        for (const Vector3& side :
             {axes.axis + axes.right, axes.axis - axes.right, axes.axis + axes.up, axes.axis - axes.up}) {
            const ThetaRange inside = not_below_zero(dot(to_sun_, side), dot(outward_, side));
            range = {std::max(range.low, inside.low), std::min(range.high, inside.high)};
        }
        return range;
    }

    void walk_over(std::uint32_t face, ThetaRange thetas)
    {
        for (const LinesAlong lines : {LinesAlong::u, LinesAlong::v})
            cross_lines(face, lines, thetas);
        ended_ = ended_ || (thetas.low < falling_below_ && reach_m(thetas.low) <= rho_m_);
    }

    void cross_lines(std::uint32_t face, LinesAlong lines, ThetaRange thetas)
    {
        const FaceVector sun = on_face(to_sun_, face, lines);
        const FaceVector outward = on_face(outward_, face, lines);
        const BeamLine beam(sun, outward);
        const auto line_at = [&](double theta) {
            const double ahead = std::cos(theta) * sun.ahead + std::sin(theta) * outward.ahead;
            const double y = std::cos(theta) * sun.y + std::sin(theta) * outward.y;
            return (y / ahead + 1.0) / step_;
        };
        const double from = line_at(thetas.high);
        const double to = line_at(thetas.low);
        // The line under the start is its own, on both faces if it is on an edge; other lines on edges belong to both.
        const bool from_start = start_ - thetas.high < kOwnGround * step_;
        const double slack = from_start ? kOwnGround : -kOwnGround;
        if (std::abs(to - from) <= kOwnGround) // along the lines
            return;
        if (to > from)
            for (auto line = index_above(from + slack); line <= index_below(to + kOwnGround); ++line) {
                if (!cross(face, lines, beam, line))
                    return;
            }
        else
            for (auto line = index_below(from - slack); line >= index_above(to - kOwnGround); --line)
                if (!cross(face, lines, beam, line))
                    return;
    }

    std::int64_t index_above(double line) const
    {
        return static_cast<std::int64_t>(std::ceil(std::max(line, 0.0)));
    }
    std::int64_t index_below(double line) const
    {
        return static_cast<std::int64_t>(std::floor(std::min(line, static_cast<double>(samples_))));
    }

    // False when no more crossings of these lines can count.
    bool cross(std::uint32_t face, LinesAlong lines, const BeamLine& beam, std::int64_t line)
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
        const FaceVector sun = on_face(to_sun_, face, lines);
        const double theta = std::atan2(part, sun.ahead + sun.x * x + sun.y * y);
        return !(theta < falling_below_ && reach_m(theta) <= rho_m_);
    }

    double inverse_depth_at(std::uint32_t face, LinesAlong lines, std::int64_t line, std::int64_t cell)
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
        const float height_m =
            heights_->height_m(static_cast<std::int32_t>(row - tile_row * kTileSquares),
                               static_cast<std::int32_t>(column - tile_column * kTileSquares));
        return std::sqrt(1.0 + u * u + v * v)
               / (base_radius_m(ground_.globe, direction_of(face, {u, v})) + static_cast<double>(height_m));
    }

    const PlanetLevel& ground_;
    Vector3 to_sun_;
    Vector3 outward_;
    std::int64_t samples_;
    double step_;
    LightSection section_;
    double falling_below_; // nearer to the sun than this theta, the greatest distance possible only falls
    double rho_m_;
    bool stop_at_first_;
    bool ended_ = false;
    double start_ = 0.0;
    PlanetTile tile_ = {};
    const TileHeights* heights_ = nullptr;
};

// Directions nearer to the axis than this have no turn about it.
constexpr double kOnAxis = 1e-14;

// A direction in its half-plane about the axis of the raised light, and the sine and cosine of its theta there.
struct HalfPlanePlace {
    Vector3 unit;
    Vector3 to_sun;
    Vector3 outward;
    double sine;
    double cosine;
};

HalfPlanePlace half_plane_place(const LightAxis& axis, const Vector3& direction)
{
    const Vector3 unit = normalized(direction);
    const double cosine = dot(unit, axis.to_sun);
    // Twice, because once loses digits near the axis.
    Vector3 away = unit - axis.to_sun * cosine;
    away = away - axis.to_sun * dot(away, axis.to_sun);
    const double sine = length(away);
    if (sine <= kOnAxis)
        return {unit, axis.to_sun, axis.across, 0.0, cosine};
    const Vector3 outward = away * (1.0 / sine);
    return {unit, axis.to_sun * axis.raised_cosine + outward * axis.raised_sine,
            outward * axis.raised_cosine - axis.to_sun * axis.raised_sine,
            axis.from_raised_axis(cosine, sine), cosine * axis.raised_cosine + sine * axis.raised_sine};
}

} // namespace

PlanetRays::PlanetRays(PlanetLevel ground, const Vector3& to_sun, Angle raised)
    : ground_(std::move(ground)), axis_(light_axis(to_sun, raised))
{
    require_valid(ground_.globe);
    if (ground_.level > kDeepestTileLevel)
        throw InvalidInput("the level of a planet's ground must be 0 to " + std::to_string(kDeepestTileLevel)
                           + ", got " + std::to_string(ground_.level));
    if (!(ground_.range.lowest_m <= ground_.range.highest_m))
        throw InvalidInput("the range of a planet's heights must not be empty");
}

double PlanetRays::shadow_height_m(const Vector3& direction) const
{
    const HalfPlanePlace place = half_plane_place(axis_, direction);
    if (place.sine <= kOnAxis) // or the edge of the sun is beyond
        return place.cosine > 0.0 ? -kInfinity : kInfinity;
    March march(ground_, place.to_sun, place.outward, 0.0, false);
    const double rho_m = march.greatest_rho_m(std::atan2(place.sine, place.cosine));
    return rho_m > 0.0 ? rho_m / place.sine - base_radius_m(ground_.globe, place.unit) : -kInfinity;
}

bool PlanetRays::is_lit(const Vector3& direction, double height_m) const
{
    const HalfPlanePlace place = half_plane_place(axis_, direction);
    if (place.sine <= kOnAxis) // or the edge of the sun is beyond
        return place.cosine > 0.0;
    const double own_rho_m = (base_radius_m(ground_.globe, place.unit) + height_m) * place.sine;
    March march(ground_, place.to_sun, place.outward, own_rho_m, true);
    return !(march.greatest_rho_m(std::atan2(place.sine, place.cosine)) > own_rho_m);
}

} // namespace duskline
