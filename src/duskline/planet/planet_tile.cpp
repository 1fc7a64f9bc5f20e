#include <duskline/geometry/cross_product.h>
#include <duskline/planet/planet_tile.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

std::array<Vector3, 4> corner_directions(const PlanetTile& tile)
{
    constexpr double last = kTileSquares;
    return {sample_direction(tile, 0.0, 0.0), sample_direction(tile, 0.0, last),
            sample_direction(tile, last, 0.0), sample_direction(tile, last, last)};
}

// How fast the ellipsoid's radius changes at most, metres a radian.
double steepest_base(const Globe& globe)
{
    const double a = globe.equatorial_radius_m;
    const double b = globe.polar_radius_m;
    const double shorter = std::min(a, b);
    return a * b * std::abs(a * a - b * b) / (2.0 * shorter * shorter * shorter);
}

// What a box holds along one of its axes.
struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double middle() const { return (low + high) / 2.0; }
    double half() const { return (high - low) / 2.0; }
};

// Coordinates in steps of 2^-level on a face, from its middle: exact. The middle of a tile is odd, edges of the face
// are at plus and minus 2^level.
struct FaceSteps {
    std::int64_t u;
    std::int64_t v;
};

// The neighbour over the face's edge shares that edge. A point on it lies on both faces' planes, so its place on the
// other face is a dot product away.
FaceSteps over_the_edge(std::uint32_t from, std::uint32_t to, FaceSteps edge, std::int64_t side)
{
    const CubeFaceAxes f = axes_of_face(from);
    const CubeFaceAxes t = axes_of_face(to);
    const Vector3 point = f.axis * static_cast<double>(side) + f.right * static_cast<double>(edge.u)
                          + f.up * static_cast<double>(edge.v);
    return {std::llround(dot(point, t.right)), std::llround(dot(point, t.up))};
}

TileEdge edge_at(FaceSteps steps, std::int64_t side)
{
    if (std::abs(steps.u) == side)
        return steps.u < 0 ? TileEdge::lowest_u : TileEdge::highest_u;
    return steps.v < 0 ? TileEdge::lowest_v : TileEdge::highest_v;
}

bool of_u(TileEdge edge)
{
    return edge == TileEdge::lowest_u || edge == TileEdge::highest_u;
}

// Whether a coordinate that grows along our edge falls along the other face's.
bool runs_backwards(std::uint32_t from, TileEdge edge, std::uint32_t to, TileEdge other)
{
    const CubeFaceAxes f = axes_of_face(from);
    const CubeFaceAxes t = axes_of_face(to);
    return dot(of_u(edge) ? f.up : f.right, of_u(other) ? t.up : t.right) < 0.0;
}

std::uint32_t tile_index(std::int64_t middle, std::int64_t side)
{
    return static_cast<std::uint32_t>((middle + side - 1) / 2);
}

} // namespace

TileNeighbour neighbour_of(const PlanetTile& tile, TileEdge edge)
{
    const bool low = edge == TileEdge::lowest_u || edge == TileEdge::lowest_v;
    const std::uint32_t index = of_u(edge) ? tile.column : tile.row;
    const std::uint32_t last = (1U << tile.level) - 1;
    if (low ? index > 0 : index < last) {
        TileNeighbour result = {tile, TileEdge::lowest_u, false};
        (of_u(edge) ? result.tile.column : result.tile.row) = low ? index - 1 : index + 1;
        const auto opposite = static_cast<std::uint8_t>(static_cast<std::uint8_t>(edge) ^ 1U);
        result.edge = static_cast<TileEdge>(opposite);
        return result;
    }
    const CubeFaceAxes& axes = axes_of_face(tile.face);
    const Vector3 beyond = (of_u(edge) ? axes.right : axes.up) * (low ? -1.0 : 1.0);
    const std::uint32_t face = face_of(beyond);
    const std::int64_t side = std::int64_t{1} << tile.level;
    const auto middle = [&](std::uint32_t i) { return 2 * std::int64_t{i} + 1 - side; };
    const std::int64_t border = low ? -side : side;
    const FaceSteps shared =
        of_u(edge) ? FaceSteps{border, middle(tile.row)} : FaceSteps{middle(tile.column), border};
    const FaceSteps there = over_the_edge(tile.face, face, shared, side);
    // From the edge half a tile inwards; along it the middle is odd and stays.
    const auto inside = [&](std::int64_t steps) { return std::clamp(steps, 1 - side, side - 1); };
    const TileEdge other = edge_at(there, side);
    return {{face, tile.level, tile_index(inside(there.v), side), tile_index(inside(there.u), side)},
            other,
            runs_backwards(tile.face, edge, face, other)};
}

