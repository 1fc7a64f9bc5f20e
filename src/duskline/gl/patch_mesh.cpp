#include <duskline/gl/patch_mesh.h>

#include <cstdint>

namespace duskline::gl {

namespace {

std::vector<float> patch_corners()
{
    std::vector<float> corners;
    for (std::size_t row = 0; row <= kPatchSquares; ++row)
        for (std::size_t column = 0; column <= kPatchSquares; ++column) {
            corners.push_back(static_cast<float>(column));
            corners.push_back(static_cast<float>(row));
        }
    return corners;
}

// Two triangles a square, counter-clockwise from above.
std::vector<std::uint32_t> patch_indices()
{
    std::vector<std::uint32_t> indices;
    constexpr auto line = static_cast<std::uint32_t>(kPatchSquares) + 1;
    for (std::uint32_t row = 0; row < kPatchSquares; ++row)
        for (std::uint32_t column = 0; column < kPatchSquares; ++column) {
            const std::uint32_t north_west = row * line + column;
            const std::uint32_t south_west = north_west + line;
            indices.insert(indices.end(), {north_west, south_west, south_west + 1});
            indices.insert(indices.end(), {north_west, south_west + 1, north_west + 1});
        }
    return indices;
}

} // namespace

PatchMesh::PatchMesh()
{
    corners_.upload(patch_corners());
    indices_.upload(patch_indices());
    patch_.set_floats(0, corners_, 2, 2 * sizeof(float));
    patch_.set_indices(indices_);
}

void PatchMesh::draw(const std::vector<MeshPatch>& patches)
{
    patches_.upload(patches);
    patches_.bind_as_storage(0);
    patch_.draw_indexed(VertexArray::Shape::triangles, 0, 3 * kTrianglesPerPatch, patches.size());
}

} // namespace duskline::gl
