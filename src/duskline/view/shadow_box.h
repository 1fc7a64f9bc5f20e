#pragma once

#include <duskline/geometry/angle.h>
#include <duskline/geometry/vector.h>
#include <duskline/view/camera.h>
#include <duskline/view/frustum.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace duskline {

/// Directions of a box in parallel light: unit vectors at right angles, right x up = towards_light. They are no more
/// than numbers on the map: `up` need not point upwards.
struct LightAxes {
    Vector3 right = {1.0, 0.0, 0.0};
    Vector3 up = {0.0, 1.0, 0.0};
    Vector3 towards_light = {0.0, 0.0, 1.0};
};

/// Axes for a light, from its direction (a unit vector) alone.
LightAxes light_axes(const Vector3& towards_light);

/// The same axes for a light that has moved: turned the shortest way, so that a map of them turns no more than the light
/// does. Directions are unit vectors.
LightAxes turned_to(const LightAxes& axes, const Vector3& towards_light);

/// What a shadow map is wanted for: an eye over a plane or a globe. Positions in metres in any fixed frame, directions
/// unit vectors in it.
struct ShadowView {
    Vector3 eye_m = {};
    Vector3 forward = {0.0, 1.0, 0.0};
    Vector3 up = {0.0, 0.0, 1.0}; ///< away from the ground under the eye
    Angle half_view =
        Angle::from_degrees(45.0);    ///< between `forward` and the corners of the picture; above 0
    double clearance_m = 0.0;         ///< height of the eye over the ground
    double highest_above_eye_m = 0.0; ///< how far the highest ground lies above the eye; mostly negative
    double curvature_per_m = 0.0;     ///< 1 over the globe's radius; 0 for a plane
    double farthest_ground_m = std::numeric_limits<double>::infinity(); ///< from the eye; above 0
    Vector3 towards_light = {0.0, 0.0, 1.0};
};

/// What a shadow map holds: a cube along the light.
///
///        to the light     |<- side ->|
///              \          +----------+
///               \   caster|reach     |       in front of the cube casters are not lost: their depth is that of its
///                \        +==========+ <- front       front (depth clamp), which is before everything in it
///                 \       |  _____   |
///        eye       \      | /     \  |       the circle is the ball round what the picture shows up to `radius_m`
///         o - - - - - - - >|   o   | |       from the eye: it stays inside however the camera rolls
///                         | \_____/  |
///                         +----------+
struct ShadowBox {
    LightAxes axes;
    Vector3 centre_m = {};
    double side_m = 1.0;
    double texel_m = 1.0;
    double radius_m = 1.0; ///< shadows are wanted up to this distance from the eye
    double caster_reach_m =
        0.0; ///< how far in front of the cube ground may stand that shades something in it
};

/// How large a box is, and when it moves.
struct ShadowBoxOptions {
    std::size_t texels = 4096;      ///< of the map along a side; 64 or more
    double reach = 12.0;            ///< radius of shadows over the eye's clearance; above 0
    double least_clearance_m = 2.0; ///< eyes nearer to the ground count as that high; above 0
    double farthest_caster_m = 5e5; ///< casters farther from the box than this are left out; above 0
};

/// A box that goes with the eye, and moves as seldom as it can.
///
/// Size. Shadows are wanted up to radius = reach * max(clearance, least_clearance) from the eye: the ground's share of
/// the picture that has shadows stays the same at all heights. The ball round the part of the view cone up to there, or
/// up to the farthest ground, has
///
///     r = radius / (2 cos a) at radius / (2 cos a) ahead for half views a up to 45 degrees, else
///     r = radius sin a       at radius cos a       ahead, and the whole ball (r = radius) from 90 degrees on,
///
/// and the side is the next of 1, 1.12, 1.26, 1.41, ... m (powers of the sixth root of 2) that holds it with the room to stay
/// put below: texels of another size move all edges a little, and the less the more alike they are. It grows at once and
/// shrinks only when nine tenths of the next smaller side would do, so that small ups and downs never change it. (radius_m
/// follows the clearance itself: the fade does not jump.)
///
/// Place. The ball's centre, in whole steps of 1/32 of the map along the light's axes (also in depth), counted from a
/// fixed point. A step is a whole number of texels, so a place keeps its place within its texel: nothing swims while
/// the eye moves, and the map need not be drawn again before the eye has gone a step. The box is that much larger.
///
/// Light. When the light has moved, axes turn the shortest way and round the middle of the last box.
///
/// Casters. Lowest ground in the box, at the bottom of the ball, may lie in the shadow of the highest: with h between
/// them, light of the altitude A over the ball's centre and curvature k these stand up to 2 h / (sin A + sqrt(sin^2 A +
/// 2 k h cos^2 A)) away.
class ShadowBoxFollower {
public:
    /// Throws InvalidInput for options out of range.
    explicit ShadowBoxFollower(const ShadowBoxOptions& options = {});

    /// The box for a view. Throws InvalidInput for a clearance that is not finite, and a half view of 0 or less.
    const ShadowBox& follow(const ShadowView& view);

    const ShadowBoxOptions& options() const { return options_; }

private:
    void turn(const Vector3& towards_light);
    double side_for(double needed_m) const;

    ShadowBoxOptions options_;
    std::optional<ShadowBox> box_;
    Vector3 fixed_m_ = {}; ///< where steps are counted from
};

/// Whether maps of both are the same: all but radius and reach.
bool same_map(const ShadowBox& a, const ShadowBox& b);

/// False only for what cannot shade anything in the box: beside it, behind it, or beyond `caster_reach_m` before it.
bool may_cast_into(const ShadowBox& box, const Box& casters_m);

/// From positions relative to `origin_m` to OpenGL's clip space, x and y along the map, depth -1 at the front. Take
/// an origin near the box; with its centre, maps are the same to the last bit as long as the box is.
Matrix4 box_to_clip(const ShadowBox& box, const Vector3& origin_m);

/// Where a position lies in the box: (position, 1) times each row is column and row of the map and depth, all 0 to 1
/// (0 at the front), for positions relative to `origin_m`.
std::array<std::array<float, 4>, 3> box_rows(const ShadowBox& box, const Vector3& origin_m);

} // namespace duskline
