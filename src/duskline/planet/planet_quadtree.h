#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/planet_camera.h>
#include <duskline/planet/planet_patch.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/planet/tile_cache.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace duskline {

struct PlanetQuadtreeOptions {
    /// Squares of the mesh may be that large in the picture before the next finer level takes over, pixels, above 0; near the
    /// eye, and in small pictures, they are smaller.
    double square_pixels = 4.0;
    /// Tiles in memory at most, 90 KB each; at least 64.
    std::size_t most_tiles = 1500;
    /// Loads what lies around the eye out of view, too, when all that is seen is there: for cameras that turn.
    bool look_around = false;
};

/// Which tiles of a planet are to be drawn for an eye: continuous distance-dependent level of detail over six quadtrees, as
/// LevelOfDetail is for one terrain, with tiles that are loaded as they are needed.
///
///     eye          end of level 3     end of level 2            A tile is split while its box is nearer than the end of
///      o------------------|------------------|-------> distance   the next finer level.
///      |   3   |   3   | 2/3  |     2     | 1/2   |    1
///                       ~~~~~~             ~~~~~~~                ~ meshes turn into their parents'
///
/// Ends lie so far apart that what meets a coarser tile has wholly turned into it, and what meets a finer one has not begun
/// to turn: no cracks. A TILE THAT IS NOT YET LOADED PULLS THE END OF ITS LEVEL, and of finer ones, in before it, so this
/// holds at every moment; as tiles arrive, from near to far and coarse to fine, the ends move out to where they belong.
///
/// Tiles have as many squares near and far, so in small pictures these are smaller than pixels. Where every second, fourth or
/// eighth corner still gives squares of at most two pixels (and of `square_pixels`), patches say so (PlanetPatch::step).
///
/// What the planet itself hides (the horizon, of a globe as low as the lowest ground) and what lies out of view is left out.
class PlanetQuadtree {
public:
    /// `terrain` must outlive it. Throws InvalidInput for options out of range, Cancelled.
    explicit PlanetQuadtree(const PlanetTerrain& terrain, const PlanetQuadtreeOptions& options = {},
                            const Execution& execution = {});

    /// For the next frame, of a picture of that size: loads at most about `most_loads` tiles (in fours) and chooses patches.
    /// Some 0.2 ms, and 5 ms of one thread for each tile that is loaded.
    void update(const PlanetCamera& camera, std::size_t width, std::size_t height, std::size_t most_loads,
                const Execution& execution = {});

    /// What to draw: together they cover all of the planet that may be seen, each place once. Parents are loaded as well.
    const std::vector<PlanetPatch>& patches() const { return patches_; }

    /// Whether all tiles are there that the view wants, or as many as fit into memory.
    bool settled() const { return settled_; }

    /// What may cast shadows into or within a box (stretched towards the light): loaded tiles that reach into it, each place
    /// once, as finely as they are drawn or, out of view, as they happen to be loaded. Squares up to `coarsest_m`, such as a
    /// texel of the shadow map, are fine enough in any case.
    std::vector<PlanetPatch> casters(const OrientedBox& light_box, double coarsest_m = 0.0) const;

    /// Of a tile that is loaded: all of `patches()` and `casters()`, and their ancestors.
    const TileHeights& heights_of(const PlanetTile& tile) const;

    /// The same, to be kept while the tile goes.
    std::shared_ptr<const TileHeights> shared_heights_of(const PlanetTile& tile) const;

    /// Tiles that came and went in the last update, in that order of time; of the first update those of level 0, too.
    const std::vector<TileCache::Change>& changes() const { return cache_.changes(); }

    /// Where each level turns into the next coarser one, now.
    const std::vector<MorphRange>& ranges() const { return ranges_; }

    const TileCache& tiles() const { return cache_; }
    const PlanetTerrain& terrain() const { return terrain_; }

private:
    struct View;
    struct Request {
        PlanetTile parent;
        double distance_m = 0.0;
    };

    double diagonal_m(std::uint32_t level) const;
    std::vector<double> wanted_ends_m(double pixels_per_radian) const;
    void pull_in(const std::vector<double>& missing_from_m, std::vector<double>& ends_m) const;
    bool has_children(const PlanetTile& tile) const;
    void find_missing(const PlanetTile& tile, View& view);
    std::size_t load(View& view, std::size_t most_loads, const Execution& execution);
    void set_ranges(const std::vector<double>& ends_m);
    void select(const PlanetTile& tile, const View& view);
    void add_casters(const PlanetTile& tile, const OrientedBox& light_box, double coarsest_m,
                     std::vector<PlanetPatch>& casters) const;
    PlanetPatch patch_of(const PlanetTile& tile, double distance_m, double coarsest_m) const;
    bool is_split(const PlanetTile& tile, double distance_m) const;

    const PlanetTerrain& terrain_;
    PlanetQuadtreeOptions options_;
    TileCache cache_;
    Vector3 eye_m_;
    double drawn_radians_ = 0.0; ///< that squares may take of the view where corners are skipped
    std::vector<MorphRange> ranges_;
    std::vector<PlanetPatch> patches_;
    bool updated_ = false;
    bool settled_ = false;
};

} // namespace duskline
