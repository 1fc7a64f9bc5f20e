#pragma once

#include <duskline/execution/progress.h>
#include <duskline/planet/planet_front.h>
#include <duskline/planet/sun_motion.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace duskline {

/// What to draw a tile's shadows with. While the sun moves it is between two suns whose shadows are known, and so are shadow
/// heights: first + share (second - first), of every sample.
struct ShownShadow {
    std::shared_ptr<const TileShadow> first = {};  ///< null for a tile that is not there, or not computed yet
    std::shared_ptr<const TileShadow> second = {}; ///< null when the first is all
    double share = 0.0;                            ///< of the second
};

/// The shadows of a planet: shadow heights of all tiles that are there, of all levels, kept up to date while tiles come and
/// go and the sun moves.
///
///     level 3   [sun] -> A -> B -> C      coarse before fine, and of a level those nearer to the sun first:
///                         |                every tile begins with the front that its neighbour of the same level leaves,
///     level 4             `-> b -> c       and where none is there (left of b) with the shadow on its parent
///
/// A sun is shown when every tile has its shadow heights, so that shadows neither tear between tiles nor pop one by one. While the
/// sun moves steadily, suns are computed ahead of it and it is shown between two of them: edges of shadow travel.
///
///     .---- shown ----.                          A and B are whole; the sun that is set is between them, and what is
///     A ----- sun --> B - - - - - -> C           shown is interpolated. Meanwhile C is computed; when the sun is at B and
///                                    coming      C is whole, B and C are shown and the next is begun
///
/// A sun that moves unsteadily, or too fast to be computed, is shown at the nearest place of that way; one that stands as
/// it is, when its own shadows are whole. Tiles that come are answered for the suns that are shown first.
///
///     shadows.set_sun(to_sun);              // every frame, once
///     shadows.insert(tile, heights);        // when it is loaded, its parent before it
///     shadows.update(8);                    // every frame
///     const ShownShadow shadow = shadows.shown(tile);
///     upload what is another than before: it never changes
///
/// Memory: what tiles and heights the caller keeps, and 71 KB for each tile and sun (of a disc 150 KB): one sun while it
/// stands, three while it moves. Not for several threads at a time.
class PlanetShadows {
public:
    /// Throws InvalidInput for a globe or sun out of range.
    /// With `raised`, those of an edge of the sun's disc (see LightAxis), for half-shadows: 0.2666 degrees for the upper one,
    /// under which nothing of the sun is seen, and minus as much for the lower, above which all of it is.
    PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised = {});

    /// Half-shadows of a disc of that radius: both of its edges in one pass (see TileShadow::dark_m). Throws as the above.
    static PlanetShadows of_disc(const Globe& globe, const Vector3& to_sun, Angle radius);

    /// A tile is there from now on, or has other heights. Tiles may come in any order; those of level 0 should be there always.
    void insert(const PlanetTile& tile, std::shared_ptr<const TileHeights> heights);
    /// A tile is there no more. Does nothing if it was not.
    void erase(const PlanetTile& tile);

    /// Where the sun is to be. A vector of any length but 0; throws InvalidInput.
    void set_sun(const Vector3& to_sun);

    /// The sun (unit vector) whose shadows are shown.
    Vector3 shown_sun() const;

    /// Computes the shadows of at most so many tiles. Returns how many: 0 when all is settled. May be called more than once a
    /// frame.
    std::size_t update(std::size_t tiles, const Execution& execution = {});

    /// Computes all that is left. What is shown then depends on the sun, the tiles and their heights alone, bit for bit.
    void settle(const Execution& execution = {});
    bool settled() const;

    /// The shadows to draw with (for a tile without any, draw with its parent's).
    ShownShadow shown(const PlanetTile& tile) const;

    /// Those of a sun that stands; of one that moves, those of the last sun that it was at. Null for a tile that is not there or
    /// not computed yet.
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
    // One axis, or those of a disc.
    struct Light {
        LightAxis axis;
        std::optional<LightAxis> upper;
    };
    // The shadows of one sun.
    struct Generation {
        Light light;
        std::map<LightRank, PlanetTile> order;
        std::unordered_map<PlanetTile, Result> results;
        bool whole = false; ///< all results are there and up to date
    };
    struct Task;

    PlanetShadows(const Globe& globe, const Vector3& to_sun, Angle raised, Angle radius);

    Light light_for(const Vector3& to_sun) const;
    template <typename Change>
    void for_generations(const Change& change);
    Generation begun_for(const Light& light) const;
    std::optional<PlanetTile> nearest_ancestor(const PlanetTile& tile) const;
    Task task_for(const Generation& generation, const PlanetTile& tile) const;
    std::vector<Task> ready_tasks(const Generation& generation, std::size_t most, bool missing_only) const;
    void finish(Generation& generation, const Task& task, TileShadow shadow);
    std::size_t work_on(Generation& generation, std::size_t most, bool missing_only,
                        const Execution& execution);
    TileShadow cast(const Generation& generation, const Task& task) const;
    std::size_t work_on_shown(std::size_t most, bool missing_only, const Execution& execution);
    std::size_t frames_a_sun(std::size_t tiles) const;
    void begin_coming(std::size_t tiles);
    void show_coming(std::size_t tiles);
    double share() const;

    Globe globe_;
    std::unordered_map<PlanetTile, Ground> tiles_;
    Angle raised_;
    Angle radius_; ///< of a disc; else 0
    Generation shown_;
    std::optional<Generation> next_; ///< the sun that is shown is between those two
    std::optional<Generation> coming_;
    Light wanted_;
    SunMotion motion_;
    std::size_t frames_ = 0;       ///< since `coming_` was begun
    std::size_t frames_taken_ = 0; ///< that the last sun took; 0 for none yet
    Number last_number_ = 0;
};

} // namespace duskline
