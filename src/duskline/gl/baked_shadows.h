#pragma once

#include <duskline/casting/terrain_shadows.h>
#include <duskline/gl/mask_upload.h>
#include <duskline/gl/shadow_technique.h>

#include <optional>
#include <vector>

namespace duskline::gl {

/// Shadow maps of the lights of a course, found before they are needed (casting/terrain_shadows.h). A light between two
/// of them is shown by both, one turning into the other: right where it stands on one of them, else shadows of two suns.
/// A light beside the course is shown by what is nearest on it. Without a course each light is one itself.
///
/// `cast` makes the one or two maps it needs and has not; `advance` makes the others, at least one a call, those next on
/// the course first. After an edit all are made again. Memory on the card: a byte a cell for each light of the course.
///
/// Source: "12 or 24 different lightmaps" of a day, as tutorials on terrain lightmaps have advised since about 2000;
/// there they are changed when the sky is, here they are blended.
class BakedShadows : public ShadowTechnique {
public:
    explicit BakedShadows(const TerrainTextures& terrain);

    void set_course(const LightCourse& course) override;
    void cast(const DirectionalLight& light) override;
    void heights_changed(const CellRectangle& rectangle) override;
    void advance(std::chrono::microseconds budget) override;
    double done() const override; ///< the share of maps that are there
    TerrainShadow shadow() const override;

private:
    struct Map {
        std::optional<Texture> texture;
        bool is_made = false;
    };

    void make(std::size_t map);

    TerrainShadows shadows_;
    MaskUpload upload_;
    LightCourse course_;
    bool has_course_ = false; ///< else it is the light cast last
    std::vector<Map> maps_;   ///< of the lights of the course
    std::optional<DirectionalLight> light_;
    PlaceOnCourse place_;
};

} // namespace duskline::gl
