#pragma once

#include <duskline/casting/terrain_shadows.h>
#include <duskline/gl/shadow_technique.h>

#include <cstdint>
#include <vector>

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
    void upload();

    TerrainShadows shadows_;
    Grid<std::uint8_t> bytes_;
    Texture texture_;
};

} // namespace duskline::gl
