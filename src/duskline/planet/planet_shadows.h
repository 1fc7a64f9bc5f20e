#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/planet_front.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace duskline {

/// The shadows of a planet: shadow heights of all tiles that are there, of all levels, kept up to date while tiles come and
/// go and the sun moves.
///
///     level 3   [sun] -> A -> B -> C      coarse before fine, and of a level those nearer to the sun first:
///                         |                every tile begins with the front that its neighbour of the same level leaves,
///     level 4             `-> b -> c       and where none is there (left of b) with the shadow on its parent
///
/// A sun is shown when every tile has its shadow heights: until then all of `shadow_of` is of the last one, so that shadows
/// neither tear between tiles nor pop one by one. Tiles that come are answered for the sun that is shown, too.
///
///     shadows.set_sun(to_sun);              // every frame
///     shadows.insert(tile, heights);        // when it is loaded, its parent before it
///     shadows.update(8);                    // every frame
///     if (auto shadow = shadows.shadow_of(tile))
///         upload when it is another than the last one: its heights_m never change
///
/// Memory: what tiles and heights the caller keeps, and up to 150 KB a tile. Not for several threads at a time.
class PlanetShadows {
public:
    /// Throws InvalidInput for a globe or sun out of range.
    /// With `raised`, those of an edge of the sun's disc (see LightAxis), for half-shadows: 0.2666 degrees for the upper one,
    /// under which nothing of the sun is seen, and minus as much for the lower, above which all of it is.
    PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised = {});

    /// A tile is there from now on, or has other heights. Tiles may come in any order; those of level 0 should be there always.
    void insert(const PlanetTile& tile, std::shared_ptr<const TileHeights> heights);
    /// A tile is there no more. Does nothing if it was not.
    void erase(const PlanetTile& tile);

    /// Where the sun is to be. A vector of any length but 0; throws InvalidInput.
    void set_sun(const Vector3& to_sun);

    /// The sun (unit vector) whose shadows `shadow_of` gives.
    Vector3 shown_sun() const { return shown_.axis.to_sun; }

    /// Computes the shadows of at most so many tiles. Returns how many: 0 when all is settled.
    std::size_t update(std::size_t tiles, const Execution& execution = {});

    /// Computes all that is left. What is shown then depends on the sun, the tiles and their heights alone, bit for bit.
    void settle(const Execution& execution = {});
    bool settled() const;

    /// The shadow heights to draw with; null for a tile that is not there or not computed yet (draw with its parent's).
    std::shared_ptr<const TileShadow> shadow_of(const PlanetTile& tile) const;

private:
    // Numbers tell one set of heights, or one shadow, from another; 0 is none.
    using Number = std::uint64_t;
    struct Ground {
        std::shared_ptr<const TileHeights> heights;
        Number number = 0;
    };
    // Its heights, the shadows of its neighbours by TileEdge, that of the ancestor.
    using MadeFrom = std::array<Number, 6>;
    struct Result {
        std::shared_ptr<const TileShadow> shadow;
        Number number = 0;
        MadeFrom made_from = {};
    };
    // The shadows of one sun.
    struct Generation {
        LightAxis axis;
        std::map<LightRank, PlanetTile> order;
        std::unordered_map<PlanetTile, Result> results;
        bool whole = false; ///< all results are there and up to date
    };
    struct Task;

    template <typename Change>
    void for_generations(const Change& change);
    Generation begun_for(const LightAxis& axis) const;
    std::optional<PlanetTile> nearest_ancestor(const PlanetTile& tile) const;
    Task task_for(const Generation& generation, const PlanetTile& tile) const;
    std::vector<Task> ready_tasks(const Generation& generation, std::size_t most, bool missing_only) const;
    void finish(Generation& generation, const Task& task, TileShadow shadow);
    std::size_t work_on(Generation& generation, std::size_t most, bool missing_only,
                        const Execution& execution);
    void begin_wanted();
    void show_coming();

    Globe globe_;
    std::unordered_map<PlanetTile, Ground> tiles_;
    Angle raised_;
    Generation shown_;
    std::optional<Generation> coming_;
    LightAxis wanted_;
    Number last_number_ = 0;
};

} // namespace duskline
