#pragma once

// A planet whose ground is a function of the direction, tile by tile, for tests.

#include <duskline/planet/planet_level.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

namespace duskline {

class MadeGround {
public:
    using HeightIn = std::function<double(const Vector3& direction)>;

    /// `height_in` is asked for samples of tiles when they are first wanted. Heights must stay within the range.
    MadeGround(const Globe& globe, HeightRange range, HeightIn height_in);

    /// Not from several threads, unless the tile has been asked for before.
    const TileHeights& heights_of(const PlanetTile& tile) const;
    std::shared_ptr<const TileHeights> shared_heights_of(const PlanetTile& tile) const;

    /// The ground of one level; must not outlive this.
    PlanetLevel at_level(std::uint32_t level) const;

private:
    Globe globe_;
    HeightRange range_;
    HeightIn height_in_;
    mutable std::map<PlanetTile, std::shared_ptr<const TileHeights>> tiles_;
};

/// Ranges of some hundred kilometres with smaller ones on them, 0 to 9000 m: a function of the direction.
double mountains_m(const Vector3& direction);
inline constexpr HeightRange kMountains = {0.0F, 9000.0F};

} // namespace duskline
