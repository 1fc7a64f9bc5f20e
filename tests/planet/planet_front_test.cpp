#include "planet/made_ground.h"
#include "terrains.h"

#include <duskline/planet/planet_front.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace duskline {
namespace {

const Globe kBall = sphere_of_radius(6371000.0);

Vector3 random_direction(Dice& dice)
{
    return {dice.between(-1.0, 1.0), dice.between(-1.0, 1.0), dice.between(-1.0, 1.0)};
}

// Suns where light runs along edges of tiles or meets their corners, and others.
Vector3 awkward_sun(Dice& dice)
{
    const auto number = [&] { return static_cast<double>(dice.below(5)) / 2.0 - 1.0; };
    const Vector3 sun = {number(), number(), number()};
    return length(sun) == 0.0 || dice.chance(0.3) ? random_direction(dice) : sun;
}

PlanetTile random_tile(Dice& dice, std::uint32_t level)
{
    return {static_cast<std::uint32_t>(dice.below(kCubeFaces)), level,
            static_cast<std::uint32_t>(dice.below(1U << level)),
            static_cast<std::uint32_t>(dice.below(1U << level))};
}

TEST(PlanetFront, LightThatLeavesATileEntersItsNeighbourAndRanksBeforeIt)
{
    for_seeds(200, [](Dice& dice) {
        const LightAxis axis = light_axis(awkward_sun(dice));
        for (int i = 0; i < 50; ++i) {
            const PlanetTile tile = random_tile(dice, static_cast<std::uint32_t>(dice.below(5)));
            for (const TileEdge edge : kTileEdges) {
                const TileNeighbour neighbour = neighbour_of(tile, edge);
                ASSERT_NE(light_enters(axis, tile, edge), light_enters(axis, neighbour.tile, neighbour.edge));
                ASSERT_EQ(light_enters(axis, tile, edge),
                          light_rank(axis, neighbour.tile) < light_rank(axis, tile));
            }
        }
    });
}

TEST(PlanetFront, BeamsKeepTheirBitsHoweverFinelyTheyAreCounted)
{
    const LightAxis axis = light_axis({0.2, -0.5, 0.4});
    const Vector3 beam = outward_at(axis, 0.375);
    const Vector3 next_turn = outward_at(axis, 1.375);
    EXPECT_EQ(beam.x, next_turn.x);
    EXPECT_EQ(beam.y, next_turn.y);
    EXPECT_EQ(beam.z, next_turn.z);

    const LeavingFront front = {3, 6, {10.0, 20.0, -1.0, 40.0}}; // beams 6, 7, 8 (which is 0) and 9 of 8
    EXPECT_EQ(front.rho_at(0.75), 10.0);
    EXPECT_EQ(front.rho_at(0.875), 20.0);
    EXPECT_EQ(front.rho_at(13.0 / 16.0), 15.0);
    EXPECT_EQ(front.rho_at(0.125), 40.0);
    EXPECT_EQ(front.rho_at(1.125), 40.0);
    EXPECT_EQ(front.rho_at(0.99), 20.0); // one of its two beams did not pass
    EXPECT_EQ(LeavingFront{}.rho_at(0.3), 0.0);
}

TEST(PlanetFront, ASmoothBallIsLitToTheTerminatorAndDarkBeyond)
{
    const MadeGround ground(kBall, {0.0F, 0.0F}, [](const Vector3&) { return 0.0; });
    for_seeds(20, [&](Dice& dice) {
        const LightAxis axis = light_axis(awkward_sun(dice));
        const PlanetTile tile = random_tile(dice, 2);
        const TileShadow shadow = cast_on_tile(kBall, axis, tile, ground.heights_of(tile), {});
        for (std::int32_t row = 0; row <= kTileSquares; ++row)
            for (std::int32_t column = 0; column <= kTileSquares; ++column) {
                const double cosine = dot(sample_direction(tile, row, column), axis.to_sun);
                const float shadow_m =
                    shadow.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
                ASSERT_TRUE(std::abs(cosine) < 0.01 || (shadow_m < 0.0F) == (cosine > 0.0))
                    << row << ' ' << column << ", " << shadow_m;
            }
    });
}

// A tile between a neighbour towards the sun that is there and one that is not.
TEST(PlanetFront, BeginsWithTheNeighboursSamplesOrElseTheAncestors)
{
    const MadeGround ground(kBall, kMountains, mountains_m);
    const LightAxis axis = light_axis({0.3, 0.9, 0.5}); // light on face 0 comes from greater u and v
    const PlanetTile parent = {0, 1, 0, 0};
    const PlanetTile tile = {0, 2, 0, 0};
    const PlanetTile beside = {0, 2, 0, 1};
    const auto cast = [&](const PlanetTile& which, const EnteringLight& entering) {
        return cast_on_tile(kBall, axis, which, ground.heights_of(which), entering);
    };
    ASSERT_TRUE(light_enters(axis, tile, TileEdge::highest_u));
    ASSERT_TRUE(light_enters(axis, tile, TileEdge::highest_v));
    const TileShadow above = cast(parent, {});
    const TileShadow other = cast(beside, {{}, parent, &above});
    EnteringLight entering = {{}, parent, &above};
    entering.neighbours.at(static_cast<std::size_t>(TileEdge::highest_u)) = &other;
    const TileShadow shadow = cast(tile, entering);
    for (std::size_t i = 0; i <= kTileSquares; ++i) {
        EXPECT_EQ(shadow.heights_m(i, kTileSquares), other.heights_m(i, 0));
        const float here_m = shadow.heights_m(kTileSquares, i);
        if (i % 2 == 0) {
            EXPECT_EQ(here_m, above.heights_m(kTileSquares / 2, i / 2));
        } else {
            EXPECT_NEAR(
                here_m,
                (above.heights_m(kTileSquares / 2, i / 2) + above.heights_m(kTileSquares / 2, i / 2 + 1)) / 2,
                1e-3);
        }
    }
}

} // namespace
} // namespace duskline
