#pragma once

#include <duskline/geometry/grid.h>
#include <duskline/planet/light_axis.h>
#include <duskline/planet/planet_tile.h>
#include <duskline/planet/tile_heights.h>

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace duskline {

/// What light has met when it leaves a tile: for every beam that passed the tile, how far from the light's axis the farthest
/// ground is that it has met anywhere on its way. Beams are the half-planes about the axis at turns of n / 2^beams_log2, the
/// same on every tile.
///
/// Light of a disc has met ground for both edges of it: `rho_m` is from the axis of the lower edge, `upper_m` from that of the
/// upper one, and `upper_of_same_m` how far from the upper edge's axis the ground is that `rho_m` is of.
struct LeavingFront {
    std::uint32_t beams_log2 = 0; ///< of the beams in a whole turn
    std::int64_t first = 0;       ///< n of the first beam; any multiple of a whole turn off
    std::vector<double> rho_m =
        {}; ///< of that beam and the following; below 0 where one did not pass after all
    std::vector<double> upper_m = {}; ///< of a disc; else empty
    std::vector<double> upper_of_same_m = {};

    /// Between beams straight from one to the next; just beside them that of the nearest; 0 where there are none.
    double rho_at(double turn) const { return between_beams(rho_m, turn); }
    double upper_at(double turn) const { return between_beams(upper_m, turn); }
    double upper_of_same_at(double turn) const { return between_beams(upper_of_same_m, turn); }

    bool operator==(const LeavingFront&) const = default;

private:
    double between_beams(const std::vector<double>& all_m, double turn) const;
};

/// The shadow heights of a tile's samples, and the front that its neighbours on the night's side begin with.
struct TileShadow {
    /// Metres above the ellipsoid, sample (row, column) of 0 to kTileSquares; never NaN or infinite. A point is in shadow when
    /// it lies lower. Where nothing stands towards the sun it is some thousand kilometres under the ground; deep at night
    /// at most kDeepNight_m. Of light of a disc: the shadow of its lower edge, above which all of it is seen.
    Grid<float> heights_m{kTileSquares + 1, kTileSquares + 1};

    /// Of light of a disc, else empty: from here to `heights_m` more and more of it is seen. Where the ground lies in full shadow it
    /// is the shadow of the disc's upper edge; elsewhere what the ground that hides the lower edge does to the upper one,
    /// which is never higher.
    Grid<float> dark_m = {};
    LeavingFront leaving = {};
};

inline constexpr float kDeepNight_m = 1e8F;

/// Whether light comes into a tile over an edge; else it leaves there. Of two tiles that share an edge it enters one and
/// leaves the other.
bool light_enters(const LightAxis& axis, const PlanetTile& tile, TileEdge edge);

/// Sorts tiles so that coarse ones come before fine ones, and of one level those that light leaves before those that it enters
/// from there.
struct LightRank {
    std::uint32_t level = 0;
    double face_from_sun = 0.0;
    std::uint32_t face = 0;
    std::int64_t tiles_from_sun = 0;
    PlanetTile tile = {}; ///< makes the order total

    auto operator<=>(const LightRank&) const = default; // NOLINT(modernize-use-nullptr)
};
LightRank light_rank(const LightAxis& axis, const PlanetTile& tile);

/// What is known of the light that enters a tile.
struct EnteringLight {
    /// By TileEdge: the shadow of the tile of the same level across, or null where there is none. Asked for only where
    /// light enters.
    std::array<const TileShadow*, 4> neighbours = {};
    /// Serves where there is no neighbour: any tile above. Without it too nothing stands towards the sun, and beyond the
    /// terminator the bare globe.
    PlanetTile ancestor_tile = {};
    const TileShadow* ancestor = nullptr;
};

/// The shadow on one tile, and the front that leaves it: one pass over its samples, away from the sun.
///
/// Samples on an edge over which light enters are those of the neighbour, bit for bit, or interpolated from the ancestor's, so
/// that tiles agree on the samples they share. Elsewhere heights are, as those of `sweep`, wrong only beside edges of
/// shadow. `heights` are used from sample 0 to kTileSquares. Depends on its arguments alone. A millisecond or two; ten where the
/// sun is straight over or under the tile.
TileShadow cast_on_tile(const Globe& globe, const LightAxis& axis, const PlanetTile& tile,
                        const TileHeights& heights, const EnteringLight& entering);

/// Light of a disc: the axes of one sun, raised to the edges of the disc.
struct DiscAxes {
    LightAxis lower;
    LightAxis upper;
};

/// The same for both edges of a disc in one pass; neighbours and ancestor must be of the same disc. `heights_m` are, bit for bit,
/// those of the lower edge alone. Takes a fifth longer than one.
TileShadow cast_on_tile(const Globe& globe, const DiscAxes& axes, const PlanetTile& tile,
                        const TileHeights& heights, const EnteringLight& entering);

} // namespace duskline
