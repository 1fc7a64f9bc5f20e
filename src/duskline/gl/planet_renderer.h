#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/lamp_maps.h>
#include <duskline/gl/planet_textures.h>
#include <duskline/gl/program.h>
#include <duskline/gl/shadow_map.h>
#include <duskline/gl/vertex_array.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/planet_patch.h>
#include <duskline/view/camera.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace duskline::gl {

/// The light of a picture of a planet, and what its ground is like. Colours are light, red, green and blue.
struct PlanetLight {
    Vector3 to_sun = {1.0, 0.0, 0.0}; ///< unit vector in the planet's frame
    std::array<float, 3> sun_colour = {1.0f, 1.0f, 1.0f};
    Angle sun_radius = Angle::from_degrees(0.2666); ///< of the disc that is seen
    float ambient = 0.25f; ///< light of level ground in shadow, 1 in the light; 0 to below 1
    float exposure = 1.0f; ///< above 0
    bool air = true;       ///< sky, haze and dusk; else black, and dark where no sun is
    bool living = true;    ///< water, plants and snow; else dust
    const LampMaps* lamps =
        nullptr; ///< that shine beside the sun, positions in the planet's frame; casters by `draw_depth`
};

/// From where, and how large.
struct PlanetView {
    Vector3 eye_m;   ///< in the planet's frame
    CameraAxes axes; ///< in the planet's frame
    Angle vertical_view = Angle::from_degrees(45.0);
    std::size_t width = 1024; ///< of the picture, pixels
    std::size_t height = 768;
    bool show_made = false; ///< mark ground that no file has measured
};

/// Where the shadows of a picture come from: a shadow map, else shadow heights of tiles, else nowhere: then only ground that
/// faces away from the sun is dark.
struct PlanetShadow {
    TileShadowsOf shadows_of = {};
    bool of_disc = false; ///< these have two heights each, between which the sun's disc is seen in part
    const ShadowMap* map = nullptr; ///< brought up to date for this view and sun, its casters by `draw_depth`
    ShadowMapLook look = {};        ///< of the map
};

/// What was drawn.
struct DrawnPlanet {
    std::size_t tiles = 0;
    std::size_t triangles = 0;
};

/// Draws planets: a mesh of tiles, everything relative to the eye so that a step and a planet fit into one picture, under
/// a sun and a sky.
///
/// Draw into a Framebuffer with depth32f (see gl/reversed_depth.h). Takes texture units 0 to 3 and shader storage 0, with a
/// shadow map or lamps those of them too, and leaves its own there.
class PlanetRenderer {
public:
    /// `sources` must outlive it. Throws ShaderError, InvalidInput for radii that are wrong, and UnsupportedOnThisMachine
    /// where depth cannot be reversed.
    PlanetRenderer(const ShaderSources& sources, const Globe& globe, PlanetTextures::HeightsOf heights_of);

    /// Takes these tiles and their parents to the card, ahead of drawing them. Throws what `PlanetTextures::hold` throws.
    void hold(std::span<const PlanetPatch> patches) { hold(patches, {}); }

    /// Draws into the current framebuffer, whose size is the view's, over what is there; depth is cleared. Tiles on which
    /// others lie must not be among them; the parents of all are asked for too. Throws ShaderError, and what
    /// `PlanetTextures::hold` throws. Cost: vertices and pixels, and some 50 us for each tile that is new on the card.
    DrawnPlanet draw(const PlanetView& view, const PlanetLight& light, std::span<const PlanetPatch> patches,
                     const PlanetShadow& shadow = {});

    /// The ground alone, without sky or sun behind it.
    DrawnPlanet draw_ground(const PlanetView& view, const PlanetLight& light,
                            std::span<const PlanetPatch> patches, const PlanetShadow& shadow = {});

    /// What there is to know of every pixel of ground instead of its colour, into a framebuffer of rgba32f: its place relative to
    /// the eye, metres, axes planet-fixed, and how much light the shadows let through, 0 to 1; -1 on ground that faces away.
    DrawnPlanet probe_ground(const PlanetView& view, const PlanetLight& light,
                             std::span<const PlanetPatch> patches, const PlanetShadow& shadow = {});

    /// The same with how much of a lamp of the light's (by its number there) is to be seen from there instead, 0 to 1; -1 where it
    /// would light nothing anyway: on what faces away, beside its beam, beyond its range.
    DrawnPlanet probe_lamp(const PlanetView& view, const PlanetLight& light,
                           std::span<const PlanetPatch> patches, std::size_t lamp);

    /// Draws the depth of the same mesh as a light sees it, into the current framebuffer with the depth test as it is:
    /// `to_clip` takes places relative to the eye, axes planet-fixed, to the light's clip space.
    DrawnPlanet draw_depth(const Vector3& eye_m, const Matrix4& to_clip,
                           std::span<const PlanetPatch> patches);

    /// Layers that there is room for on the card (see PlanetTextures for what they take).
    std::size_t layers() const { return textures_.layers(); }

    /// To be called when a tile's heights have changed.
    void forget(const PlanetTile& tile) { textures_.forget(tile); }

    /// Takes up changed shader files: see Program::reload_if_changed.
    bool reload_if_changed();

private:
    struct Asked;
    struct Mesh {
        std::uint32_t step;
        std::size_t first_index;
        std::size_t indices;
    };

    const Program& ground_program(const PlanetLight& light, const PlanetShadow& shadow, const Asked& asked);
    DrawnPlanet draw_with(const Asked& asked, const PlanetView& view, const PlanetLight& light,
                          std::span<const PlanetPatch> patches, const PlanetShadow& shadow);
    void hold(std::span<const PlanetPatch> patches, const PlanetShadow& shadow);
    DrawnPlanet draw_patches(const Program& program, const Vector3& eye_m,
                             std::span<const PlanetPatch> patches);
    void upload_tiles(const Vector3& eye_m, std::span<const PlanetPatch> patches);
    void set_surface(const Program& program) const;
    void set_air(const Program& program, const Vector3& eye_m, const PlanetLight& light) const;
    void draw_sky(const PlanetView& view, const PlanetLight& light);

    const ShaderSources& sources_;
    Globe globe_;
    PlanetTextures textures_;
    std::map<std::vector<std::string>, Program>
        ground_programs_; ///< by the values of their defines, when first needed
    Program depth_;
    Program sky_;
    VertexArray no_vertices_;
    VertexArray patch_;
    Buffer corners_;
    Buffer indices_;
    Buffer tiles_;
    Buffer shadow_map_block_;
    Buffer lamp_block_;
    std::vector<Mesh> meshes_; ///< of a patch, by its step
};

} // namespace duskline::gl
