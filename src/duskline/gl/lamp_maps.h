#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/shaders/lamp_maps_block.h>
#include <duskline/gl/texture_array.h>
#include <duskline/view/lamp_face.h>
#include <duskline/view/scene_lamp.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace duskline::gl {

/// How maps of lamps are made, and looked up.
struct LampMapOptions {
    std::size_t size = 1024; ///< texels a side of each face, 64 or more; 4 bytes each
    std::size_t taps = 3;    ///< of the kernel, a side: 1 to 5. Edges are ramps as many texels wide
    double slope_offset =
        1.0; ///< polygon offset by slope, 0 or above; 1 is what a surface and its texels differ by at most

    bool operator==(const LampMapOptions&) const = default;
};

/// Draws the depth of everything that a face of a lamp may see into the bound framebuffer: positions by
/// `face_to_clip(face, origin)` relative to that origin, what `may_cast_into(face, ...)` refuses left out. Tests and
/// offset are set.
using DrawLampCasters = std::function<void(const LampFace& face)>;

/// Depth maps of up to `kMostLamps` lamps and searchlights that shine together. Knows nothing of what casts. Look-ups:
/// shaders/lamp_maps.glsl.
///
/// All faces are layers of one texture, six of a lamp and one of a searchlight: 4 MiB each at the usual size, 192 MiB for
/// eight lamps. Depth is reversed (reversed_depth.h): as precise 20 km away as 2 m.
class LampMaps {
public:
    /// Throws InvalidInput for options out of range, UnsupportedOnThisMachine where depth cannot be reversed.
    explicit LampMaps(const LampMapOptions& options = {});

    /// From now on these shine. Draws casters for faces that are new: of lamps that were not there, moved, turned, or got
    /// another half angle or range, and all after `casters_changed`; colours, strengths, and lamps that come back cost
    /// nothing. Says how many. Framebuffer, viewport, program and tests are left as they were. Throws InvalidInput for lamps
    /// out of range and more than `kMostLamps`, and what `draw_casters` throws: then none shines.
    std::size_t update(std::span<const SceneLamp> lamps, const DrawLampCasters& draw_casters);

    /// What casts is no longer what it was: the next `update` draws it again.
    void casters_changed();

    /// Of the last `update`.
    std::span<const SceneLamp> lamps() const { return lamps_; }

    /// What shaders that include lamp_maps.glsl need for positions relative to that eye.
    LampBlock block(const Vector3& eye_m) const;

    /// Puts maps and block where they find them. `buffer` holds the block and must live while they draw.
    void bind(const LampBlock& block, Buffer& buffer) const;

    const LampMapOptions& options() const { return options_; }

private:
    struct Layer {
        std::optional<LampFace> drawn;
        bool wanted = false;
    };

    void make_room(std::size_t faces);
    std::optional<std::size_t> layer_of(const LampFace& face) const;
    std::size_t free_layer() const;
    void draw(std::size_t layer, const LampFace& face, const DrawLampCasters& draw_casters);

    LampMapOptions options_;
    std::vector<SceneLamp> lamps_;
    std::vector<std::vector<std::size_t>> layers_of_lamps_; ///< in the order of their faces
    std::vector<Layer> layers_;
    std::optional<TextureArray> depth_; ///< made when first needed, and for more faces
};

/// The unit of the maps and of the block, which lamp_maps.glsl reads from.
inline constexpr unsigned int kLampMapsUnit = 10;

} // namespace duskline::gl
