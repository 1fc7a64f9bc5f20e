#include <duskline/geometry/cross_product.h>
#include <duskline/view/lamp_face.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace duskline {

namespace {

constexpr double kWidestFace_deg = 60.0;

// right x up = -forward.
CameraAxes axes_along(const Vector3& forward)
{
    const Vector3 other = std::abs(forward.z) < 0.99 ? Vector3{0.0, 0.0, 1.0} : Vector3{0.0, 1.0, 0.0};
    const Vector3 right = normalized(cross(forward, other));
    return {forward, right, cross(right, forward)};
}

// As shaders/lamp_maps.glsl has them.
constexpr std::array<CameraAxes, 6> kCube = {
    CameraAxes{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    CameraAxes{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
    CameraAxes{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}};

double with_border(double half_width, std::size_t texels)
{
    return half_width * static_cast<double>(texels) / static_cast<double>(texels - 2 * kLampBorder);
}

std::array<double, 15> numbers(const LampFace& face)
{
    const auto& [forward, right, up] = face.axes;
    return {face.lamp_m.x,
            face.lamp_m.y,
            face.lamp_m.z,
            face.half_width,
            face.range_m,
            forward.x,
            forward.y,
            forward.z,
            right.x,
            right.y,
            right.z,
            up.x,
            up.y,
            up.z,
            static_cast<double>(face.texels)};
}

} // namespace

std::vector<LampFace> lamp_faces(const SceneLamp& lamp, std::size_t texels)
{
    assert(texels > 2 * kLampBorder);
    const auto face = [&](const CameraAxes& axes, double half_width) {
        return LampFace{lamp.position_m, axes, with_border(half_width, texels), lamp.range_m, texels};
    };
    if (lamp.half_angle.degrees() <= kWidestFace_deg)
        return {face(axes_along(normalized(lamp.direction)), tangent(lamp.half_angle))};
    std::vector<LampFace> faces;
    faces.reserve(kCube.size());
    for (const CameraAxes& axes : kCube)
        faces.push_back(face(axes, 1.0));
    return faces;
}

bool same_map(const LampFace& a, const LampFace& b)
{
    return numbers(a) == numbers(b);
}

Matrix4 face_to_clip(const LampFace& face, const Vector3& origin_m)
{
    const Vector3 right = face.axes.right * (1.0 / face.half_width);
    const Vector3 up = face.axes.up * (1.0 / face.half_width);
    const Vector3 forward = face.axes.forward;
    const Vector3 origin = origin_m - face.lamp_m;
    const std::array<double, 16> columns = {right.x,
                                            up.x,
                                            0.0,
                                            forward.x,
                                            right.y,
                                            up.y,
                                            0.0,
                                            forward.y,
                                            right.z,
                                            up.z,
                                            0.0,
                                            forward.z,
                                            dot(right, origin),
                                            dot(up, origin),
                                            kNearestToLamp_m,
                                            dot(forward, origin)};
    Matrix4 matrix = {};
    std::ranges::transform(columns, matrix.begin(), [](double v) { return static_cast<float>(v); });
    return matrix;
}

std::array<Vector3, 4> sides_of(const LampFace& face)
{
    const auto& [forward, right, up] = face.axes;
    const Vector3 ahead = forward * face.half_width;
    return {normalized(ahead + right), normalized(ahead - right), normalized(ahead + up),
            normalized(ahead - up)};
}

bool may_cast_into(const LampFace& face, const Box& casters_m)
{
    return distance_m(face.lamp_m, casters_m) < face.range_m
           && std::ranges::all_of(sides_of(face), [&](const Vector3& inwards) {
                  return dot(inwards, farthest_corner(casters_m, inwards) - face.lamp_m) >= 0.0;
              });
}

} // namespace duskline
