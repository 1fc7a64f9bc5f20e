#pragma once

#include "sun_clock.h"
#include "viewer_files.h"
#include "viewer_state.h"

#include <duskline/gl/exact_upload.h>
#include <duskline/gl/scene_objects.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/shadow_technique.h>
#include <duskline/gl/terrain_lamps.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/timer_query.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace duskline::viewer {

/// What a frame cost: by the wall clock, and the graphics card's own time of its passes, that of the frame before unless
/// the work was waited for.
struct FrameCost {
    double ground_ms = 0.0; ///< heights, colours and mesh of ground that has changed; 0 when it has not
    double cast_ms = 0.0;   ///< finding shadows, or going on with it; 0 when they were there
    std::optional<double> cast_gpu_ms;
    std::optional<double> draw_gpu_ms;
    gl::DrawnMesh mesh;
};

/// How long the graphics card takes for a pass that comes with every frame.
struct PassTimer {
    gl::TimerQuery query;
    bool ran = false;
};

/// What a light's course depends on: the day, or the altitude of its circle.
struct CourseAsked {
    std::optional<std::chrono::sys_days> day = {};
    double altitude_deg = 0.0;
    std::size_t maps = 0; ///< 0: no course was asked for

    bool operator==(const CourseAsked&) const = default;
};

/// The terrain on the graphics card and the shadows on it, as a state says. Needs a current OpenGL context.
class Scene {
public:
    /// All three must outlive it.
    Scene(ViewedTerrain& viewed, const SunClock& clock, const gl::ShaderSources& sources);

    /// Brings the ground to where a state has it, and finds the shadows it asks for, unless they are there already: they
    /// are those of the ground that is drawn next, and for a picture of that size. With `wait` the cost is that of the work
    /// itself, else that of giving it to the card.
    FrameCost cast(const ViewerState& state, std::size_t width, std::size_t height, bool wait = false);

    /// Goes on until the shadows asked for last are all there, and prepared what is to be prepared.
    void settle();

    /// How much of that is done, 0 to 1; below 1 the next frame will differ.
    double done() const { return technique_ ? technique_->done() : 1.0; }

    /// Draws a picture of that size into the current framebuffer. Throws UnsupportedOnThisMachine when the context is lost.
    FrameCost draw(const ViewerState& state, std::size_t width, std::size_t height, bool wait = false);

    /// A stroke of a brush at a place in cells; the next cast takes it up.
    void stroke(const GridPoint& at, const Brush& brush);

    /// What the technique says of every cell, and what is true. Waits for the card.
    ShadowMask lit_mask() { return renderer_.lit_mask(technique_->shadow()); }
    const ShadowMask& true_mask();

    /// Of a silhouette map: see ShadowTechnique. Waits for the card.
    std::optional<double> black_share() const { return technique_->black_share(); }

    /// Takes up shader files that have changed on disk.
    bool reload_shaders();

    const HeightField& field() const { return field_; }

private:
    void choose_technique(const ViewerState& state);
    void set_course(const ViewerState& state);
    gl::TerrainLight light_of(const ViewerState& state) const;

    FrameCost cast_changes(const CellRectangle& changed, const DirectionalLight& light, bool view_changed,
                           bool wait);
    void upload_ground(const CellRectangle& changed);
    double cast_for_objects(bool wait);
    double cast_lamps(const ViewerState& state, bool wait);
    const gl::Texture* heights_for_objects() const;

    ViewedTerrain& viewed_;
    const SunClock& clock_;
    const gl::ShaderSources& sources_;
    HeightField field_;
    gl::TerrainTextures textures_;
    gl::TerrainRenderer renderer_;
    Scenery scenery_;                             ///< of the ground as it was first
    std::optional<gl::TerrainLamps> lamps_;       ///< made when first asked for
    std::optional<gl::SceneObjects> objects_;     ///< made when first asked for
    std::optional<gl::ShadowSweep> object_sweep_; ///< for techniques that leave no shadow heights
    const gl::Texture* object_heights_ = nullptr; ///< its own, of the current light and ground
    PassTimer cast_timer_;
    PassTimer draw_timer_;
    std::unique_ptr<gl::ShadowTechnique> technique_;
    std::string technique_name_;
    bool soft_ = false;
    std::string shadow_map_;
    std::optional<DirectionalLight> cast_light_;
    CourseAsked course_asked_;
    std::unique_ptr<gl::ExactUpload> truth_; ///< made when first needed
    std::optional<DirectionalLight> true_light_;
    CellRectangle edited_; ///< and not yet cast
    CellRectangle not_in_truth_;
};

/// A state to begin with: the whole terrain under the light of the options.
ViewerState first_state(const ViewerOptions& options, const ViewedTerrain& viewed, const SunClock& clock);

} // namespace duskline::viewer
