#include "tiles_of_level.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/planet/planet_tile.h>
#include <duskline/planet/tile_heights.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <unordered_set>
#include <vector>

namespace duskline {
namespace {

bool same(const Vector3& a, const Vector3& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

PlanetTile any_tile(std::uint32_t level, std::mt19937& random)
{
    std::uniform_int_distribution<std::uint32_t> index(0, (1U << level) - 1);
    std::uniform_int_distribution<std::uint32_t> face(0, kCubeFaces - 1);
    return {face(random), level, index(random), index(random)};
}

Vector3 along_edge(const PlanetTile& tile, TileEdge edge, double i)
{
    switch (edge) {
    case TileEdge::lowest_u:
        return sample_direction(tile, i, 0.0);
    case TileEdge::highest_u:
        return sample_direction(tile, i, kTileSquares);
    case TileEdge::lowest_v:
        return sample_direction(tile, 0.0, i);
    default:
        return sample_direction(tile, kTileSquares, i);
    }
}

void expect_shared_edge(const PlanetTile& tile, TileEdge edge)
{
    const TileNeighbour there = neighbour_of(tile, edge);
    ASSERT_NE(there.tile, tile);
    for (int i = 0; i <= kTileSquares; i += 8)
        EXPECT_TRUE(same(along_edge(tile, edge, i),
                         along_edge(there.tile, there.edge, there.reversed ? kTileSquares - i : i)))
            << tile.face << ' ' << tile.level << ' ' << tile.row << ' ' << tile.column << " edge "
            << static_cast<int>(edge);
    const TileNeighbour back = neighbour_of(there.tile, there.edge);
    EXPECT_EQ(back.tile, tile);
    EXPECT_EQ(back.edge, edge);
    EXPECT_EQ(back.reversed, there.reversed);
}

TEST(PlanetTile, NeighboursShareTheSamplesOfTheirEdgeBitForBit)
{
    for (std::uint32_t level = 0; level < 4; ++level)
        for (const PlanetTile& tile : tiles_of_level(level))
            for (const TileEdge edge : kTileEdges)
                expect_shared_edge(tile, edge);
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        PlanetTile tile = any_tile(kDeepestTileLevel, random);
        if (i % 2 == 0)
            tile.column = i % 4 == 0 ? 0 : (1U << tile.level) - 1;
        for (const TileEdge edge : kTileEdges)
            expect_shared_edge(tile, edge);
    }
}

TEST(PlanetTile, SharesItsEvenSamplesWithItsParent)
{
    std::mt19937 random(8);
    for (const std::uint32_t level : {1U, 7U, kDeepestTileLevel}) {
        const PlanetTile tile = any_tile(level, random);
        const PlanetTile parent = parent_of(tile);
        const double first_row = (tile.row % 2) * kTileSquares / 2.0;
        const double first_column = (tile.column % 2) * kTileSquares / 2.0;
        for (int i = 0; i <= kTileSquares; i += 16)
            EXPECT_TRUE(
                same(sample_direction(tile, i, kTileSquares - i),
                     sample_direction(parent, first_row + i / 2.0, first_column + (kTileSquares - i) / 2.0)));
    }
}

TEST(PlanetTile, IsTheParentOfItsChildren)
{
    const PlanetTile tile = {3, 5, 17, 30};
    for (const PlanetTile& child : children_of(tile)) {
        EXPECT_EQ(parent_of(child), tile);
        EXPECT_EQ(ancestor_of(child, 4), parent_of(tile));
    }
    EXPECT_EQ(children_of(tile)[2], (PlanetTile{3, 6, 35, 60}));
}

TEST(PlanetTile, ContinuesItsRowsBeyondItsBorder)
{
    const PlanetTile tile = {0, 3, 7, 2};
    const TileNeighbour above = neighbour_of(tile, TileEdge::highest_v);
    EXPECT_EQ(above.tile.face, 4U);
    // Over the edge the direction is that of the same great circle, no sample of the neighbour's.
    const FacePlace beyond = sample_place(tile, kTileSquares + 1, 64);
    EXPECT_DOUBLE_EQ(beyond.v, 1.0 + 2.0 / 1024.0);
    EXPECT_EQ(face_of(direction_of(0, beyond)), 4U);
}

TEST(PlanetTile, IsFoundByTheDirectionsOfItsSamples)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> sample(0.01, kTileSquares - 0.01);
    for (int i = 0; i < 500; ++i) {
        const PlanetTile tile = any_tile(static_cast<std::uint32_t>(i) % 19, random);
        const double row = sample(random);
        const double column = sample(random);
        const TilePlace found = place_in_tile(sample_direction(tile, row, column), tile.level);
        EXPECT_EQ(found.tile, tile);
        EXPECT_NEAR(found.row, row, 1e-6);
        EXPECT_NEAR(found.column, column, 1e-6);
    }
}

TEST(PlanetTile, HasATileForEveryDirectionEvenOnEdgesAndCorners)
{
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0}) {
                if (x == 0.0 && y == 0.0 && z == 0.0)
                    continue;
                const Vector3 direction = normalized({x, y, z});
                const TilePlace place = place_in_tile(direction, 6);
                EXPECT_LT(place.tile.row, 64U);
                EXPECT_LT(place.tile.column, 64U);
                EXPECT_LT(length(sample_direction(place.tile, place.row, place.column) - direction), 1e-15);
            }
}

