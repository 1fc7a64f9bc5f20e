#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/view/camera_path.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace duskline {

namespace {

// Through b at t = 0 and c at t = 1.
double catmull_rom(const std::array<double, 4>& p, double t)
{
    const auto [a, b, c, d] = p;
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

// The same direction, counted so that it is nearest to another.
double nearest_turn_deg(double degrees, double to_degrees)
{
    return to_degrees + std::remainder(degrees - to_degrees, 360.0);
}

struct Neighbours {
    std::array<Camera, 4> poses;
    double t;

    template <typename Part>
    double at(const Part& part) const
    {
        return catmull_rom({part(poses[0]), part(poses[1]), part(poses[2]), part(poses[3])}, t);
    }
};

Neighbours neighbours(const CameraPath& path, double share)
{
    const auto last = static_cast<std::ptrdiff_t>(path.poses.size()) - 1;
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(last);
    const auto before = std::min(static_cast<std::ptrdiff_t>(place), std::max<std::ptrdiff_t>(0, last - 1));
    const auto pose = [&](std::ptrdiff_t i) {
        return path.poses[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    return {{pose(before - 1), pose(before), pose(before + 1), pose(before + 2)},
            place - static_cast<double>(before)};
}

// On a loop around the middle of the terrain: how far round, how far out, how high over the ground (shares of the
// terrain's width).
struct LoopPoint {
    double round;
    double out;
    double height;
};
constexpr std::array<LoopPoint, 12> kLoop = {{{0.50, 0.60, 0.300},
                                              {0.56, 0.45, 0.160},
                                              {0.64, 0.36, 0.070},
                                              {0.73, 0.32, 0.040},
                                              {0.83, 0.30, 0.030},
                                              {0.93, 0.26, 0.025},
                                              {1.03, 0.24, 0.030},
                                              {1.13, 0.26, 0.025},
                                              {1.23, 0.30, 0.035},
                                              {1.32, 0.34, 0.060},
                                              {1.40, 0.42, 0.140},
                                              {1.46, 0.56, 0.260}}};

constexpr std::size_t kPoses = 241;
constexpr std::size_t kSmoothing = 6; // poses before and after
constexpr double kClearance = 0.012;  // over the ground, of the terrain's width

// For each value the highest, or the mean, of those around it.
template <typename Reduce>
std::vector<double> over_neighbours(const std::vector<double>& values, const Reduce& reduce)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, kSmoothing));
        const auto last =
            values.begin() + static_cast<std::ptrdiff_t>(std::min(i + kSmoothing + 1, values.size()));
        result.push_back(reduce(first, last));
    }
    return result;
}

// The same flight at more poses, lifted smoothly over all ground in its way: the mean of the greatest heights around
// each pose is nowhere lower than what the pose needs.
CameraPath lifted_over_ground(const CameraPath& path, const HeightField& field, double clearance_m)
{
    CameraPath fine;
    std::vector<double> lift_m;
    for (std::size_t i = 0; i < kPoses; ++i) {
        fine.poses.push_back(pose_at(path, static_cast<double>(i) / static_cast<double>(kPoses - 1)));
        const Camera lifted = kept_above_ground(fine.poses.back(), field, clearance_m);
        lift_m.push_back(lifted.position_m.z - fine.poses.back().position_m.z);
    }
    const auto highest =
        over_neighbours(lift_m, [](auto first, auto last) { return *std::max_element(first, last); });
    const auto smooth = over_neighbours(highest, [](auto first, auto last) {
        return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
    });
    for (std::size_t i = 0; i < kPoses; ++i)
        fine.poses[i].position_m.z += smooth[i];
    return fine;
}

Angle heading_of(const Vector3& direction)
{
    return wrapped_to_circle(Angle::from_radians(std::atan2(direction.x, direction.y)));
}

} // namespace

Camera pose_at(const CameraPath& path, double share)
{
    if (path.poses.empty())
        throw InvalidInput("a flight needs at least one pose");
    const Neighbours near = neighbours(path, share);
    const double reference_deg = near.poses[1].heading.degrees();
    Camera camera = near.poses[1];
    camera.position_m = {near.at([](const Camera& c) { return c.position_m.x; }),
                         near.at([](const Camera& c) { return c.position_m.y; }),
                         near.at([](const Camera& c) { return c.position_m.z; })};
    camera.heading = wrapped_to_circle(Angle::from_degrees(
        near.at([&](const Camera& c) { return nearest_turn_deg(c.heading.degrees(), reference_deg); })));
    camera.pitch = Angle::from_degrees(near.at([](const Camera& c) { return c.pitch.degrees(); }));
    camera.vertical_view =
        Angle::from_degrees(near.at([](const Camera& c) { return c.vertical_view.degrees(); }));
    return camera;
}

CameraPath usual_flight(const HeightField& field, double aspect)
{
    const Camera whole = overview(field, aspect);
    const double rows = static_cast<double>(field.rows()) - 1.0;
    const double columns = static_cast<double>(field.columns()) - 1.0;
    const double width_m = std::max(rows * field.cell_size_m.y, columns * field.cell_size_m.x);
    std::vector<Vector3> places;
    for (const LoopPoint& point : kLoop) {
        const double angle = 2.0 * std::numbers::pi * point.round;
        const GridPoint at = {std::clamp(rows * (0.5 - point.out * std::cos(angle)), 0.0, rows),
                              std::clamp(columns * (0.5 + point.out * std::sin(angle)), 0.0, columns), 0.0};
        const double ground_m = ground_height_m(field, at.row, at.column).value_or(0.0);
        places.push_back(position_m(at, field.cell_size_m)
                         + Vector3{0.0, 0.0, ground_m + point.height * width_m});
    }
    CameraPath path;
    path.poses.push_back(whole);
    for (std::size_t i = 0; i < places.size(); ++i) {
        Camera camera = whole;
        camera.position_m = places[i];
        // Ahead along the loop and somewhat inwards.
        const Vector3 ahead = places[std::min(i + 1, places.size() - 1)] - places[i > 0 ? i - 1 : 0];
        const Vector3 inwards =
            position_m({rows / 2.0, columns / 2.0, places[i].z}, field.cell_size_m) - places[i];
        camera.heading = heading_of(normalized(ahead) + normalized(inwards) * 0.7);
        camera.pitch = Angle::from_degrees(-14.0 - 60.0 * kLoop.at(i).height);
        path.poses.push_back(camera);
    }
    path.poses.push_back(whole);
    return lifted_over_ground(path, field, kClearance * width_m);
}

} // namespace duskline
