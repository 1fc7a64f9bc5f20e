#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/view/camera.h>
#include <duskline/view/frustum.h>
#include <duskline/view/scene_lamp.h>

#include <array>
#include <cstddef>
#include <vector>

namespace duskline {

/// A square through which a lamp shines: what one depth map of it holds.
///
///            up                       A searchlight with a half angle of up to 60 degrees looks through one, all others
///        +---|---+                    through six, a cube round the lamp whose faces look along the frame's axes. Each is
///       *|---o---|- forward           wider than its share by four texels a side, so that kernels along a seam find all
///        +-------+                    they need on either side of it.
struct LampFace {
    Vector3 lamp_m;
    CameraAxes axes;         ///< right x up looks back to the lamp
    double half_width = 1.0; ///< half the side of the square 1 m ahead, with those texels
    double range_m = 0.0;    ///< casters farther from the lamp change nothing
    std::size_t texels = 0;  ///< along a side
};

/// Texels that a face has more than its share, at either side.
inline constexpr std::size_t kLampBorder = 4;

/// Depth is so many metres over the distance ahead; nearer casters are not seen.
inline constexpr double kNearestToLamp_m = 0.1;

/// The faces of a lamp, one or six: for six they look along +x, -x, +y, -y, +z, -z. `lamp` must be valid, and `texels`
/// above 8.
std::vector<LampFace> lamp_faces(const SceneLamp& lamp, std::size_t texels);

/// Whether maps of both are the same.
bool same_map(const LampFace& a, const LampFace& b);

/// From positions relative to `origin_m` to clip space with reversed depth (gl/reversed_depth.h).
Matrix4 face_to_clip(const LampFace& face, const Vector3& origin_m);

/// The four planes at the sides of what a face sees, through the lamp: unit vectors that point inwards.
std::array<Vector3, 4> sides_of(const LampFace& face);

/// False only for what stands beside the face's view, or beyond its range.
bool may_cast_into(const LampFace& face, const Box& casters_m);

} // namespace duskline
