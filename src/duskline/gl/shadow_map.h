#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/shader_sources.h>
#include <duskline/gl/shaders/shadow_map_block.h>
#include <duskline/gl/texture.h>
#include <duskline/view/shadow_box.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace duskline::gl {

/// How a shadow map is looked up.
enum class ShadowMapFilter {
    none,    ///< one tap
    kernels, ///< 5 x 5 taps near the eye, then 4 x 4, 3 x 3, 2 x 2 and one
    disc,    ///< 4 to 16 points of a Poisson disc of the same width, turned at random from place to place
    moments, ///< one tap into a map of mean depths, filtered in rows and columns when it is drawn
};

/// Which faces of casters are drawn.
enum class CasterFaces {
    all,
    away_from_light, ///< reversed winding: what is lit is not in the map, so it cannot shade itself
};

/// Colours laid over a picture to see what the map does.
enum class ShadowMapOverlay {
    none,
    kernels,  ///< 5 x 5 green, 4 x 4 yellow, 3 x 3 orange, 2 x 2 red, one tap blue
    fade,     ///< red where shadows fade at the border
    penumbra, ///< red where a place is partly lit, green in full shadow
    box,      ///< yellow what the box holds, paler beyond the radius
};

/// How a shadow map is made, and looked up. Lengths in metres.
struct ShadowMapOptions {
    std::size_t size = 4096; ///< texels a side, 64 or more; 4 bytes each, 20 with `moments`
    ShadowMapFilter filter = ShadowMapFilter::kernels;
    bool linear_compare =
        true; ///< the sampler compares four texels and weighs the answers; not with `moments`
    bool penumbra_only = false; ///< kernels and disc: four taps first, the others only where these disagree
    std::size_t samples = 8;    ///< of the disc, 4 to 16
    double spread = 1.0;        ///< texels from tap to tap; above 0, gaps show from about 2 on
    double slope_offset =
        1.0; ///< polygon offset by slope, 0 or above; 1 is what a surface and its texels differ by at most
    CasterFaces faces = CasterFaces::all;
    double reach = 12.0; ///< radius of shadows over clearance, above 0: see ShadowBoxFollower
    double wide_reach =
        0.0; ///< that of a second map around the first, of the same size, above `reach`; 0 for none
    double fade_from_m = 5e4; ///< clearances between which all shadows fade, until they are not drawn at all
    double fade_to_m = 1e5;   ///< above `fade_from_m`
    double farthest_caster_m = 5e5; ///< in front of the box; farther ones are left out

    bool operator==(const ShadowMapOptions&) const = default;
};

/// What changes from picture to picture.
struct ShadowMapLook {
    double overcast =
        0.0; ///< 0 clear sky, 1 overcast: edges up to three times as wide, shadows down to a tenth
    ShadowMapOverlay overlay = ShadowMapOverlay::none;
};

/// Draws the depth of everything that may cast a shadow into a box, into the bound framebuffer: positions by
/// `box_to_clip(box, origin)` relative to that origin, what `may_cast_into(box, ...)` refuses left out, no finer than
/// `box.texel_m` is worth. Depth test, depth clamp, offset and culling are set; counter-clockwise faces are the front.
using DrawCasters = std::function<void(const ShadowBox& box)>;

/// Depth maps of parallel light for shadows around a viewer: the technique of Shadow mapping on large terrain, Organic
/// Vectory. Knows nothing of what casts. Look-ups: shaders/shadow_map.glsl.
class ShadowMap {
public:
    /// Throws InvalidInput for options out of range, ShaderError.
    ShadowMap(const ShaderSources& sources, const ShadowMapOptions& options = {});
    ~ShadowMap();

    /// Brings the maps up to date for a view: draws casters where a box has moved, grown or turned, or after
    /// `casters_changed`. Says in how many maps. Framebuffer, viewport, program and tests are left as they were.
    std::size_t update(const ShadowView& view, const DrawCasters& draw_casters);

    /// What casts is no longer what it was: the next `update` draws it again.
    void casters_changed();

    /// Shaders that include shadow_map.glsl take these.
    std::vector<ShaderDefine> defines() const;

    /// What such shaders need for positions relative to that eye, after `update`.
    ShadowMapBlock block(const Vector3& eye_m, const ShadowMapLook& look = {}) const;

    /// Puts maps and block where they find them. `buffer` holds the block and must live while they draw.
    void bind(const ShadowMapBlock& block, Buffer& buffer) const;

    /// The box and map next to the eye, of the last `update`.
    const ShadowBox& box() const;
    const Texture& depth() const;
    /// That of the wide map; the same without one.
    const ShadowBox& widest_box() const;

    const ShadowMapOptions& options() const { return options_; }

private:
    struct Part;

    void draw(Part& part, const DrawCasters& draw_casters) const;

    ShadowMapOptions options_;
    std::array<BlockVec4, 8> disc_;
    double strength_ = 1.0;
    std::vector<std::unique_ptr<Part>> parts_; ///< near, and wide
};

/// The unit of the first map, that of the second follows, and of the block, which shadow_map.glsl reads from.
inline constexpr unsigned int kShadowMapUnit = 8;

/// `count` points of the disc of radius 1 that keep apart from each other, and so do the first few of them: each is the
/// one of many random ones that lies farthest from those before. Same points every time. Source: D. Mitchell,
/// Spectrally optimal sampling for distribution ray tracing, SIGGRAPH 1991 (best candidates).
std::vector<std::array<float, 2>> poisson_disc(std::size_t count);

} // namespace duskline::gl
