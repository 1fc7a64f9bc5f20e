// The box of a shadow map that goes with the viewer.
//
// After: Shadow mapping on large terrain, Organic Vectory (an article on the web, undated): an orthographic box that
// follows the viewer, its side in proportion to the ground clearance. The article leaves size, placement and updating
// open; what is done here stands in the header. Whole texels: M. Valient, Stable rendering of cascaded shadow maps,
// ShaderX6, 2008. Turning the shortest way: O. Rodrigues' formula.

#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/view/shadow_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace duskline {

namespace {

constexpr double kStepsPerSide = 32.0;
constexpr double kSizesPerDoubling = 6.0;
constexpr double kShrinksAt = 0.9;

// Steps are counted in doubles from a point no farther away than this many sides.
constexpr double kFarFromFixedPoint = 4096.0;

bool same(const Vector3& a, const Vector3& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// The ball round the part of a view cone that lies within a radius of its tip.
struct ViewBall {
    double ahead_m;
    double radius_m;
};

ViewBall view_ball(double radius_m, Angle half_view)
{
    if (half_view.degrees() >= 90.0)
        return {0.0, radius_m};
    const auto [sine, cosine] = sine_cosine(half_view);
    if (half_view.degrees() > 45.0)
        return {radius_m * cosine, radius_m * sine};
    return {radius_m / (2.0 * cosine), radius_m / (2.0 * cosine)};
}

// Of the highest ground over the lowest that is in the box: at the bottom of the ball in it.
double caster_reach_m(const ShadowView& view, const ShadowBox& box, double farthest_m)
{
    const double highest_over_centre_m = view.highest_above_eye_m + dot(view.eye_m - box.centre_m, view.up);
    const double rise_m = highest_over_centre_m + box.side_m / 2.0;
    if (!(rise_m > 0.0))
        return 0.0;
    const double sine = dot(view.towards_light, view.up);
    const double root = std::sqrt(sine * sine + 2.0 * view.curvature_per_m * rise_m * (1.0 - sine * sine));
    return sine + root > 0.0 ? std::min(2.0 * rise_m / (sine + root), farthest_m) : farthest_m;
}

void require_valid(const ShadowBoxOptions& options)
{
    if (options.texels < 64)
        throw InvalidInput("a shadow map needs 64 or more texels a side, got "
                           + std::to_string(options.texels));
    if (!(options.reach > 0.0) || !(options.least_clearance_m > 0.0) || !(options.farthest_caster_m > 0.0))
        throw InvalidInput("reach, least clearance and farthest caster of a shadow box must be above 0, got "
                           + std::to_string(options.reach) + ", " + std::to_string(options.least_clearance_m)
                           + " m and " + std::to_string(options.farthest_caster_m) + " m");
}

Vector3 along(const LightAxes& axes, const Vector3& parts)
{
    return axes.right * parts.x + axes.up * parts.y + axes.towards_light * parts.z;
}

Vector3 parts_along(const LightAxes& axes, const Vector3& v)
{
    return {dot(axes.right, v), dot(axes.up, v), dot(axes.towards_light, v)};
}

Vector3 in_whole_steps(const Vector3& v, double step)
{
    return {step * std::round(v.x / step), step * std::round(v.y / step), step * std::round(v.z / step)};
}

} // namespace

LightAxes light_axes(const Vector3& towards_light)
{
    // Any direction that is not the light's; z, so that the axes of a low light over a plane lie level and upright.
    const Vector3 other = std::abs(towards_light.z) < 0.99 ? Vector3{0.0, 0.0, 1.0} : Vector3{0.0, 1.0, 0.0};
    const Vector3 right = normalized(cross(other, towards_light));
    return {right, cross(towards_light, right), towards_light};
}

LightAxes turned_to(const LightAxes& axes, const Vector3& towards_light)
{
    const Vector3 axis = cross(axes.towards_light, towards_light); // its length is the angle's sine
    const double cosine = dot(axes.towards_light, towards_light);
    if (!(cosine > -0.999))
        return light_axes(towards_light);
    const Vector3 turned =
        axes.right * cosine + cross(axis, axes.right) + axis * (dot(axis, axes.right) / (1.0 + cosine));
    // Roundings add up over many turns: at right angles again.
    const Vector3 right = normalized(turned - towards_light * dot(turned, towards_light));
    return {right, cross(towards_light, right), towards_light};
}

ShadowBoxFollower::ShadowBoxFollower(const ShadowBoxOptions& options) : options_(options)
{
    require_valid(options);
}

double ShadowBoxFollower::side_for(double needed_m) const
{
    const bool keeps = box_ && needed_m <= box_->side_m
                       && needed_m > kShrinksAt * box_->side_m / std::exp2(1.0 / kSizesPerDoubling);
    return keeps ? box_->side_m
                 : std::exp2(std::ceil(kSizesPerDoubling * std::log2(needed_m)) / kSizesPerDoubling);
}

void ShadowBoxFollower::turn(const Vector3& towards_light)
{
    if (same(box_->axes.towards_light, towards_light))
        return;
    box_->axes = turned_to(box_->axes, towards_light);
    fixed_m_ = box_->centre_m;
}

const ShadowBox& ShadowBoxFollower::follow(const ShadowView& view)
{
    if (!std::isfinite(view.clearance_m) || !(view.half_view.degrees() > 0.0)
        || !(view.farthest_ground_m > 0.0))
        throw InvalidInput(
            "a shadow box needs a finite clearance, and a half view and a farthest ground above 0, got "
            + std::to_string(view.clearance_m) + " m, " + std::to_string(view.half_view.degrees())
            + " degrees and " + std::to_string(view.farthest_ground_m) + " m");
    const double radius_m = options_.reach * std::max(view.clearance_m, options_.least_clearance_m);
    const ViewBall ball = view_ball(std::min(radius_m, view.farthest_ground_m), view.half_view);
    const double side_m = side_for(2.0 * ball.radius_m / (1.0 - 1.0 / kStepsPerSide));
    if (!box_)
        box_ = ShadowBox{.axes = light_axes(view.towards_light)};
    turn(view.towards_light);

    const double texel_m = side_m / static_cast<double>(options_.texels);
    const double step_m = texel_m * std::floor(static_cast<double>(options_.texels) / kStepsPerSide);
    const Vector3 wanted_m = view.eye_m + view.forward * ball.ahead_m;
    if (length(wanted_m - fixed_m_) > kFarFromFixedPoint * side_m && side_m == box_->side_m)
        fixed_m_ = box_->centre_m;
    const Vector3 steps_m = in_whole_steps(parts_along(box_->axes, wanted_m - fixed_m_), step_m);
    box_->centre_m = fixed_m_ + along(box_->axes, steps_m);
    box_->side_m = side_m;
    box_->texel_m = texel_m;
    box_->radius_m = radius_m;
    box_->caster_reach_m = caster_reach_m(view, *box_, options_.farthest_caster_m);
    return *box_;
}

bool same_map(const ShadowBox& a, const ShadowBox& b)
{
    return a.side_m == b.side_m && a.texel_m == b.texel_m && same(a.centre_m, b.centre_m)
           && same(a.axes.towards_light, b.axes.towards_light) && same(a.axes.right, b.axes.right);
}

bool may_cast_into(const ShadowBox& box, const Box& casters_m)
{
    const Vector3 half_m = (casters_m.high - casters_m.low) * 0.5;
    const Vector3 from_centre_m = casters_m.low + half_m - box.centre_m;
    const auto part = [&](const Vector3& axis) { return dot(from_centre_m, axis); };
    const auto extent = [&](const Vector3& axis) {
        return std::abs(axis.x) * half_m.x + std::abs(axis.y) * half_m.y + std::abs(axis.z) * half_m.z;
    };
    const double half_side_m = box.side_m / 2.0;
    const auto& [right, up, towards] = box.axes;
    return std::abs(part(right)) <= half_side_m + extent(right)
           && std::abs(part(up)) <= half_side_m + extent(up)
           && part(towards) >= -half_side_m - extent(towards)
           && part(towards) <= half_side_m + box.caster_reach_m + extent(towards);
}

std::array<std::array<float, 4>, 3> box_rows(const ShadowBox& box, const Vector3& origin_m)
{
    const Vector3 from_centre_m = origin_m - box.centre_m;
    const auto row = [&](const Vector3& axis) {
        const double scale = 1.0 / box.side_m;
        return std::array<float, 4>{static_cast<float>(axis.x * scale), static_cast<float>(axis.y * scale),
                                    static_cast<float>(axis.z * scale),
                                    static_cast<float>(dot(axis, from_centre_m) * scale + 0.5)};
    };
    return {row(box.axes.right), row(box.axes.up), row(box.axes.towards_light * -1.0)};
}

Matrix4 box_to_clip(const ShadowBox& box, const Vector3& origin_m)
{
    const auto rows = box_rows(box, origin_m);
    Matrix4 matrix = {};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            matrix.at(4 * column + row) = 2.0f * rows.at(row).at(column) - (column == 3 ? 1.0f : 0.0f);
    matrix[15] = 1.0f;
    return matrix;
}

} // namespace duskline
