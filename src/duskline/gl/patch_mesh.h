#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/vertex_array.h>
#include <duskline/view/level_of_detail.h>

#include <cstddef>
#include <vector>

namespace duskline::gl {

/// The squares of a patch (view/level_of_detail.h), drawn once for each of many: attribute 0 is a corner's column and row
/// in its patch, 0 to 32, and shader storage 0 holds row, column and level of each, by gl_InstanceID.
class PatchMesh {
public:
    PatchMesh();

    /// Draws with the current program into the current framebuffer. Leaves its own in shader storage 0.
    void draw(const std::vector<MeshPatch>& patches);

    static constexpr std::size_t kTrianglesPerPatch = 2 * kPatchSquares * kPatchSquares;

private:
    VertexArray patch_;
    Buffer corners_;
    Buffer indices_;
    Buffer patches_;
};

} // namespace duskline::gl
