#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/planet/planet_level.h>
#include <duskline/planet/planet_patch.h>
#include <duskline/planet/planet_terrain.h>
#include <duskline/view/scene_lamp.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace duskline::planet_app {

/// A picture's pixels as PlanetRenderer::probe_ground leaves them; where there is no ground, kNoGround in all channels.
using ProbedPicture = Grid<std::array<float, 4>>;
inline constexpr float kNoGround = -2.0f;

/// How a technique's shadows compare with the truth, over pixels of ground.
struct ShadowErrors {
    std::size_t pixels = 0;
    std::size_t dark = 0;        ///< where no light gets, by the truth
    std::size_t wrong = 0;       ///< lit where the truth is dark, or the other way round
    std::size_t wrong_apart = 0; ///< of these, those with no edge of the true shadow within two pixels

    ShadowErrors& operator+=(const ShadowErrors& other);
};

/// Whether a light reaches a place: in a direction from the centre, at a height above the ellipsoid.
using Reaches = std::function<bool(const Vector3& direction, double height_m)>;

/// A light, as it shines over the ground of one level.
using LightOver = std::function<Reaches(const PlanetLevel& ground)>;

/// The sun, by PlanetRays, and a lamp, by PlanetSight, which sees all round and however far.
LightOver sunlight(const Vector3& to_sun);
LightOver lamplight(const SceneLamp& lamp);

/// The truth about the shadows of one picture, found once for all techniques that draw it: from the ground of the tile that is
/// drawn there, over the ground of that tile's LEVEL all the way to the light, however far away, seen or not.
///
/// Ground of a level is bilinear between its samples. What the mesh has turned into its parent's towards the end of its range
/// has the truth of its own level; ground that faces away from the sun is dark, for technique and truth.
class PictureTruth {
public:
    /// For a picture seen from an eye (planet's frame), in which `patches` are drawn; every `step`th pixel of every `step`th
    /// row counts. `terrain` and `probed` must outlive it. Throws Cancelled. Some 7 ms for each tile that rays come across, and
    /// 0.1 ms a pixel.
    PictureTruth(const PlanetTerrain& terrain, const LightOver& light, const Vector3& eye_m,
                 const std::vector<PlanetPatch>& patches, const ProbedPicture& probed, std::size_t step,
                 const Execution& execution = {});

    /// The same picture as another technique shades it.
    ShadowErrors errors_of(const ProbedPicture& shaded);

    std::size_t tiles() const { return ground_.size(); } ///< that the rays have come across so far

private:
    enum class Answer : std::uint8_t { unknown, dark, lit };

    const TileHeights& heights_of(const PlanetTile& tile);
    std::uint32_t level_drawn(const Vector3& direction) const;
    bool has_ground(std::size_t row, std::size_t column) const;
    bool is_lit(std::size_t row, std::size_t column);
    bool found(std::size_t row, std::size_t column);
    bool is_beside_edge(std::size_t row, std::size_t column);

    const PlanetTerrain& terrain_;
    Vector3 eye_m_;
    const ProbedPicture& probed_;
    std::size_t step_;
    std::unordered_set<PlanetTile> drawn_;
    std::map<std::uint32_t, Reaches> rays_; ///< by the levels that are drawn
    std::unordered_map<PlanetTile, std::unique_ptr<const TileHeights>> ground_;
    std::mutex ground_mutex_;
    Grid<Answer> answers_;
};

} // namespace duskline::planet_app
