#pragma once

#include <duskline/casting/terrain_shadows.h>
#include <duskline/gl/mask_upload.h>
#include <duskline/gl/shadow_technique.h>

namespace duskline::gl {

/// The shadows of `exact`, found on the processor (casting/terrain_shadows.h) and uploaded as a mask. After an edit only
/// what can have changed is cast again; the mask is uploaded whole. Cost: the cast and a byte a cell.
class ExactUpload : public ShadowTechnique {
public:
    explicit ExactUpload(const TerrainTextures& terrain);

    void cast(const DirectionalLight& light) override;
    void heights_changed(const CellRectangle& rectangle) override;
    TerrainShadow shadow() const override { return {ShadowLookup::mask, &texture_}; }

    /// The mask that was uploaded.
    const ShadowMask& mask() const { return shadows_.mask(); }

private:
    TerrainShadows shadows_;
    MaskUpload upload_;
    Texture texture_;
};

/// The visible part of the light's disc (casting/visible_fraction.h, by `exact`) of every cell, uploaded in steps of 1
/// in 255. Cost: that of `visible_fraction`, whole after every edit, and a byte a cell.
class SoftExactUpload : public ShadowTechnique {
public:
    explicit SoftExactUpload(const TerrainTextures& terrain);

    void cast(const DirectionalLight& light) override;
    void heights_changed(const CellRectangle&) override { cast(light_); }
    TerrainShadow shadow() const override { return {ShadowLookup::fraction, &texture_}; }

private:
    HeightField field_;
    DirectionalLight light_;
    MaskUpload upload_;
    Texture texture_;
};

} // namespace duskline::gl
