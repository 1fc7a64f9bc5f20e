#pragma once

#include <duskline/casting/smap.h>
#include <duskline/gl/program.h>
#include <duskline/gl/texture.h>
#include <duskline/light/directional_light.h>
#include <duskline/terrain/height_field.h>

#include <memory>

namespace duskline::gl {

/// The silhouette map of casting/smap.h (Sakalauskas, Hybrid Terrain Shadow Ray Casting, WSCG 2008) built by passes over
/// textures, for a terrain or a light that moves: for a still one it is built once and looked up in every frame.
///
/// Look-ups are in shaders/smap_shadow.glsl, for any point; `mask` makes one for every cell. Uses texture units 0 to
/// 3, and leaves its own there. Memory: 24 bytes a cell, 8 of them without better_next_v.
class SilhouettePasses {
public:
    /// `options.isa` is of no meaning here. Throws ShaderError.
    explicit SilhouettePasses(const ShaderSources& sources, const SilhouetteMapOptions& options = {});
    SilhouettePasses(SilhouettePasses&&) noexcept;
    SilhouettePasses& operator=(SilhouettePasses&&) noexcept;
    ~SilhouettePasses();

    /// Builds the map. `heights` (r32f, as height_texture makes it) must stay as long as it is asked; `greatest_m` is
    /// no less than the magnitude of any of them: what heights may be wrong by depends on it. Throws InvalidInput for
    /// angles, cell sizes or `greatest_m` out of range.
    /// Cost: O(cells log lines).
    void build(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light, float greatest_m);

    /// Only what mask_by_full_scan needs, for the same arguments: no map, and texels() is of no meaning until the next
    /// build.
    void set_light(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light,
                   float greatest_m);

    /// What was built last: the bits of SilhouetteMap::texels() with the same options, where the card rounds as IEEE 754
    /// wants. For NextVSearch::parallel_quad four lines of a beam lie in one texel of rgba32i, else it is r32i: see
    /// shaders/smap_texels.glsl. Nothing for a light at or below the horizon or straight overhead.
    const Texture* texels() const;

    /// The same laid out as SilhouetteMap::texels(), read back from the card.
    Grid<SilhouetteTexel> read_texels() const;

    /// Looks up every cell: r8, filtered linearly, 0 in shadow, 1 in the light and for no data; 0 everywhere for a light at
    /// or below the horizon. In single precision: a cell whose ray touches the ground within rounding may differ from the
    /// caster's. Throws InvalidInput before the first `build`.
    const Texture& mask();

    /// The same by the full scan of every line, without the map.
    const Texture& mask_by_full_scan();

    /// The share of the map's texels whose section holds a silhouette, which the source calls Black. 0 where there is no
    /// map. Reads the map back.
    double black_share() const;

    /// Puts textures, lines and uniforms where a program that includes smap_shadow.glsl finds them: on three texture units
    /// from `first_unit` on. The program must have been built with the defines of `look_up_defines` for the same unit.
    /// Throws InvalidInput before the first `build` or `set_light`.
    void bind(const Program& program, int first_unit = 0) const;
    std::vector<ShaderDefine> look_up_defines(int first_unit = 0) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace duskline::gl
