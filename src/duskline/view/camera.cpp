#include <duskline/geometry/cross_product.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/view/camera.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace duskline {

namespace {

constexpr Angle kSteepest = Angle::from_degrees(89.9);

// How much of its picture an overview fills.
constexpr double kFilled = 0.92;

double extent_m(const HeightField& field)
{
    const double width = static_cast<double>(field.columns()) * field.cell_size_m.x;
    const double height = static_cast<double>(field.rows()) * field.cell_size_m.y;
    return std::hypot(width, height);
}

Vector3 middle_m(const HeightField& field)
{
    const GridPoint middle = {(static_cast<double>(field.rows()) - 1.0) / 2.0,
                              (static_cast<double>(field.columns()) - 1.0) / 2.0, 0.0};
    Vector3 position = position_m(middle, field.cell_size_m);
    position.z = ground_height_m(field, middle.row, middle.column).value_or(0.0);
    return position;
}

// Of the box around all ground.
std::vector<Vector3> corners_m(const HeightField& field)
{
    const HeightRange heights = height_range(field);
    const bool has_data = heights.lowest_m <= heights.highest_m;
    std::vector<Vector3> corners;
    for (const double row : {0.0, static_cast<double>(field.rows()) - 1.0})
        for (const double column : {0.0, static_cast<double>(field.columns()) - 1.0})
            for (const float height_m : {heights.lowest_m, heights.highest_m})
                corners.push_back(position_m({row, column, has_data ? static_cast<double>(height_m) : 0.0},
                                             field.cell_size_m));
    return corners;
}

// How far back from a place, and how far aside, everything just fits between two planes through the eye.
struct Fit {
    double distance_m = 0.0;
    double shift_m = 0.0;
};

// The planes rise by `half_width` a metre ahead, towards `aside` and away from it: each is moved until it touches.
Fit fitted(const std::vector<Vector3>& places_m, const Vector3& around_m, const Vector3& aside,
           const Vector3& forward, double half_width)
{
    double this_side_m = -std::numeric_limits<double>::infinity();
    double other_side_m = this_side_m;
    for (const Vector3& place_m : places_m) {
        const double across_m = dot(place_m - around_m, aside);
        const double within_m = half_width * dot(place_m - around_m, forward);
        this_side_m = std::max(this_side_m, across_m - within_m);
        other_side_m = std::max(other_side_m, -across_m - within_m);
    }
    return {(this_side_m + other_side_m) / (2.0 * half_width), (this_side_m - other_side_m) / 2.0};
}

// Of the ground under a place, that of the nearest border beyond it.
std::optional<double> ground_under(const Vector3& position, const HeightField& field)
{
    if (field.rows() == 0 || field.columns() == 0)
        return std::nullopt;
    const GridPoint place = grid_point(position, field.cell_size_m);
    return ground_height_m(field, std::clamp(place.row, 0.0, static_cast<double>(field.rows() - 1)),
                           std::clamp(place.column, 0.0, static_cast<double>(field.columns() - 1)));
}

} // namespace

CameraAxes axes_of(const Camera& camera)
{
    const auto [sin_heading, cos_heading] = sine_cosine(camera.heading);
    const auto [sin_pitch, cos_pitch] = sine_cosine(camera.pitch);
    const Vector3 forward = {sin_heading * cos_pitch, cos_heading * cos_pitch, sin_pitch};
    const Vector3 right = {cos_heading, -sin_heading, 0.0};
    return {forward, right, cross(right, forward)};
}

Matrix4 eye_to_clip(const Camera& camera, double aspect, const DepthRange& depth)
{
    const auto [forward, right, up] = axes_of(camera);
    const double upwards = 1.0 / tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    const double sideways = upwards / aspect;
    const double spread = depth.farthest_m - depth.nearest_m;
    const double depth_scale = (depth.farthest_m + depth.nearest_m) / spread;
    const double depth_shift = -2.0 * depth.farthest_m * depth.nearest_m / spread;
    const auto column = [&](double r, double u, double f, double shift, double w) {
        return std::array<float, 4>{static_cast<float>(sideways * r), static_cast<float>(upwards * u),
                                    static_cast<float>(depth_scale * f + shift), static_cast<float>(w)};
    };
    const std::array<std::array<float, 4>, 4> columns = {
        column(right.x, up.x, forward.x, 0.0, forward.x), column(right.y, up.y, forward.y, 0.0, forward.y),
        column(right.z, up.z, forward.z, 0.0, forward.z), column(0.0, 0.0, 0.0, depth_shift, 0.0)};
    Matrix4 matrix = {};
    for (std::size_t i = 0; i < 16; ++i)
        matrix.at(i) = columns.at(i / 4).at(i % 4);
    return matrix;
}

