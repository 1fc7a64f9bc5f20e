#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/shadow_map.h>
#include <duskline/gl/shadow_technique.h>
#include <duskline/gl/terrain_casters.h>

namespace duskline::gl {

/// The shadows of a terrain by a shadow map that goes with the viewer (shadow_map.h): right near the eye, and none beyond
/// the map's radius. Until it is told where the eye is, the map holds the whole terrain.
class TerrainShadowMap : public ShadowTechnique {
public:
    /// Both must outlive it. Throws ShaderError, and InvalidInput for options out of range.
    TerrainShadowMap(const ShaderSources& sources, const TerrainTextures& terrain,
                     const ShadowMapOptions& options = {});

    bool look_from(const TerrainView& view) override;
    void cast(const DirectionalLight& light) override;
    void heights_changed(const CellRectangle& rectangle) override;
    TerrainShadow shadow() const override;
    void set_look(const ShadowMapLook& look) override { look_ = look; }

    const ShadowMap& map() const { return map_; }

    /// What places are relative to in programs it was bound for.
    const Vector3& eye_m() const { return view_.eye_m; }

    /// For programs that include terrain_shadow_map.glsl: what they are built with, and what they need. `unit` is for
    /// the heights.
    std::vector<ShaderDefine> look_up_defines() const { return map_.defines(); }
    void bind(const Program& program, unsigned int unit) const;

private:
    ShadowView whole_terrain() const;

    const TerrainTextures& terrain_;
    TerrainCasters casters_;
    ShadowMap map_;
    ShadowMapLook look_;
    ShadowView view_;
    bool lit_ = false; ///< by a light above the horizon
    mutable Buffer block_;
};

} // namespace duskline::gl
