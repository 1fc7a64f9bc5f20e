#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/planet/planet_tile.h>
#include <duskline/planet/tile_heights.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace duskline {

/// A tile that is loaded, and where its ground is.
struct LoadedTile {
    std::shared_ptr<const TileHeights> heights;
    OrientedBox box; ///< around its ground, its parent's there, and what of finer levels can stick out
    Vector3 stretched_middle;      ///< direction, where the globe is stretched to a sphere
    double stretched_radius = 0.0; ///< angle from the middle to the farthest corner there, radians
    double highest = 0.0;          ///< of its ground from the centre there, 1 at height 0
    std::uint64_t last_used = 0;   ///< frame
};

/// The tiles of a planet that are in memory, never more than a number of them: those not used for longest go first.
/// Ancestors of a tile are there as long as it is.
class TileCache {
public:
    /// Loads the six tiles of level 0, which stay. `terrain` must outlive it. At least 64 tiles (else InvalidInput).
    TileCache(const PlanetTerrain& terrain, std::size_t most_tiles, const Execution& execution = {});

    /// Null when it is not there. Stays where it is until it goes.
    const LoadedTile* find(const PlanetTile& tile) const;

    /// Tiles used from now on, and what is loaded, are not thrown out before the next call.
    void begin_frame();

    /// Tiles that have come, and gone, since the frame began, in that order of time; one may go and come again. Before the first frame those of
    /// level 0 have come.
    struct Change {
        PlanetTile tile;
        bool came = true;
    };
    const std::vector<Change>& changes() const { return changes_; }

    /// Of a tile that is there, whose parent has been used.
    const LoadedTile& use(const PlanetTile& tile);

    /// Loads the children of tiles that are there, on several threads, in the order given while there is room. How many
    /// tiles have been loaded. About 5 ms each.
    std::size_t load_children(std::span<const PlanetTile> parents, const Execution& execution = {});

    std::size_t size() const { return tiles_.size(); }
    std::size_t most_tiles() const { return most_tiles_; }
    std::size_t bytes() const; ///< of all heights

    /// The longest diagonal of the boxes of a level that were ever there, metres; 0 when none was.
    double longest_diagonal_m(std::uint32_t level) const { return longest_diagonal_m_[level]; }

private:
    std::unique_ptr<LoadedTile> loaded(const PlanetTile& tile) const;
    void add(const PlanetTile& tile, std::unique_ptr<LoadedTile> loaded);
    bool make_room(std::size_t tiles);

    const PlanetTerrain& terrain_;
    std::size_t most_tiles_;
    std::uint64_t frame_ = 1;
    std::unordered_map<PlanetTile, std::unique_ptr<LoadedTile>> tiles_;
    std::array<double, kDeepestTileLevel + 1> longest_diagonal_m_ = {};
    std::vector<Change> changes_;
};

} // namespace duskline
