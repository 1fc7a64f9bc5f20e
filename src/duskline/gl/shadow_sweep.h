#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/texture.h>
#include <duskline/light/directional_light.h>
#include <duskline/terrain/height_field.h>

#include <cstddef>
#include <optional>

namespace duskline::gl {

/// How a ShadowSweep works.
struct ShadowSweepOptions {
    /// Instead of one height of shadow for the centre of the light's disc two, for soft edges. Above the second all of
    /// the disc is seen: it is the shadow height of the disc's lower edge, or of light along the horizontal while the
    /// disc sinks through that. Below the first nothing is seen: it is the shadow height of the upper edge, but where
    /// the ground sees some of the disc, that of the ground which hides the lower edge alone.
    bool limbs = false;
    /// How many lines one invocation carries a beam over: fewer keep more of a large card busy, and cost more in
    /// between. A multiple of 32. No result depends on it.
    std::size_t lines_per_segment = 128;
};

/// Shadow heights of a terrain by the sweep (casting/sweep.h), in a few compute passes: some milliseconds of a
/// graphics card, for a light that moves with every frame.
///
/// The texture has a texel for each cell, r32f or, with limbs, rg32f. Texels hold what `shadow_heights_by_sweep` says
/// of the light: bit for bit, where the card rounds sums and products as IEEE 754 wants (OpenGL asks for that). Minus infinity where nothing towards the light is in the way, plus infinity where the light
/// is at or below the horizon, NaN for no data.
///
/// Uses texture unit 0, image unit 0 and shader storage 0 and 1, and leaves its own there.
class ShadowSweep {
public:
    /// Throws InvalidInput for lines per segment that are no multiple of 32, ShaderError.
    explicit ShadowSweep(const ShaderSources& sources, const ShadowSweepOptions& options = {});

    /// Casts a light over heights (r32f, as Texture::upload takes those of a HeightField). The texture returned is
    /// this object's own: the next call changes it, and makes it anew when the size has changed. Throws InvalidInput
    /// for angles or cell sizes out of range.
    /// Cost: O(cells).
    const Texture& cast(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light);

    /// Takes up changed shader files: see Program::reload_if_changed.
    bool reload_if_changed(const ShaderSources& sources);

private:
    void make_room(const Texture& heights, std::size_t fronts);

    ShadowSweepOptions options_;
    Program segments_;
    Program fronts_pass_;
    Program answers_;
    Buffer shifts_;
    Buffer fronts_;
    std::optional<Texture> shadow_heights_;
};

} // namespace duskline::gl
