#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/planet_source.h>
#include <duskline/planet/planet_tile.h>
#include <duskline/planet/source_levels.h>
#include <duskline/planet/tile_heights.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace duskline {

struct PlanetTerrainOptions {
    /// The planet has a sea: ground below 0 is drawn as its surface, at 0.
    bool sea = true;
    /// Made-up detail as a multiple of what the roughness around suggests; 0 or above, 0: none.
    double detail = 1.0;
    /// The deepest level is the first with samples at most that far apart; above 0.
    double finest_spacing_m = 2.0;
    /// Cells over which a source blends into the next coarser one.
    std::size_t border_cells = 24;
    std::uint64_t seed = 1;
};

/// The ground of a planet at every level of detail, from sources of several resolutions.
///
///   coarse  ----.                                     Where sources overlap the last given wins, blended over its border.
///   fine         `--[==========]--                    Levels coarser than a source take means of its blocks of cells,
///   made up         ~~~~~~~~~~~~                      levels finer than it interpolate and add made-up detail.
///
/// Where there are no sources the ground is at 0. Detail is made up at features smaller than two cells of the source; its
/// height follows from how rough the source is around the place, growing less than slopes do towards small features, and
/// it is marked (`TileHeights::measured`). There is none on the sea, and near the shore it fades out.
///
/// Heights depend on direction and level alone: tiles agree on the samples they share bit for bit, over the edges of the
/// cube too. Safe to use from several threads.
class PlanetTerrain {
public:
    /// `sources` from coarse to fine. Throws InvalidInput for a globe, source or option out of range, and Cancelled.
    PlanetTerrain(const Globe& globe, std::vector<PlanetSource> sources,
                  const PlanetTerrainOptions& options = {}, const Execution& execution = {});

    const Globe& globe() const { return globe_; }

    /// Tiles of deeper levels than this show nothing new.
    std::uint32_t deepest_level() const { return deepest_level_; }

    /// All ground lies within, made-up detail included.
    HeightRange heights() const { return range_; }

    /// How far the ground of deeper levels may lie from a level's own at the same place: a bound for all places, but for the
    /// borders of sources that disagree.
    double relief_below_m(std::uint32_t level) const;

    /// The ground of a tile, of level deepest_level() or above. The same tile, the same bytes. About 5 ms.
    TileHeights heights_of(const PlanetTile& tile) const;

    /// The ground in a direction (unit vector) as tiles of a level have it. About a microsecond.
    float height_m(const Vector3& direction, std::uint32_t level) const;

private:
    struct Source {
        SourceLevels levels;
        std::array<std::size_t, kDeepestTileLevel + 1>
            blocks;                                      ///< the level of means that a level of tiles takes
        std::array<double, kDeepestTileLevel + 1> bands; ///< height of the made-up bands over the roughness
    };
    struct Sampler;

    Source prepared(PlanetSource source, const Execution& execution) const;
    void find_range();

    Globe globe_;
    PlanetTerrainOptions options_;
    std::uint32_t deepest_level_ = 0;
    std::uint32_t first_band_ = 0; ///< of made-up detail; beyond the deepest level when there is none
    std::vector<Source> sources_;
    HeightRange range_;
};

} // namespace duskline
