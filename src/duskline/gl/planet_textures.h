#pragma once

#include <duskline/gl/texture_array.h>
#include <duskline/planet/tile_heights.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace duskline::gl {

/// Shadow heights of a planet's tiles: kTileSquares + 1 samples a side, rows along v upwards; null where they are not
/// known. Grids must not change: another answer is another grid.
using ShadowHeightsOf = std::function<std::shared_ptr<const Grid<float>>(const PlanetTile&)>;

/// Tiles of a planet on the graphics card: each has a layer of three texture arrays, for its heights (r32f, with the
/// border), what of them is measured (r8, the same size) and its shadow heights (r32f, without border). Some 160 KB a
/// layer; layers of tiles not used longest are given to new ones.
class PlanetTextures {
public:
    using HeightsOf = std::function<const TileHeights&(const PlanetTile&)>;

    /// `heights_of` is called for tiles that are not yet there. More layers are made when a frame needs them.
    explicit PlanetTextures(HeightsOf heights_of, std::size_t layers = 256);

    /// Makes sure that all of these tiles have layers, until the next call. Throws InvalidInput for more than the
    /// context has layers, and what `heights_of` throws. Cost: some 50 us for a tile that is not there.
    void hold(std::span<const PlanetTile> tiles);

    /// Brings the shadow heights of tiles that are held up to date. Cost: some 50 us for each that has others than before.
    void hold_shadows(std::span<const PlanetTile> tiles, const ShadowHeightsOf& shadow_heights_of);

    /// What was held.
    struct Layer {
        std::int32_t index = 0;
        float reference_m = 0.0f;                            ///< a height amid those of the tile
        std::shared_ptr<const Grid<float>> shadow_heights_m; ///< those that are there; null for none
    };
    const Layer& layer_of(const PlanetTile& tile) const { return slots_.at(tile).layer; }

    /// To be called when a tile's heights have changed: it is read anew when next held.
    void forget(const PlanetTile& tile) { slots_.erase(tile); }

    /// That there is room for.
    std::size_t layers() const { return heights_.layers(); }

    const TextureArray& heights() const { return heights_; }
    const TextureArray& measured() const { return measured_; }
    const TextureArray& shadow_heights() const { return shadow_heights_; }

private:
    struct Slot {
        Layer layer;
        std::uint64_t last_frame = 0;
    };

    void make_room(std::size_t tiles);
    std::int32_t free_layer();
    void load(const PlanetTile& tile);

    HeightsOf heights_of_;
    TextureArray heights_;
    TextureArray measured_;
    TextureArray shadow_heights_;
    std::unordered_map<PlanetTile, Slot> slots_;
    std::uint64_t frame_ = 0;
};

} // namespace duskline::gl
