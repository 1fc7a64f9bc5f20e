#include "planet/made_ground.h"
#include "planet/tiles_of_level.h"
#include "terrains.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_ray.h>
#include <duskline/planet/planet_shadows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace duskline {
namespace {

const Vector3 kPlace = normalized({0.7, 0.5, 0.2});
const Vector3 kLowSun = {-0.35, 0.75, 0.2};

// Mountains on the earth, made once.
const MadeGround& mountains()
{
    static const MadeGround ground(kWgs84, kMountains, mountains_m);
    return ground;
}

void insert(PlanetShadows& shadows, const std::vector<PlanetTile>& tiles)
{
    for (const PlanetTile& tile : tiles)
        shadows.insert(tile, mountains().shared_heights_of(tile));
}

bool is_lit(const PlanetShadows& shadows, const PlanetTile& tile, std::int32_t row, std::int32_t column)
{
    return mountains().heights_of(tile).height_m(row, column) >= shadows.shadow_of(tile)->heights_m(
               static_cast<std::size_t>(row), static_cast<std::size_t>(column));
}

bool is_lit(const PlanetRays& rays, const PlanetTile& tile, std::int32_t row, std::int32_t column)
{
    return rays.is_lit(sample_direction(tile, row, column),
                       static_cast<double>(mountains().heights_of(tile).height_m(row, column)));
}

// Whether one of the eight samples around has the other answer.
bool is_beside_edge(const PlanetRays& rays, const PlanetTile& tile, std::int32_t row, std::int32_t column)
{
    const bool lit = is_lit(rays, tile, row, column);
    for (std::int32_t r = row - 1; r <= row + 1; ++r)
        for (std::int32_t c = column - 1; c <= column + 1; ++c)
            if (is_lit(rays, tile, r, c) != lit)
                return true;
    return false;
}

struct Share {
    std::size_t samples = 0;
    std::size_t wrong = 0;

