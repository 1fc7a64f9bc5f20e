#pragma once

#include <duskline/geometry/vector.h>
#include <duskline/gl/program.h>
#include <duskline/view/camera.h>

#include <array>
#include <span>

namespace duskline::gl {

using Triangle = std::array<Vector3, 3>;

/// Draws things made of triangles that cast shadows into any depth map.
class TriangleCasters {
public:
    TriangleCasters();

    /// Their depth, into the current framebuffer: `to_clip` takes places relative to `origin_m`.
    void draw(std::span<const Triangle> triangles, const Matrix4& to_clip, const Vector3& origin_m) const;

private:
    Program program_;
};

} // namespace duskline::gl