FacePlace sample_place(const PlanetTile& tile, double row, double column)
{
    const double step = 2.0 / static_cast<double>(std::uint64_t{kTileSquares} << tile.level);
    return {(static_cast<double>(tile.column) * kTileSquares + column) * step - 1.0,
            (static_cast<double>(tile.row) * kTileSquares + row) * step - 1.0};
}

TilePlace place_in_tile(const Vector3& direction, std::uint32_t level)
{
    const std::uint32_t face = face_of(direction);
    const FacePlace place = place_on_face(face, direction);
    const double tiles = static_cast<double>(1U << level);
    const double column = std::clamp((place.u + 1.0) / 2.0 * tiles, 0.0, tiles);
    const double row = std::clamp((place.v + 1.0) / 2.0 * tiles, 0.0, tiles);
    const double first_column = std::min(std::floor(column), tiles - 1.0);
    const double first_row = std::min(std::floor(row), tiles - 1.0);
    return {{face, level, static_cast<std::uint32_t>(first_row), static_cast<std::uint32_t>(first_column)},
            (row - first_row) * kTileSquares,
            (column - first_column) * kTileSquares};
}

std::uint32_t level_of_spacing(const Globe& globe, double wanted_m)
{
    assert(wanted_m > 0.0);
    std::uint32_t level = 0;
    while (level < kDeepestTileLevel && spacing_m(globe, level) > wanted_m)
        ++level;
    return level;
}

Angle angular_radius(const PlanetTile& tile)
{
    const Vector3 centre = centre_direction(tile);
    double sine = 0.0;
    for (const Vector3& corner : corner_directions(tile))
        sine = std::max(sine, length(cross(centre, corner)));
    return Angle::from_radians(std::asin(std::min(sine, 1.0))); // at most 55 degrees, at level 0
}

// Seen from the centre, the tile's outline on the tangent plane of its middle is a quadrangle with straight sides, because
// both projections are gnomonic: its corners bound it. A point r d of the tile lies at r (d . up) times its place there.
OrientedBox box_around(const Globe& globe, const PlanetTile& tile, HeightRange heights)
{
    const Vector3 up = centre_direction(tile);
    const Vector3 aside = axes_of_face(tile.face).right;
    const Vector3 right = normalized(aside - up * dot(aside, up));
    const std::array<Vector3, 3> axes = {right, cross(up, right), up};
    const double angle = angular_radius(tile).radians();
    const double base_m = base_radius_m(globe, up);
    const double base_slack_m = steepest_base(globe) * angle;
    const double nearest_m = base_m - base_slack_m + static_cast<double>(heights.lowest_m);
    const double farthest_m = base_m + base_slack_m + static_cast<double>(heights.highest_m);

    std::array<Interval, 3> held;
    for (const Vector3& corner : corner_directions(tile))
        for (std::size_t i = 0; i < 2; ++i)
            held.at(i).include(farthest_m * dot(corner, axes.at(i)) / dot(corner, up));
    held[2].include(nearest_m * std::cos(angle));
    held[2].include(farthest_m);

    OrientedBox box = {{}, axes, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        box.centre_m = box.centre_m + axes.at(i) * held.at(i).middle();
        box.half_m.at(i) = held.at(i).half();
    }
    return box;
}

} // namespace duskline