    double value() const { return static_cast<double>(wrong) / static_cast<double>(samples); }
};

TEST(PlanetShadows, AreThoseOfRaysButForSamplesBesideShadowEdgesInsideTilesAndOnTheirBorders)
{
    Share inside;
    Share border;
    for (const Vector3& sun : {Vector3{1.0, 0.0, 0.0}, Vector3{1.0, 1.0, 1.0}, Vector3{-0.25, -0.64, 0.72},
                               Vector3{0.1, 0.8, -0.3}}) {
        PlanetShadows shadows(kWgs84, sun);
        insert(shadows, tiles_of_level(1));
        shadows.settle();
        const PlanetRays rays(mountains().at_level(1), sun);
        const Vector3 to_sun = normalized(sun);
        for (const PlanetTile& tile : tiles_of_level(1))
            for (std::int32_t row = 0; row <= kTileSquares; ++row)
                for (std::int32_t column = 0; column <= kTileSquares; ++column) {
                    const bool on_border =
                        row == 0 || column == 0 || row == kTileSquares || column == kTileSquares;
                    const double cosine = dot(sample_direction(tile, row, column), to_sun);
                    // For the first sun the terminator itself, where shadows are longest, is a border of tiles.
                    if ((row * 7 + column) % (on_border ? 5 : 13) != 0 || cosine > 0.6 || cosine < -0.15
                        || std::abs(cosine) < 1e-9)
                        continue;
                    Share& share = on_border ? border : inside;
                    ++share.samples;
                    if (is_lit(shadows, tile, row, column) == is_lit(rays, tile, row, column))
                        continue;
                    ++share.wrong;
                    EXPECT_TRUE(is_beside_edge(rays, tile, row, column))
                        << "face " << tile.face << " row " << row << " column " << column;
                }
    }
    ASSERT_GT(inside.samples, 20000U);
    ASSERT_GT(border.samples, 3000U);
    EXPECT_LT(inside.value(), 0.0005);
    EXPECT_LE(border.value(), inside.value());
}

TEST(PlanetShadows, OfTilesOfALevelAreTheSameBitsOnSharedEdges)
{
    for (const Vector3& sun : {Vector3{0.0, 0.0, 1.0}, Vector3{1.0, -1.0, 0.0}, Vector3{0.4, 0.2, 0.7}}) {
        PlanetShadows shadows(kWgs84, sun);
        insert(shadows, tiles_of_level(1));
        shadows.settle();
        for (const PlanetTile& tile : tiles_of_level(1))
            for (const TileEdge edge : kTileEdges) {
                const TileNeighbour neighbour = neighbour_of(tile, edge);
                const auto sample = [](const PlanetShadows& all, const PlanetTile& of, TileEdge on,
                                       std::size_t i) {
                    const bool high = on == TileEdge::highest_u || on == TileEdge::highest_v;
                    const bool of_u = on == TileEdge::lowest_u || on == TileEdge::highest_u;
                    const std::size_t across = high ? kTileSquares : 0;
                    const auto shadow = all.shadow_of(of);
                    return of_u ? shadow->heights_m(i, across) : shadow->heights_m(across, i);
                };
                for (std::size_t i = 0; i <= kTileSquares; ++i)
                    ASSERT_EQ(sample(shadows, tile, edge, i),
                              sample(shadows, neighbour.tile, neighbour.edge,
                                     neighbour.reversed ? kTileSquares - i : i));
            }
    }
}

// Levels 0 and 1 all over, and deeper tiles around one place: as a camera has them.
std::vector<PlanetTile> tiles_around(const Vector3& place, std::uint32_t deepest)
{
    std::vector<PlanetTile> tiles = tiles_of_level(0);
    const std::vector<PlanetTile> first = tiles_of_level(1);
    tiles.insert(tiles.end(), first.begin(), first.end());
    for (std::uint32_t level = 2; level <= deepest; ++level)
        for (const PlanetTile& tile : children_of(place_in_tile(place, level - 1).tile))
            tiles.push_back(tile);
    return tiles;
}

TEST(PlanetShadows, OfFineTilesAmongCoarseOnesAreNearThoseOfRaysOverFineGround)
{
    PlanetShadows shadows(kWgs84, kLowSun);
    insert(shadows, tiles_around(kPlace, 4));
    shadows.settle();
    const PlanetRays rays(mountains().at_level(4), kLowSun);
    Share share;
    for (const PlanetTile& tile : children_of(place_in_tile(kPlace, 3).tile))
        for (std::int32_t row = 3; row <= kTileSquares; row += 9)
            for (std::int32_t column = 0; column <= kTileSquares; column += 9) {
                ++share.samples;
                share.wrong +=
                    is_lit(shadows, tile, row, column) != is_lit(rays, tile, row, column) ? 1U : 0U;
            }
    EXPECT_LT(share.value(), 0.03);
}

TEST(PlanetShadows, OfTheEdgesOfTheSunsDiscAreThoseOfRaysAndEncloseThoseOfItsMiddle)
{
    constexpr double radius = 0.2666;
    Share share;
    std::vector<PlanetShadows> edges;
    for (const double raised : {radius, 0.0, -radius}) {
        PlanetShadows& shadows = edges.emplace_back(kWgs84, kLowSun, Angle::from_degrees(raised));
        insert(shadows, tiles_of_level(1));
        shadows.settle();
        const PlanetRays rays(mountains().at_level(1), kLowSun, Angle::from_degrees(raised));
        for (const PlanetTile& tile : tiles_of_level(1))
            for (std::int32_t row = 0; row <= kTileSquares; row += 4)
                for (std::int32_t column = row % 8; column <= kTileSquares; column += 8) {
                    ++share.samples;
                    share.wrong +=
                        is_lit(shadows, tile, row, column) != is_lit(rays, tile, row, column) ? 1U : 0U;
                }
    }
    EXPECT_LT(share.value(), 0.0005) << share.wrong << " of " << share.samples;
    for (const PlanetTile& tile : tiles_of_level(1)) {
        const auto upper = edges[0].shadow_of(tile)->heights_m.values();
        const auto middle = edges[1].shadow_of(tile)->heights_m.values();
        const auto lower = edges[2].shadow_of(tile)->heights_m.values();
        for (std::size_t i = 0; i < middle.size(); ++i) {
            ASSERT_LE(upper[i], middle[i]);
            ASSERT_LE(middle[i], lower[i]);
        }
    }
}

TEST(PlanetShadows, OfADiscAreThoseOfBothItsEdgesWhereTheseDecide)
{
    const Angle radius = Angle::from_degrees(0.2666);
    PlanetShadows disc = PlanetShadows::of_disc(kWgs84, kLowSun, radius);
    PlanetShadows lower(kWgs84, kLowSun, -radius);
    PlanetShadows upper(kWgs84, kLowSun, radius);
    for (PlanetShadows* shadows : {&disc, &lower, &upper}) {
        insert(*shadows, tiles_of_level(1));
        shadows->settle();
    }
    std::size_t dark = 0;
    for (const PlanetTile& tile : tiles_of_level(1))
        for (std::size_t row = 0; row <= kTileSquares; ++row)
            for (std::size_t column = 0; column <= kTileSquares; ++column) {
                const auto shadow = disc.shadow_of(tile);
                const float ground_m = mountains().heights_of(tile).height_m(
                    static_cast<std::int32_t>(row), static_cast<std::int32_t>(column));
                ASSERT_EQ(shadow->heights_m(row, column), lower.shadow_of(tile)->heights_m(row, column));
                const float upper_m = upper.shadow_of(tile)->heights_m(row, column);
                ASSERT_LE(shadow->dark_m(row, column), upper_m);
                if (upper_m > ground_m) {
                    ++dark;
                    ASSERT_EQ(shadow->dark_m(row, column), upper_m);
                }
            }
    EXPECT_GT(dark, 10000U);
}

TEST(PlanetShadows, OfADiscNeedARadius)
{
    EXPECT_THROW(PlanetShadows::of_disc(kWgs84, kLowSun, {}), InvalidInput);
    EXPECT_THROW(PlanetShadows::of_disc(kWgs84, kLowSun, Angle::from_degrees(6.0)), InvalidInput);
}

// A tile, those across its edges, those across theirs and so on, and all ancestors.
std::set<PlanetTile> tiles_around_tile(const PlanetTile& tile, int rings)
{
    std::set<PlanetTile> tiles = {tile};
    for (int ring = 0; ring < rings; ++ring)
        for (const PlanetTile& inner : std::set<PlanetTile>(tiles))
            for (const TileEdge edge : kTileEdges)
                tiles.insert(neighbour_of(inner, edge).tile);
    for (const PlanetTile& fine : std::set<PlanetTile>(tiles))
        for (std::uint32_t level = 0; level < fine.level; ++level)
            tiles.insert(ancestor_of(fine, level));
    return tiles;
}

TEST(PlanetShadows, AreThoseOfRaysOnFineTilesAroundCornersAndEdgesOfTheCube)
{
    Share share;
    std::size_t dark = 0;
    for (const Vector3& place : {Vector3{1.0, 1.0, 1.0}, Vector3{-1.0, 0.2, 1.0}}) {
        const PlanetTile middle = place_in_tile(place, 4).tile;
        const LocalFrame frame = local_frame(kWgs84, centre_direction(middle));
        const Vector3 sun = frame.up * 0.02 + frame.east * 0.3 - frame.north * 0.9;
        PlanetShadows shadows(kWgs84, sun);
        for (const PlanetTile& tile : tiles_around_tile(middle, 2))
            shadows.insert(tile, mountains().shared_heights_of(tile));
        shadows.settle();
        const PlanetRays rays(mountains().at_level(4), sun);
        for (const PlanetTile& tile : tiles_around_tile(middle, 1)) {
            if (tile.level < 4)
                continue;
            for (std::int32_t row = 0; row <= kTileSquares; row += 8)
                for (std::int32_t column = 0; column <= kTileSquares; column += 8) {
                    const bool lit = is_lit(rays, tile, row, column);
                    ++share.samples;
                    share.wrong += is_lit(shadows, tile, row, column) != lit ? 1U : 0U;
                    dark += lit ? 0U : 1U;
                }
        }
    }
    EXPECT_GT(dark, share.samples / 20);
    EXPECT_LT(dark, share.samples);
    EXPECT_LT(share.value(), 0.003) << share.wrong << " of " << share.samples << ", " << dark << " dark";
}

// The part of a disc that stands over a level horizon: -1 at its lower edge, 1 at its upper one.
double disc_above(double horizon)
{
    const double t = std::clamp(horizon, -1.0, 1.0);
    return 0.5 - (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
}

// As visible_disc.glsl has it.
double part_seen(double ground_m, double dark_m, double lit_m)
{
    if (ground_m >= lit_m)
        return 1.0;
    return ground_m < dark_m ? 0.0 : disc_above(2.0 * (lit_m - ground_m) / (lit_m - dark_m) - 1.0);
}

// Rays to points all over the sun's disc, equal parts of it each.
class RaysToDisc {
public:
    RaysToDisc(const PlanetLevel& ground, const Vector3& to_sun, Angle radius)
    {
        constexpr int points = 40;
        const LightAxis axis = light_axis(to_sun);
        for (int i = 0; i < points; ++i) {
            const double away = tangent(radius) * std::sqrt((i + 0.5) / points);
            const double turn = 2.399963 * i; // the golden angle
            rays_.emplace_back(
                ground, axis.to_sun + (axis.across * std::cos(turn) + axis.aside * std::sin(turn)) * away);
        }
    }
    double part_seen(const PlanetTile& tile, std::int32_t row, std::int32_t column) const
    {
        const auto lit = std::ranges::count_if(
            rays_, [&](const PlanetRays& rays) { return is_lit(rays, tile, row, column); });
        return static_cast<double>(lit) / static_cast<double>(rays_.size());
    }

private:
    std::vector<PlanetRays> rays_;
};

TEST(PlanetShadows, OfADiscSeeAsMuchOfItAsRaysToAllOfItDo)
{
    const Angle radius = Angle::from_degrees(0.2666);
    const PlanetTile middle = place_in_tile(kPlace, 6).tile;
    const LocalFrame frame = local_frame(kWgs84, centre_direction(middle));
    const Vector3 sun = frame.up * 0.05 + frame.east * 0.3 - frame.north * 0.9;
    PlanetShadows shadows = PlanetShadows::of_disc(kWgs84, sun, radius);
    PlanetShadows upper(kWgs84, sun, radius);
    for (PlanetShadows* each : {&shadows, &upper}) {
        for (const PlanetTile& tile : tiles_around_tile(middle, 2))
            each->insert(tile, mountains().shared_heights_of(tile));
        each->settle();
    }
    const RaysToDisc disc(mountains().at_level(6), sun, radius);
    double error = 0.0;
    double error_of_two_shadows = 0.0;
    std::size_t half = 0;
    for (const PlanetTile& tile : tiles_around_tile(middle, 1)) {
        const auto shadow = shadows.shadow_of(tile);
        for (std::int32_t row = 0; row <= kTileSquares && tile.level == 6; row += 2)
            for (std::int32_t column = 0; column <= kTileSquares; ++column) {
                const auto r = static_cast<std::size_t>(row);
                const auto c = static_cast<std::size_t>(column);
                const auto ground_m = static_cast<double>(mountains().heights_of(tile).height_m(row, column));
                const auto lit_m = static_cast<double>(shadow->heights_m(r, c));
                const double seen = part_seen(ground_m, static_cast<double>(shadow->dark_m(r, c)), lit_m);
                if (seen == 0.0 || seen == 1.0)
                    continue;
                ++half;
                const double truth = disc.part_seen(tile, row, column);
                const auto upper_m = static_cast<double>(upper.shadow_of(tile)->heights_m(r, c));
                error += std::abs(seen - truth);
                error_of_two_shadows += std::abs(part_seen(ground_m, upper_m, lit_m) - truth);
            }
    }
    ASSERT_GT(half, 100U);
    EXPECT_LT(error / static_cast<double>(half), 0.09);
    EXPECT_LT(error, 0.5 * error_of_two_shadows);
    RecordProperty("half_shadow_samples", std::to_string(half));
    RecordProperty("mean_error_of_two_shadows",
                   std::to_string(error_of_two_shadows / static_cast<double>(half)));
    RecordProperty("mean_error", std::to_string(error / static_cast<double>(half)));
}

bool same_shadows(const PlanetShadows& a, const PlanetShadows& b, const std::vector<PlanetTile>& tiles)
{
    return std::all_of(tiles.begin(), tiles.end(), [&](const PlanetTile& tile) {
        const auto x = a.shadow_of(tile)->heights_m.values();
        const auto y = b.shadow_of(tile)->heights_m.values();
        return std::equal(x.begin(), x.end(), y.begin());
    });
}

TEST(PlanetShadows, SettleToTheSameBitsWhateverHappenedBefore)
{
    const std::vector<PlanetTile> tiles = tiles_around(kPlace, 3);
    PlanetShadows expected(kWgs84, kLowSun);
    insert(expected, tiles);
    expected.settle({.threads = 1});
    for_seeds(3, [&](Dice& dice) {
        PlanetShadows shadows(kWgs84, {1.0, 0.0, 0.0});
        std::vector<PlanetTile> order = tiles;
        for (std::size_t i = order.size(); i > 1; --i)
            std::swap(order[i - 1], order[dice.below(i)]);
        const PlanetTile passing = {2, 2, 1, 1};
        shadows.insert(passing, mountains().shared_heights_of(passing));
        for (const PlanetTile& tile : order) {
            shadows.insert(tile, mountains().shared_heights_of(tile));
            if (dice.chance(0.3))
                shadows.set_sun({dice.between(-1.0, 1.0), 0.7, 0.1});
            shadows.update(dice.below(4));
        }
        const PlanetTile again = order[dice.below(order.size())];
        shadows.erase(again);
        shadows.update(3);
        shadows.insert(again, mountains().shared_heights_of(again));
        shadows.erase(passing);
        shadows.set_sun(kLowSun);
        shadows.settle();
        EXPECT_TRUE(shadows.settled());
        EXPECT_EQ(shadows.shadow_of(passing), nullptr);
        EXPECT_TRUE(same_shadows(shadows, expected, tiles));
    });
}

TEST(PlanetShadows, ShowANewSunOnlyWhenAllTilesHaveIt)
{
    const std::vector<PlanetTile> tiles = tiles_of_level(1);
    PlanetShadows shadows(kWgs84, kLowSun);
    insert(shadows, tiles);
    shadows.settle();
    PlanetShadows old(kWgs84, kLowSun);
    insert(old, tiles);
    old.settle();
    const Vector3 next = {-0.36, 0.74, 0.2};
    shadows.set_sun(next);
    std::size_t done = 0;
    while (true) {
        EXPECT_TRUE(same_shadows(shadows, old, tiles)) << "after " << done;
        const std::size_t now = shadows.update(5);
        EXPECT_LE(now, 5U);
        ASSERT_GT(now, 0U);
        done += now;
        if (shadows.settled())
            break;
    }
    EXPECT_EQ(done, tiles.size());
    EXPECT_FALSE(same_shadows(shadows, old, tiles));
    PlanetShadows expected(kWgs84, next);
    insert(expected, tiles);
    expected.settle();
    EXPECT_TRUE(same_shadows(shadows, expected, tiles));
    EXPECT_EQ(shadows.update(5), 0U);
}

// A sun that moves at a steady pace over level 1, in as many frames a sun as budget and tiles make it.
class MovingSun {
public:
    explicit MovingSun(double degrees_a_frame) : step_(degrees_a_frame), shadows_(kWgs84, sun_after(0.0))
    {
        insert(shadows_, tiles_of_level(1));
        shadows_.settle();
    }

    void next_frame()
    {
        shadows_.set_sun(sun());
        shadows_.update(5);
        frame_ += 1.0;
    }
    void rest() { frame_ -= 1.0; }

    Vector3 sun() const { return sun_after(frame_); }
    Vector3 last_sun() const { return sun_after(frame_ - 1.0); }
    PlanetShadows& shadows() { return shadows_; }

    double degrees_behind() const
    {
        return Angle::from_radians(length(shadows_.shown_sun() - last_sun())).degrees();
    }

    // Of samples by daylight: those that rays to the sun that was set see otherwise.
    Share wrong() const
    {
        const PlanetRays rays(mountains().at_level(1), last_sun());
        Share share;
        for (const PlanetTile& tile : tiles_of_level(1)) {
            const ShownShadow shown = shadows_.shown(tile);
            for (std::int32_t row = 0; row <= kTileSquares; row += 5)
                for (std::int32_t column = 0; column <= kTileSquares; column += 5) {
                    if (std::abs(dot(sample_direction(tile, row, column), last_sun())) > 0.2)
                        continue;
                    ++share.samples;
                    const bool lit = static_cast<double>(mountains().heights_of(tile).height_m(row, column))
                                     >= shown_height_m(shown, static_cast<std::size_t>(row),
                                                       static_cast<std::size_t>(column));
                    share.wrong += lit != is_lit(rays, tile, row, column) ? 1U : 0U;
                }
        }
        return share;
    }

private:
    Vector3 sun_after(double frames) const
    {
        const auto [sine, cosine] = sine_cosine(Angle::from_degrees(step_ * frames));
        return normalized(Vector3{0.8 * cosine, 0.8 * sine, 0.25});
    }

    static double shown_height_m(const ShownShadow& shown, std::size_t row, std::size_t column)
    {
        const auto first_m = static_cast<double>(shown.first->heights_m(row, column));
        if (!shown.second)
            return first_m;
        return first_m + shown.share * (static_cast<double>(shown.second->heights_m(row, column)) - first_m);
    }

    double step_;
    double frame_ = 0.0;
    PlanetShadows shadows_;
};

TEST(PlanetShadows, AreThoseOfTheSunThatIsSetWhileItMovesSteadily)
{
    constexpr double degrees_a_frame = 0.1;
    MovingSun moving(degrees_a_frame);
    Share wrong;
    for (int frame = 0; frame < 60; ++frame) {
        moving.next_frame();
        if (frame < 20)
            continue;
        // It is the nearest place of a straight way.
        EXPECT_LT(moving.degrees_behind(), 0.05 * degrees_a_frame) << frame;
        if (frame % 4 == 0) {
            const Share now = moving.wrong();
            wrong.samples += now.samples;
            wrong.wrong += now.wrong;
        }
    }
    EXPECT_GT(wrong.samples, 10000U);
    EXPECT_LT(wrong.value(), 0.004) << wrong.wrong << " of " << wrong.samples;
}

TEST(PlanetShadows, AreThoseOfTheSunAloneWhenItStandsAgain)
{
    MovingSun moving(0.1);
    for (int frame = 0; frame < 33; ++frame)
        moving.next_frame();
    const std::size_t tiles = tiles_of_level(1).size();
    for (std::size_t frame = 0; frame <= tiles / 5 + 1; ++frame) {
        moving.rest();
        moving.next_frame();
    }
    EXPECT_TRUE(moving.shadows().settled()) << "what was computed ahead is given up";
    PlanetShadows expected(kWgs84, moving.last_sun());
    insert(expected, tiles_of_level(1));
    expected.settle();
    EXPECT_TRUE(same_shadows(moving.shadows(), expected, tiles_of_level(1)));
    for (const PlanetTile& tile : tiles_of_level(1))
        EXPECT_EQ(moving.shadows().shown(tile).second, nullptr);
}

TEST(PlanetShadows, FollowASunThatIsDraggedToAndFro)
{
    const std::vector<PlanetTile> tiles = tiles_of_level(1);
    PlanetShadows shadows(kWgs84, kLowSun);
    insert(shadows, tiles);
    shadows.settle();
    for_seeds(2, [&](Dice& dice) {
        double x = 0.0;
        for (int frame = 0; frame < 40; ++frame) {
            x = std::clamp(x + dice.between(-0.01, 0.01), -0.05, 0.05);
            shadows.set_sun(kLowSun + Vector3{x, 0.0, 0.0});
            shadows.update(4);
            // Within the suns it has been at.
            EXPECT_LT(length(shadows.shown_sun() - normalized(kLowSun)), 0.09);
            for (const PlanetTile& tile : tiles)
                ASSERT_NE(shadows.shown(tile).first, nullptr);
        }
        shadows.settle();
        PlanetShadows expected(kWgs84, kLowSun + Vector3{x, 0.0, 0.0});
        insert(expected, tiles);
        expected.settle();
        EXPECT_TRUE(same_shadows(shadows, expected, tiles));
    });
}

TEST(PlanetShadows, AnswerTilesThatComeWhileTheSunMovesOn)
{
    PlanetShadows shadows(kWgs84, kLowSun);
    insert(shadows, tiles_of_level(1));
    shadows.settle();
    double x = -0.35;
    for (const PlanetTile& tile : children_of(place_in_tile(kPlace, 1).tile)) {
        shadows.insert(tile, mountains().shared_heights_of(tile));
        shadows.set_sun({x += 0.001, 0.75, 0.2});
        shadows.update(4);
        EXPECT_NE(shadows.shadow_of(tile), nullptr);
    }
}

TEST(PlanetShadows, StopWhenTheyAreAskedTo)
{
    PlanetShadows shadows(kWgs84, kLowSun);
    insert(shadows, tiles_of_level(1));
    EXPECT_THROW(shadows.settle({.progress = [](double) { return false; }}), Cancelled);
    EXPECT_FALSE(shadows.settled());
    shadows.settle();
    EXPECT_TRUE(shadows.settled());
}

} // namespace
} // namespace duskline
