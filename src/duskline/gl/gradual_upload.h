#pragma once

#include <duskline/casting/gradual_shadows.h>
#include <duskline/gl/mask_upload.h>
#include <duskline/gl/shadow_technique.h>

#include <array>

namespace duskline::gl {

/// The shadows of `strider`, made on the processor a part in every frame (casting/gradual_shadows.h): while one mask is
/// shown the next is made, and when it is whole the two change places. Each mask is of the light that was cast last when
/// it was begun, so shadows lag behind a light that moves by as long as a mask takes, or two. The first is made at once.
///
/// After an edit the mask under way is finished, partly of old ground, and another one begun. Cost in a frame: what
/// `advance` is told, and a byte a cell when a mask is finished. Memory: 3 bytes a cell, and 2 on the card.
///
/// Source: M. Strahan, Real-Time Heightmap Self-Shadowing Using the Strider Technique, 2004, "Gradual updating".
class GradualUpload : public ShadowTechnique {
public:
    explicit GradualUpload(const TerrainTextures& terrain);

    void cast(const DirectionalLight& light) override;
    void heights_changed(const CellRectangle& rectangle) override;
    void advance(std::chrono::microseconds budget) override;
    double done() const override;
    TerrainShadow shadow() const override { return {ShadowLookup::mask, &textures_.at(shown_)}; }

private:
    void show_finished();

    GradualShadows shadows_;
    double lines_;
    DirectionalLight wanted_;
    bool is_late_ =
        false; ///< what is shown or under way is not of the light or the ground that it should be of
    MaskUpload upload_;
    std::array<Texture, 2> textures_; ///< one may still be drawn with while the other is filled
    std::size_t shown_ = 0;
};

} // namespace duskline::gl
