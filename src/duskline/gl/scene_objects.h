#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/terrain_renderer.h>
#include <duskline/gl/terrain_textures.h>
#include <duskline/gl/vertex_array.h>
#include <duskline/view/scenery.h>

#include <cstddef>

namespace duskline::gl {

/// Draws a scenery into a picture of its terrain: trees, towers, an aircraft and clouds, each lit as far as
/// `shadow_factor` (shaders/terrain_shadow.glsl) says of its place. They receive the terrain's shadow and cast none
/// themselves. What stands on the ground goes up and down with it.
///
/// Takes texture units 0 and kTerrainShadowUnit, shader storage 0 and the uniform block of terrain_shadow.h, and leaves
/// its own there. Changes depth test, face culling and blending.
class SceneObjects {
public:
    /// Sources and textures must outlive it. Throws ShaderError.
    SceneObjects(const ShaderSources& sources, const TerrainTextures& terrain, Scenery scenery);

    const Scenery& scenery() const { return scenery_; }

    /// Draws into the current framebuffer after the terrain, with the depths of `TerrainRenderer::depths` for this view.
    /// `shadow_heights` are those of the light (r32f, or rg32f for soft edges); without, all is lit.
    void draw(const TerrainView& view, const DepthRange& depth, const TerrainLight& light,
              const Texture* shadow_heights, double seconds);

    /// Takes up changed shader files: see Program::reload_if_changed.
    bool reload_if_changed();

private:
    struct Shape {
        std::size_t first_corner = 0;
        std::size_t corners = 0;
    };

    void set_view(const Program& program, const TerrainView& view, const DepthRange& depth,
                  const TerrainLight& light) const;
    void draw_shape(const Shape& shape, const Buffer& places) const;
    void draw_aircraft(const CirclingAircraft& aircraft, double seconds) const;
    void draw_clouds(const CloudLayer& clouds, double seconds) const;

    const ShaderSources& sources_;
    const TerrainTextures& terrain_;
    Scenery scenery_;
    Program object_program_;
    Program cloud_program_;
    Texture nothing_shades_;
    Buffer shadow_block_;
    Buffer corners_;
    VertexArray shapes_;
    VertexArray no_vertices_;
    Shape tree_;
    Shape tower_;
    Shape aircraft_;
    Buffer trees_;
    Buffer towers_;
};

} // namespace duskline::gl
