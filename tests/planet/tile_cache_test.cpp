#include "hilly_planet.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/tile_cache.h>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace duskline {
namespace {

PlanetTerrain tiny_planet()
{
    return hilly_planet(sphere_of_radius(20000.0), 10.0,
                        {.sea = false, .detail = 0.0, .finest_spacing_m = 10.0});
}

TEST(TileCache, HoldsTheSixFacesFromTheStart)
{
    const PlanetTerrain terrain = tiny_planet();
    const TileCache cache(terrain, 64);
    EXPECT_EQ(cache.size(), 6U);
    EXPECT_NE(cache.find({5, 0, 0, 0}), nullptr);
    EXPECT_EQ(cache.find({5, 1, 0, 0}), nullptr);
    EXPECT_EQ(cache.bytes(), 6 * kTileStored * kTileStored * 5);
}

TEST(TileCache, LoadsWhatTheTerrainSays)
{
    const PlanetTerrain terrain = tiny_planet();
    TileCache cache(terrain, 64);
    cache.begin_frame();
    cache.use({2, 0, 0, 0});
    EXPECT_EQ(cache.load_children(std::array{PlanetTile{2, 0, 0, 0}}), 4U);
    const PlanetTile child = {2, 1, 1, 0};
    ASSERT_NE(cache.find(child), nullptr);
    EXPECT_EQ(cache.find(child)->heights->height_m(7, 9), terrain.heights_of(child).height_m(7, 9));
    EXPECT_EQ(cache.load_children(std::array{PlanetTile{2, 0, 0, 0}}), 0U); // there already
}

TEST(TileCache, NeverHoldsMoreThanItMayAndNoTileWithoutItsAncestors)
{
    const PlanetTerrain terrain = tiny_planet();
    TileCache cache(terrain, 64);
    std::mt19937 random(11);
    for (int frame = 0; frame < 20; ++frame) {
        cache.begin_frame();
        // Down one random branch.
        PlanetTile tile = {static_cast<std::uint32_t>(random() % kCubeFaces), 0, 0, 0};
        for (std::uint32_t level = 0; level < terrain.deepest_level(); ++level) {
            cache.use(tile);
            cache.load_children(std::array{tile});
            tile = children_of(tile).at(random() % 4);
            ASSERT_NE(cache.find(tile), nullptr);
        }
        EXPECT_LE(cache.size(), cache.most_tiles());
        // What the frame has used is still there.
        for (std::uint32_t level = 0; level <= tile.level; ++level)
            EXPECT_NE(cache.find(ancestor_of(tile, level)), nullptr);
        for (std::uint32_t face = 0; face < kCubeFaces; ++face)
            EXPECT_NE(cache.find({face, 0, 0, 0}), nullptr);
    }
}

TEST(TileCache, ThrowsOutChildrenBeforeTheirParents)
{
    const PlanetTerrain terrain = tiny_planet();
    TileCache cache(terrain, 64);
    const auto load_all_of = [&](std::uint32_t face, std::uint32_t levels) {
        std::vector<PlanetTile> parents = {{face, 0, 0, 0}};
        for (std::uint32_t level = 0; level < levels; ++level) {
            std::vector<PlanetTile> children;
            for (const PlanetTile& parent : parents) {
                cache.use(parent);
                for (const PlanetTile& child : children_of(parent))
                    children.push_back(child);
            }
            cache.load_children(parents);
            parents = children;
        }
    };
    cache.begin_frame();
    load_all_of(0, 2);
    for (std::uint32_t face = 1; face < 4; ++face) {
        cache.begin_frame();
        load_all_of(face, 2);
        for (std::uint32_t row = 0; row < 4; ++row)
            for (std::uint32_t column = 0; column < 4; ++column)
                if (cache.find({0, 2, row, column}) != nullptr) {
                    EXPECT_NE(cache.find({0, 1, row / 2, column / 2}), nullptr);
                }
    }
    EXPECT_LE(cache.size(), 64U);
}

TEST(TileCache, LoadsNothingWhenAllItHoldsIsInUse)
{
    const PlanetTerrain terrain = tiny_planet();
    TileCache cache(terrain, 64);
    cache.begin_frame();
    std::size_t loaded = 0;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        loaded += cache.load_children(std::array{PlanetTile{face, 0, 0, 0}});
        for (const PlanetTile& child : children_of({face, 0, 0, 0}))
            loaded += cache.load_children(std::array{child});
    }
    EXPECT_EQ(loaded, 56U); // 62 with the faces: no room for four more
    EXPECT_EQ(cache.size(), 62U);
    EXPECT_THROW(TileCache(terrain, 63), InvalidInput);
}

TEST(TileCache, BoxesHoldTheGroundOfAllDeeperLevels)
{
    const PlanetTerrain terrain = small_planet();
    TileCache cache(terrain, 200);
    std::mt19937 random(12);
    std::uniform_real_distribution<double> at(0.0, kTileSquares);
    for (int i = 0; i < 8; ++i) {
        cache.begin_frame();
        PlanetTile tile = {static_cast<std::uint32_t>(random() % kCubeFaces), 0, 0, 0};
        for (;;) {
            const OrientedBox box = cache.use(tile).box;
            for (int k = 0; k < 50; ++k) {
                const Vector3 direction = sample_direction(tile, at(random), at(random));
                for (std::uint32_t level = tile.level; level <= terrain.deepest_level(); ++level)
                    EXPECT_LT(
                        distance_m(point_m(terrain.globe(), direction, terrain.height_m(direction, level)),
                                   box),
                        1e-6);
            }
            if (tile.level == 4)
                break;
            cache.load_children(std::array{tile});
            tile = children_of(tile).at(random() % 4);
        }
    }
}

} // namespace
} // namespace duskline