TEST(PlanetTile, HasSamplesAsFarApartAsItsLevelSays)
{
    EXPECT_NEAR(spacing_m(kWgs84, 0), 99658.0, 1.0);
    for (const std::uint32_t level : {2U, 9U, 16U}) {
        const std::uint32_t middle = 1U << (level - 1);
        const PlanetTile tile = {1, level, middle, middle};
        const double measured_m = length(point_m(kWgs84, sample_direction(tile, 0.0, 1.0), 0.0)
                                         - point_m(kWgs84, sample_direction(tile, 0.0, 0.0), 0.0));
        EXPECT_NEAR(measured_m / spacing_m(kWgs84, level), 1.0, 1e-4) << level;
        EXPECT_EQ(level_of_spacing(kWgs84, spacing_m(kWgs84, level)), level);
        EXPECT_EQ(level_of_spacing(kWgs84, 0.99 * spacing_m(kWgs84, level)), level + 1);
    }
}

TEST(PlanetTile, BoxHoldsAllGroundOfItsTileAndLittleMore)
{
    std::mt19937 random(10);
    const HeightRange heights = {-400.0f, 4200.0f};
    for (int i = 0; i < 300; ++i) {
        const PlanetTile tile = any_tile(static_cast<std::uint32_t>(i) % 18, random);
        const OrientedBox box = box_around(kWgs84, tile, heights);
        double highest = -1.0;
        double lowest = 1.0;
        for (int row = 0; row <= kTileSquares; row += 16)
            for (int column = 0; column <= kTileSquares; column += 16)
                for (const float height_m : {heights.lowest_m, heights.highest_m}) {
                    const Vector3 p = point_m(kWgs84, sample_direction(tile, row, column), height_m);
                    EXPECT_LT(distance_m(p, box), 1e-6) << tile.level;
                    const double along = dot(p - box.centre_m, box.axes[2]) / box.half_m[2];
                    highest = std::max(highest, along);
                    lowest = std::min(lowest, along);
                }
        if (tile.level > 8) { // coarser ones hold the bulge of the globe, too
            EXPECT_GT(highest, 0.95);
            EXPECT_LT(lowest, -0.95);
        }
    }
}

TEST(PlanetTile, CornersLieFarthestFromItsMiddle)
{
    EXPECT_NEAR(angular_radius({0, 0, 0, 0}).degrees(), 54.7356, 1e-4);
    for (const PlanetTile& tile : tiles_of_level(2)) {
        const Vector3 centre = centre_direction(tile);
        double farthest = 0.0;
        for (int i = 0; i <= kTileSquares; ++i)
            for (const TileEdge edge : kTileEdges)
                farthest = std::max(farthest, std::asin(length(cross(centre, along_edge(tile, edge, i)))));
        EXPECT_NEAR(angular_radius(tile).radians(), farthest, 1e-12);
    }
}

TEST(PlanetTile, HashesDifferForAllTilesOfALevel)
{
    std::unordered_set<std::size_t> hashes;
    const auto tiles = tiles_of_level(5);
    for (const PlanetTile& tile : tiles)
        hashes.insert(std::hash<PlanetTile>()(tile));
    EXPECT_EQ(hashes.size(), tiles.size());
}

TEST(OrientedBox, KnowsHowFarAPointIsAndHowFarItReaches)
{
    const OrientedBox box = {
        {10.0, 0.0, 0.0}, {{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}}, {1.0, 2.0, 3.0}};
    EXPECT_EQ(distance_m({10.0, 0.5, -2.0}, box), 0.0);
    EXPECT_DOUBLE_EQ(distance_m({17.0, 4.0, 2.0}, box), 5.0);
    EXPECT_DOUBLE_EQ(reach_m(box, {1.0, 0.0, 0.0}), 3.0);
    EXPECT_DOUBLE_EQ(reach_m(box, normalized({0.0, 3.0, 4.0})), (3.0 * 1.0 + 4.0 * 2.0) / 5.0);
    EXPECT_DOUBLE_EQ(diagonal_m(box), 2.0 * std::sqrt(14.0));
}

TEST(TileHeights, FindsSamplesByTheirNumbersInTheTile)
{
    TileHeights heights;
    std::ranges::fill(heights.heights_m.values(), 0.0f);
    heights.heights_m(0, 0) = 5.0f;
    heights.heights_m(kTileStored - 1, 1) = 7.0f;
    EXPECT_EQ(heights.height_m(-1, -1), 5.0f);
    EXPECT_EQ(heights.height_m(kTileSquares + 1, 0), 7.0f);
    EXPECT_NEAR(height_m(kWgs84, sample_point_m(kWgs84, {2, 4, 1, 1}, heights, -1, -1)), 5.0, 1e-8);
}

} // namespace
} // namespace duskline