double pixels_per_radian(const Camera& camera, double height)
{
    return height / (2.0 * tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0)));
}

Camera turned(const Camera& camera, Angle by_heading, Angle by_pitch)
{
    Camera result = camera;
    result.heading = wrapped_to_circle(camera.heading + by_heading);
    result.pitch = std::clamp(camera.pitch + by_pitch, -kSteepest, kSteepest);
    return result;
}

Camera orbited(const Camera& camera, const Vector3& pivot_m, Angle by_heading, Angle by_pitch)
{
    const CameraAxes before = axes_of(camera);
    Camera result = turned(camera, by_heading, by_pitch);
    const CameraAxes after = axes_of(result);
    const Vector3 to_pivot = pivot_m - camera.position_m;
    result.position_m = pivot_m - after.forward * dot(to_pivot, before.forward)
                        - after.right * dot(to_pivot, before.right) - after.up * dot(to_pivot, before.up);
    return result;
}

Camera approached(const Camera& camera, const Vector3& pivot_m, double factor)
{
    Camera result = camera;
    result.position_m = pivot_m + (camera.position_m - pivot_m) * factor;
    return result;
}

Camera flown(const Camera& camera, double right_m, double ahead_m, double up_m)
{
    const CameraAxes axes = axes_of(camera);
    Camera result = camera;
    result.position_m =
        camera.position_m + axes.right * right_m + axes.forward * ahead_m + Vector3{0.0, 0.0, up_m};
    return result;
}

double clearance_m(const Vector3& position_m, const HeightField& field)
{
    return position_m.z - ground_under(position_m, field).value_or(0.0);
}

Camera kept_above_ground(const Camera& camera, const HeightField& field, double clearance_m)
{
    Camera result = camera;
    if (const auto ground_m = ground_under(camera.position_m, field))
        result.position_m.z = std::max(camera.position_m.z, *ground_m + clearance_m);
    return result;
}

Vector3 picked_m(const Camera& camera, double aspect, double right, double up, const HeightField& field)
{
    const CameraAxes axes = axes_of(camera);
    const double half_height = tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    const Vector3 ray =
        normalized(axes.forward + axes.right * (right * half_height * aspect) + axes.up * (up * half_height));
    const double reach_m = length(camera.position_m - middle_m(field)) + extent_m(field);
    const double shortest_m = std::min(field.cell_size_m.x, field.cell_size_m.y);
    // Steps grow with distance, as what a pixel covers does.
    for (double distance_m = 0.0; distance_m < reach_m; distance_m += shortest_m + 0.001 * distance_m) {
        const Vector3 place = camera.position_m + ray * distance_m;
        const GridPoint at = grid_point(place, field.cell_size_m);
        const auto ground_m = ground_height_m(field, at.row, at.column);
        if (ground_m && place.z <= *ground_m)
            return place;
    }
    return camera.position_m + ray * length(middle_m(field) - camera.position_m);
}

Camera overview(const HeightField& field, double aspect)
{
    Camera camera;
    camera.heading = Angle::from_degrees(15.0);
    camera.pitch = Angle::from_degrees(-36.0);
    const auto [forward, right, up] = axes_of(camera);
    const double half_height = kFilled * tangent(Angle::from_degrees(camera.vertical_view.degrees() / 2.0));
    const Vector3 middle = middle_m(field);
    const Fit sideways = fitted(corners_m(field), middle, right, forward, half_height * aspect);
    const Fit upwards = fitted(corners_m(field), middle, up, forward, half_height);
    const double distance_m = std::max(sideways.distance_m, upwards.distance_m);
    camera.position_m = middle + right * sideways.shift_m + up * upwards.shift_m - forward * distance_m;
    return kept_above_ground(camera, field, 0.05 * distance_m);
}

DepthRange depth_range(const Camera& camera, const HeightField& field, HeightRange heights)
{
    const double farthest_m = length(camera.position_m - middle_m(field)) + extent_m(field);
    const double smallest_m = 0.1 * std::min(field.cell_size_m.x, field.cell_size_m.y);
    const bool above_all = camera.position_m.z > heights.highest_m;
    // Slopes ahead can be nearer than the ground below; over the highest summit nothing is nearer than it.
    const double nearest_m =
        std::max({smallest_m, 0.2 * clearance_m(camera.position_m, field),
                  above_all ? 0.6 * (camera.position_m.z - static_cast<double>(heights.highest_m)) : 0.0});
    return {std::min(nearest_m, 0.5 * farthest_m), farthest_m};
}

} // namespace duskline
