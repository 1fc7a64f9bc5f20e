#pragma once

#include <duskline/geometry/cell_rectangle.h>
#include <duskline/gl/buffer.h>
#include <duskline/gl/lamp_maps.h>
#include <duskline/gl/program.h>
#include <duskline/gl/terrain_casters.h>

#include <cstddef>
#include <span>

namespace duskline::gl {

/// Lamps over a terrain, in its shadow (lamp_maps.h): positions in the terrain's frame (view/camera.h). The terrain casts in
/// all its detail; what lies outside the grid casts nothing, and its borders are walls.
class TerrainLamps {
public:
    /// Both must outlive it. Throws ShaderError, and what LampMaps throws.
    TerrainLamps(const ShaderSources& sources, const TerrainTextures& terrain,
                 const LampMapOptions& options = {});

    /// From now on these shine: LampMaps::update.
    std::size_t update(std::span<const SceneLamp> lamps);

    /// To be called when heights have changed in a rectangle, after the textures' own `heights_changed`.
    void heights_changed(const CellRectangle& rectangle);

    /// Whether there are any.
    bool shine() const { return !maps_.lamps().empty(); }

    const LampMaps& maps() const { return maps_; }

    /// For programs that include caster_surface.glsl and lamp_maps.glsl: what they need for places relative to that eye. `unit`
    /// is for the heights.
    void bind(const Program& program, const Vector3& eye_m, unsigned int unit) const;

private:
    TerrainCasters casters_;
    LampMaps maps_;
    mutable Buffer block_;
};

} // namespace duskline::gl
