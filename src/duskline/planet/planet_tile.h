#pragma once

#include <duskline/planet/cube_face.h>
#include <duskline/planet/globe.h>
#include <duskline/planet/oriented_box.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace duskline {

/// A square of a face of the cube: at each level a face has 2^level x 2^level of them, alike in (u, v). Rows count along v
/// and columns along u, both upwards: tile (0, 0) has the corner u = v = -1.
///
///     (row 1)  +-----+-----+
///              |  2  |  3  |     the children of a tile, in the order of `children_of`
///     (row 0)  +-----+-----+
///              |  0  |  1  |
///              +-----+-----+
struct PlanetTile {
    std::uint32_t face = 0;   ///< below kCubeFaces
    std::uint32_t level = 0;  ///< 0 to kDeepestTileLevel
    std::uint32_t row = 0;    ///< below 2^level
    std::uint32_t column = 0; ///< below 2^level

    // clang-tidy 14 takes the zero that comparisons are rewritten with for a pointer.
    auto operator<=>(const PlanetTile&) const = default; // NOLINT(modernize-use-nullptr)
};

/// Squares of the grid along a tile's side. Samples are at their corners: 0 to kTileSquares, the first and last shared with
/// the neighbours; -1 and kTileSquares + 1 lie one step beyond the tile, on the straight continuation of its own rows and
/// columns, over the face's edge too. Even samples are samples of the parent.
inline constexpr std::int32_t kTileSquares = 128;

/// Samples a tile stores along a side, with one more all round.
inline constexpr std::size_t kTileStored = kTileSquares + 3;

/// On the earth samples of this level are 2 cm apart. (u, v) of all samples are exact in double.
inline constexpr std::uint32_t kDeepestTileLevel = 22;

/// Of a level above 0.
constexpr PlanetTile parent_of(const PlanetTile& tile)
{
    return {tile.face, tile.level - 1, tile.row / 2, tile.column / 2};
}

constexpr std::array<PlanetTile, 4> children_of(const PlanetTile& tile)
{
    const auto child = [&](std::uint32_t row, std::uint32_t column) {
        return PlanetTile{tile.face, tile.level + 1, 2 * tile.row + row, 2 * tile.column + column};
    };
    return {child(0, 0), child(0, 1), child(1, 0), child(1, 1)};
}

/// The ancestor of a level at or above the tile's (a smaller number); itself at its own.
constexpr PlanetTile ancestor_of(const PlanetTile& tile, std::uint32_t level)
{
    const std::uint32_t up = tile.level - level;
    return {tile.face, level, tile.row >> up, tile.column >> up};
}

/// A side of a tile: where u or v is lowest or highest.
enum class TileEdge : std::uint8_t { lowest_u, highest_u, lowest_v, highest_v };
inline constexpr std::array kTileEdges = {TileEdge::lowest_u, TileEdge::highest_u, TileEdge::lowest_v,
                                          TileEdge::highest_v};

/// The tile of the same level across an edge, and how it lies there: sample i along our edge (counted along v on edges of
/// u, along u on edges of v) is its sample i on its `edge`, or kTileSquares - i if `reversed`. Both have the same direction,
/// bit for bit.
struct TileNeighbour {
    PlanetTile tile;
    TileEdge edge = TileEdge::lowest_u;
    bool reversed = false;
};
TileNeighbour neighbour_of(const PlanetTile& tile, TileEdge edge);

/// Where samples lie. Fractions and samples beyond the tile are allowed.
FacePlace sample_place(const PlanetTile& tile, double row, double column);
inline Vector3 sample_direction(const PlanetTile& tile, double row, double column)
{
    return direction_of(tile.face, sample_place(tile, row, column));
}

/// The tile of a level in which a direction lies, and where in it: 0 to kTileSquares. On shared edges one of the tiles.
struct TilePlace {
    PlanetTile tile;
    double row = 0.0;
    double column = 0.0;
};
TilePlace place_in_tile(const Vector3& direction, std::uint32_t level);

inline Vector3 centre_direction(const PlanetTile& tile)
{
    return sample_direction(tile, kTileSquares / 2.0, kTileSquares / 2.0);
}

/// The point of the ellipsoid at a tile's middle.
inline Vector3 centre_m(const Globe& globe, const PlanetTile& tile)
{
    return point_m(globe, centre_direction(tile), 0.0);
}

/// Distance of neighbouring samples at the middle of a face, where it is greatest, measured at the equatorial radius.
/// Towards a face's corners it falls to less than half.
constexpr double spacing_m(const Globe& globe, std::uint32_t level)
{
    return 2.0 * globe.equatorial_radius_m / kTileSquares / static_cast<double>(1U << level);
}

/// The first level whose samples are everywhere at most that far apart; kDeepestTileLevel when none is. Above 0.
std::uint32_t level_of_spacing(const Globe& globe, double spacing_m);

/// The greatest angle between the middle of a tile and a point of it: to one of its corners.
Angle angular_radius(const PlanetTile& tile);

/// A box around all ground of a tile with heights in that range (not empty), without the samples beyond its border. Upright
/// on the tile's middle, and little larger than what it holds.
OrientedBox box_around(const Globe& globe, const PlanetTile& tile, HeightRange heights);

} // namespace duskline

template <>
struct std::hash<duskline::PlanetTile> {
    std::size_t operator()(const duskline::PlanetTile& tile) const noexcept
    {
        // One number for every tile: 3 bits of the face, 5 of the level, 28 each of row and column.
        const std::uint64_t key = (std::uint64_t{tile.face} << 61U) | (std::uint64_t{tile.level} << 56U)
                                  | (std::uint64_t{tile.row} << 28U) | tile.column;
        const std::uint64_t mixed = (key ^ (key >> 31U)) * 0x9E3779B97F4A7C15U;
        return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
    }
};
