#pragma once

#include <duskline/gl/patch_mesh.h>
#include <duskline/gl/program.h>
#include <duskline/gl/terrain_textures.h>
#include <duskline/view/lamp_face.h>
#include <duskline/view/level_of_detail.h>
#include <duskline/view/shadow_box.h>

#include <cstddef>
#include <vector>

namespace duskline::gl {

/// Draws a terrain into shadow maps: its depth alone, in one level of detail all over, so that there are no cracks and
/// nothing changes with the eye, and walls under its borders, as light comes in beside it. Cells without data take part
/// as the mean of what is around them, unless there is nothing else in a patch.
class TerrainCasters {
public:
    /// Both must outlive it. Throws ShaderError.
    TerrainCasters(const ShaderSources& sources, const TerrainTextures& terrain);

    /// For ShadowMap::update. Takes texture unit 0.
    void draw(const ShadowBox& box);

    /// For LampMaps::update: in all detail, from cell to cell. Takes texture unit 0.
    void draw(const LampFace& face);

    /// To be called when heights have changed in a rectangle, after the textures' own `heights_changed`.
    void heights_changed(const CellRectangle& rectangle) { detail_.heights_changed(rectangle); }

    /// Cells from corner to corner of the mesh for a box: as many as there may be for heights to be right to a quarter of a texel.
    std::size_t step(const ShadowBox& box) const { return std::size_t{1} << level(box); }

    /// Sets what caster_place.glsl needs for places relative to `origin_m`, in a program that includes it, and binds the
    /// heights to a texture unit.
    void set_places(const Program& program, const Vector3& origin_m, unsigned int unit) const;

    /// Of all ground.
    HeightRange heights() const { return detail_.heights(); }

private:
    std::size_t level(const ShadowBox& box) const;
    void draw(std::size_t level, const std::vector<MeshPatch>& patches, const Matrix4& to_clip,
              const Vector3& origin_m, double hang_m);
    void draw_skirt(std::size_t step) const;

    const TerrainTextures& terrain_;
    LevelOfDetail detail_;
    Program ground_;
    Program skirt_;
    PatchMesh mesh_;
    VertexArray no_vertices_;
};

} // namespace duskline::gl
