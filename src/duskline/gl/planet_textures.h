#pragma once

#include <duskline/gl/texture_array.h>
#include <duskline/planet/planet_shadows.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace duskline::gl {

/// The shadows on a planet's tiles, null where they are not known; of one disc, or all of none. They must not change: another
/// answer is another object.
using TileShadowsOf = std::function<ShownShadow(const PlanetTile&)>;

/// Tiles of a planet on the graphics card: each has a layer of texture arrays, for its heights (r32f, with the border),
/// what of them is measured (r8, the same size) and, when there are shadows, its shadow heights without border: r32f, of a disc
/// rg32f; once, or when the sun has moved twice.
///
/// A layer takes 90 KB and for each sun 67 KB, of a disc 133 KB: 157 KB to 356 KB. Layers of tiles not used longest are given to
/// new ones.
class PlanetTextures {
public:
    using HeightsOf = std::function<const TileHeights&(const PlanetTile&)>;

    /// `heights_of` is called for tiles that are not yet there. More layers are made when a frame needs them.
    explicit PlanetTextures(HeightsOf heights_of, std::size_t layers = 256);

    /// Makes sure that all of these tiles have layers, until the next call. Throws InvalidInput for more than the
    /// context has layers, and what `heights_of` throws. Cost: some 50 us for a tile that is not there.
    void hold(std::span<const PlanetTile> tiles);

    /// Brings the shadows of tiles that are held up to date; of a disc with two heights. Cost: some 50 us for each that has
    /// others than before, all of them when `of_disc` changes.
    void hold_shadows(std::span<const PlanetTile> tiles, const TileShadowsOf& shadows_of, bool of_disc);

    /// What was held.
    struct Layer {
        std::int32_t index = 0;
        float reference_m = 0.0f;                                 ///< a height amid those of the tile
        std::array<std::shared_ptr<const TileShadow>, 2> shadows; ///< those that are there; null for none
        float share_of_second = 0.0f;

        bool has_shadow() const { return shadows[0] != nullptr || shadows[1] != nullptr; }
    };
    const Layer& layer_of(const PlanetTile& tile) const { return slots_.at(tile).layer; }

    /// To be called when a tile's heights have changed: it is read anew when next held.
    void forget(const PlanetTile& tile) { slots_.erase(tile); }

    /// That there is room for.
    std::size_t layers() const { return heights_.layers(); }

    const TextureArray& heights() const { return heights_; }
    const TextureArray& measured() const { return measured_; }
    /// The first and second of a layer's shadows; null where there have been none.
    const TextureArray* shadows(std::size_t slot) const
    {
        return shadows_.at(slot) ? &*shadows_.at(slot) : nullptr;
    }

private:
    struct Slot {
        Layer layer;
        std::uint64_t last_frame = 0;
    };

    void make_room(std::size_t tiles);
    std::int32_t free_layer();
    void load(const PlanetTile& tile);
    void hold_shadow(Layer& layer, const ShownShadow& shown);
    void put_shadow(Layer& layer, std::size_t slot, const std::shared_ptr<const TileShadow>& shadow);

    HeightsOf heights_of_;
    TextureArray heights_;
    TextureArray measured_;
    std::array<std::optional<TextureArray>, 2> shadows_; ///< made when first needed
    bool of_disc_ = false;
    std::unordered_map<PlanetTile, Slot> slots_;
    std::uint64_t frame_ = 0;
};

} // namespace duskline::gl
