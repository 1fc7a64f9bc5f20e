#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/gl/patch_mesh.h>
#include <duskline/gl/program.h>
#include <duskline/gl/shadow_lookup.h>
#include <duskline/gl/terrain_textures.h>
#include <duskline/gl/vertex_array.h>
#include <duskline/light/directional_light.h>
#include <duskline/view/camera.h>
#include <duskline/view/level_of_detail.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>

namespace duskline::gl {

class TerrainLamps;

/// The light of a picture of a terrain, and how it is shown. Colours are light, red, green and blue.
struct TerrainLight {
    DirectionalLight light;
    std::array<float, 3> sun_colour = {1.0f, 1.0f, 1.0f};
    std::array<float, 3> sky_light = {1.0f, 1.0f, 1.0f};
    float ambient = 0.28f;               ///< light of level ground in shadow, 1 in the light; 0 to below 1
    float exposure = 1.0f;               ///< above 0
    float exaggeration = 1.0f;           ///< slopes are shaded as if that many times as steep; above 0
    bool air = true;                     ///< a blue sky and haze; else black
    const TerrainLamps* lamps = nullptr; ///< that shine beside the sun, brought up to date
};

/// From where, and how large and how fine.
struct TerrainView {
    Camera camera;
    std::size_t width = 1024; ///< of the picture, pixels
    std::size_t height = 768;
    double pixel_error = 1.5; ///< what the mesh may be wrong by; above 0
    HeightRange others = {};  ///< of what else is drawn with the terrain and shares its depths
};

/// What was drawn.
struct DrawnMesh {
    std::size_t patches = 0;
    std::size_t triangles = 0;
};

/// Draws terrains in perspective: a mesh as fine as the picture needs (view/level_of_detail.h) under a sun and a sky as
/// in products/relief.h, in shadows that some technique has found.
///
/// Takes texture units 0 to 10, shader storage 0 and, for shadow maps and lamps, uniform blocks 8 and 10, and leaves its own there. Changes
/// depth test and face culling.
class TerrainRenderer {
public:
    /// Both must outlive it. Throws ShaderError.
    TerrainRenderer(const ShaderSources& sources, const TerrainTextures& terrain);

    /// To be called when heights have changed in a rectangle, after the textures' own `heights_changed`.
    void heights_changed(const CellRectangle& rectangle) { detail_.heights_changed(rectangle); }

    /// Draws into the current framebuffer, whose size is the view's, over what is there: the sky first. With a `truth`,
    /// a mask (r8), cells are marked in which the shadows differ from it: red where they are missing, blue where there
    /// are too many. Throws ShaderError.
    DrawnMesh draw(const TerrainView& view, const TerrainLight& light, const TerrainShadow& shadow,
                   const Texture* truth = nullptr);

    /// The terrain alone, without what is behind it.
    DrawnMesh draw_terrain(const TerrainView& view, const TerrainLight& light, const TerrainShadow& shadow,
                           const Texture* truth = nullptr);

    /// From the lowest to the highest ground, by the last `heights_changed`.
    HeightRange heights() const { return detail_.heights(); }

    /// The depths that such a view is drawn with, for whatever else is drawn into it.
    DepthRange depths(const TerrainView& view) const;

    /// What the shadows say of every cell, as `draw` shows it. `unknown` where there are no data. Waits for the card.
    ShadowMask lit_mask(const TerrainShadow& shadow);

    /// Takes up changed shader files: see Program::reload_if_changed.
    bool reload_if_changed();

private:
    /// Built when first needed.
    const Program& program(const char* vertex_stage, const char* fragment_stage, const TerrainShadow& shadow,
                           const TerrainLamps* lamps = nullptr);
    void draw_sky(const TerrainView& view, const TerrainLight& light);
    void set_lookup(const Program& program, const TerrainShadow& shadow, double shadow_drop_m) const;

    const ShaderSources& sources_;
    const TerrainTextures& terrain_;
    LevelOfDetail detail_;
    std::map<std::string, Program> programs_;
    Program sky_;
    VertexArray no_vertices_;
    PatchMesh mesh_;
};

} // namespace duskline::gl
