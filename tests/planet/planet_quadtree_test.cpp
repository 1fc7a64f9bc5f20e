#include "hilly_planet.h"

#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_flight.h>
#include <duskline/planet/planet_quadtree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <unordered_map>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr std::size_t kAll = 100000;
constexpr std::size_t kWidth = 1024;
constexpr std::size_t kHeight = 768;
constexpr double kPixelsPerRadian = 768.0 / (2.0 * 0.41421356);

// On the ground, near it and in space, looking anywhere.
PlanetCamera any_camera(const PlanetTerrain& terrain, std::mt19937& random)
{
    std::uniform_real_distribution<double> share(0.0, 1.0);
    PlanetCamera camera = camera_over(
        terrain.globe(),
        {Angle::from_degrees(360.0 * share(random)), Angle::from_degrees(180.0 * share(random) - 90.0)},
        2.0 * std::pow(5e4, share(random)));
    camera.heading = Angle::from_degrees(360.0 * share(random));
    camera.pitch = Angle::from_degrees(-60.0 * share(random) + 5.0);
    return kept_above_ground(camera, terrain, 2.0);
}

PlanetCamera lowered(PlanetCamera camera, const Globe& globe)
{
    camera.eye_m = point_m(globe, normalized(camera.eye_m), -1000.0);
    return camera;
}

// What is drawn, by tile.
class Drawn {
public:
    explicit Drawn(const PlanetQuadtree& quadtree) : quadtree_(quadtree)
    {
        for (const PlanetPatch& patch : quadtree.patches())
            patches_.emplace(patch.tile, patch.morph);
    }

    std::size_t times_at(const Vector3& direction) const
    {
        std::size_t times = 0;
        for (std::uint32_t level = 0; level <= quadtree_.terrain().deepest_level(); ++level)
            times += patches_.count(place_in_tile(direction, level).tile);
        return times;
    }

    // The drawn tile at or above a tile.
    std::optional<PlanetTile> covering(const PlanetTile& tile) const
    {
        for (std::uint32_t up = 0; up <= tile.level; ++up)
            if (patches_.count(ancestor_of(tile, tile.level - up)) != 0)
                return ancestor_of(tile, tile.level - up);
        return std::nullopt;
    }

    // A vertex as the renderer makes it.
    Vector3 vertex_m(const PlanetTile& tile, std::int32_t row, std::int32_t column,
                     const Vector3& eye_m) const
    {
        const Vector3 own = own_m(tile, row, column);
        if (tile.level == 0)
            return own;
        const Vector3 parents = (own_in_parent_m(tile, row & ~1, column & ~1)
                                 + own_in_parent_m(tile, row + (row & 1), column + (column & 1)))
                                * 0.5;
        const MorphRange morph = patches_.at(tile);
        const double turned =
            std::clamp((length(parents - eye_m) - morph.begin_m) / (morph.end_m - morph.begin_m), 0.0, 1.0);
        return own + (parents - own) * turned;
    }

private:
    Vector3 own_m(const PlanetTile& tile, std::int32_t row, std::int32_t column) const
    {
        return sample_point_m(quadtree_.terrain().globe(), tile, quadtree_.heights_of(tile), row, column);
    }
    Vector3 own_in_parent_m(const PlanetTile& tile, std::int32_t row, std::int32_t column) const
    {
        constexpr std::int32_t half = kTileSquares / 2;
        return own_m(parent_of(tile), static_cast<std::int32_t>(tile.row % 2) * half + row / 2,
                     static_cast<std::int32_t>(tile.column % 2) * half + column / 2);
    }

    const PlanetQuadtree& quadtree_;
    std::unordered_map<PlanetTile, MorphRange> patches_;
};

struct Sample {
    std::int32_t row;
    std::int32_t column;
};

Sample along_edge(TileEdge edge, std::int32_t i)
{
    switch (edge) {
    case TileEdge::lowest_u:
        return {i, 0};
    case TileEdge::highest_u:
        return {i, kTileSquares};
    case TileEdge::lowest_v:
        return {0, i};
    default:
        return {kTileSquares, i};
    }
}

// The greatest gap in pixels along the edge of a drawn tile to what is drawn beyond it, if that is not finer.
double gap_pixels(const Drawn& drawn, const PlanetTile& tile, TileEdge edge, const Vector3& eye_m)
{
    const TileNeighbour beyond = neighbour_of(tile, edge);
    const auto other = drawn.covering(beyond.tile);
    if (!other)
        return 0.0; // finer, or out of view
    const std::uint32_t coarser = tile.level - other->level;
    EXPECT_LE(coarser, 1U);
    if (coarser > 1)
        return 1e9;
    // The neighbour's samples among those of the coarser tile.
    const auto first = [&](std::uint32_t index) { return coarser == 1 && index % 2 == 1 ? kTileSquares : 0; };
    const auto vertex_beyond = [&](std::int32_t i) {
        const Sample s = along_edge(beyond.edge, beyond.reversed ? kTileSquares - i : i);
        const std::int32_t row = s.row + first(beyond.tile.row);
        const std::int32_t column = s.column + first(beyond.tile.column);
        return drawn.vertex_m(*other, row >> coarser, column >> coarser, eye_m);
    };
    double worst = 0.0;
    for (std::int32_t i = 0; i <= kTileSquares; ++i) {
        const Sample s = along_edge(edge, i);
        const Vector3 here = drawn.vertex_m(tile, s.row, s.column, eye_m);
        const Vector3 there = coarser == 1 && i % 2 == 1 ? (vertex_beyond(i - 1) + vertex_beyond(i + 1)) * 0.5
                                                         : vertex_beyond(i);
        worst = std::max(worst, length(here - there) / length(here - eye_m) * kPixelsPerRadian);
    }
    return worst;
}

// How many of the edges lie between levels.
std::size_t expect_no_cracks(const PlanetQuadtree& quadtree, const Vector3& eye_m)
{
    const Drawn drawn(quadtree);
    std::size_t changes_of_level = 0;
    for (const PlanetPatch& patch : quadtree.patches())
        for (const TileEdge edge : kTileEdges) {
            EXPECT_LT(gap_pixels(drawn, patch.tile, edge, eye_m), 1e-3)
                << patch.tile.face << ' ' << patch.tile.level << ' ' << patch.tile.row << ' '
                << patch.tile.column;
            const auto beyond = drawn.covering(neighbour_of(patch.tile, edge).tile);
            changes_of_level += static_cast<std::size_t>(beyond && beyond->level < patch.tile.level);
        }
    return changes_of_level;
}

bool is_seen(const PlanetTerrain& terrain, const PlanetCamera& camera, const Vector3& point)
{
    const OrientedBox box = {point, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}, {}};
    if (!PlanetFrustum(terrain.globe(), camera, static_cast<double>(kWidth) / kHeight).may_see(box))
        return false;
    // Marching to it, never below the lowest ground of all.
    for (double share = 0.0; share < 1.0; share += 1.0 / 256.0)
        if (height_m(terrain.globe(), camera.eye_m + (point - camera.eye_m) * share)
            < terrain.heights().lowest_m)
            return false;
    return true;
}

TEST(PlanetQuadtree, CoversWhatIsSeenExactlyOnce)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    std::mt19937 random(21);
    std::normal_distribution<double> aside(0.0, 1.0);
    std::uniform_real_distribution<double> magnitude(-4.0, 0.5);
    std::size_t seen = 0;
    for (int i = 0; i < 7; ++i) {
        const PlanetCamera camera = any_camera(terrain, random);
        quadtree.update(camera, kWidth, kHeight, kAll);
        ASSERT_TRUE(quadtree.settled());
        const Drawn drawn(quadtree);
        for (int k = 0; k < 2000; ++k) {
            const Vector3 step = {aside(random), aside(random), aside(random)};
            const Vector3 direction =
                normalized(normalized(camera.eye_m) + step * std::pow(10.0, magnitude(random)));
            const Vector3 point =
                point_m(terrain.globe(), direction, terrain.height_m(direction, terrain.deepest_level()));
            const std::size_t times = drawn.times_at(direction);
            EXPECT_LE(times, 1U);
            if (is_seen(terrain, camera, point)) {
                ++seen;
                EXPECT_EQ(times, 1U) << i << ' ' << k;
            }
        }
    }
    EXPECT_GT(seen, 250U);
}

TEST(PlanetQuadtree, HasNoCracksBetweenTilesOfAnyLevels)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    std::mt19937 random(22);
    std::size_t changes_of_level = 0;
    for (const double over_ground_m : {2.0, 30.0, 400.0, 3000.0, 40000.0}) {
        const PlanetCamera camera =
            kept_above_ground(lowered(any_camera(terrain, random), terrain.globe()), terrain, over_ground_m);
        quadtree.update(camera, kWidth, kHeight, kAll);
        changes_of_level += expect_no_cracks(quadtree, camera.eye_m);
    }
    EXPECT_GT(changes_of_level, 10U);
}

TEST(PlanetQuadtree, HasNoCracksWhileTilesAreLoading)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {44_deg, 34_deg}, 0.0), terrain, 20.0);
    std::size_t frames = 0;
    std::uint32_t finest = 0;
    for (; frames < 100; ++frames) {
        quadtree.update(camera, kWidth, kHeight, 12);
        expect_no_cracks(quadtree, camera.eye_m);
        std::uint32_t here = 0;
        for (const PlanetPatch& patch : quadtree.patches())
            here = std::max(here, patch.tile.level);
        EXPECT_GE(here, finest);
        finest = here;
        if (quadtree.settled())
            break;
    }
    EXPECT_GT(frames, 5U);
    EXPECT_LT(frames, 100U);
    EXPECT_EQ(finest, terrain.deepest_level());
}

TEST(PlanetQuadtree, LoadsNoMoreInAFrameThanItMay)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {100_deg, 10_deg}, 0.0), terrain, 5.0);
    std::size_t before = quadtree.tiles().size();
    for (int frame = 0; frame < 4; ++frame) {
        quadtree.update(camera, kWidth, kHeight, 8);
        EXPECT_LE(quadtree.tiles().size(), before + 8);
        before = quadtree.tiles().size();
    }
    quadtree.update(camera, kWidth, kHeight, 0);
    EXPECT_EQ(quadtree.tiles().size(), before);
    EXPECT_FALSE(quadtree.settled());
    EXPECT_FALSE(quadtree.patches().empty());
}

TEST(PlanetQuadtree, KeepsWithinItsMemoryOnAFlightDown)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.most_tiles = 100});
    for (int frame = 0; frame <= 20; ++frame) {
        const PlanetCamera camera =
            fly_down(terrain, {.place = {150_deg, -40_deg}, .from_m = 1e5, .to_m = 2.0}, frame / 20.0);
        quadtree.update(camera, kWidth, kHeight, 24);
        EXPECT_LE(quadtree.tiles().size(), 100U);
        EXPECT_LE(quadtree.tiles().bytes(), 100 * kTileStored * kTileStored * 5);
        for (const PlanetPatch& patch : quadtree.patches()) {
            EXPECT_NE(quadtree.tiles().find(patch.tile), nullptr);
            if (patch.tile.level > 0) {
                EXPECT_NE(quadtree.tiles().find(parent_of(patch.tile)), nullptr);
            }
        }
    }
}

TEST(PlanetQuadtree, TellsWhichTilesCameAndWent)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.most_tiles = 100});
    std::unordered_map<PlanetTile, std::shared_ptr<const TileHeights>> there;
    std::size_t gone = 0;
    for (int frame = 0; frame < 12; ++frame) {
        PlanetCamera camera =
            camera_over(terrain.globe(), {Angle::from_degrees(40.0 * frame), 20_deg}, 3000.0);
        camera.pitch = Angle::from_degrees(-40.0);
        quadtree.update(camera, kWidth, kHeight, 20);
        for (const TileCache::Change& change : quadtree.changes()) {
            if (change.came) {
                EXPECT_TRUE(there.emplace(change.tile, nullptr).second);
            } else {
                EXPECT_EQ(there.erase(change.tile), 1U);
                ++gone;
            }
        }
        EXPECT_EQ(there.size(), quadtree.tiles().size());
        for (const auto& [tile, heights] : there)
            EXPECT_NE(quadtree.tiles().find(tile), nullptr);
    }
    EXPECT_GT(gone, 0U);
    EXPECT_EQ(quadtree.shared_heights_of({0, 0, 0, 0}).get(), &quadtree.heights_of({0, 0, 0, 0}));
}

TEST(PlanetQuadtree, DrawsCoarselyWhatDoesNotFitIntoMemory)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.most_tiles = 64});
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {10_deg, 10_deg}, 0.0), terrain, 5.0);
    for (int frame = 0; frame < 20; ++frame)
        quadtree.update(camera, kWidth, kHeight, kAll);
    EXPECT_TRUE(quadtree.settled());
    EXPECT_LE(quadtree.tiles().size(), 64U);
    expect_no_cracks(quadtree, camera.eye_m);
}

TEST(PlanetQuadtree, DrawsTheNearestGroundFinestAndSquaresNoLargerThanAsked)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.square_pixels = 4.0});
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {10_deg, 10_deg}, 0.0), terrain, 2.0);
    quadtree.update(camera, kWidth, kHeight, kAll);
    for (const PlanetPatch& patch : quadtree.patches()) {
        const double distance = distance_m(camera.eye_m, quadtree.tiles().find(patch.tile)->box);
        if (patch.tile.level < terrain.deepest_level()) {
            EXPECT_LE(spacing_m(terrain.globe(), patch.tile.level) / distance * kPixelsPerRadian, 4.0 + 1e-9);
        }
        EXPECT_LT(patch.morph.begin_m, patch.morph.end_m);
    }
    // From space all of the disc, coarsely.
    quadtree.update(camera_over(terrain.globe(), {10_deg, 10_deg}, 1e6), kWidth, kHeight, kAll);
    EXPECT_TRUE(
        std::ranges::all_of(quadtree.patches(), [](const PlanetPatch& p) { return p.tile.level <= 2; }));
}

TEST(PlanetQuadtree, FindsTheSamePatchesOnAnyNumberOfThreads)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree one(terrain);
    PlanetQuadtree many(terrain);
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {-70_deg, 10_deg}, 0.0), terrain, 50.0);
    for (int frame = 0; frame < 6; ++frame) {
        one.update(camera, 256, 192, 20, {.threads = 1});
        many.update(camera, 256, 192, 20, {.threads = 4});
        ASSERT_EQ(one.patches().size(), many.patches().size());
        for (std::size_t i = 0; i < one.patches().size(); ++i) {
            EXPECT_EQ(one.patches()[i].tile, many.patches()[i].tile);
            EXPECT_EQ(one.patches()[i].morph.end_m, many.patches()[i].morph.end_m);
        }
    }
}

TEST(PlanetQuadtree, LooksAroundWhenAsked)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.look_around = true});
    PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {-70_deg, 10_deg}, 0.0), terrain, 50.0);
    quadtree.update(camera, kWidth, kHeight, kAll);
    camera = turned(camera, 150_deg, {});
    quadtree.update(camera, kWidth, kHeight, 0);
    EXPECT_TRUE(quadtree.settled());
}

// Four kilometres each way.
OrientedBox box_around_eye(const Globe& globe, const PlanetCamera& camera)
{
    const LocalFrame frame = local_frame(globe, normalized(camera.eye_m));
    return {camera.eye_m, {frame.east, frame.north, frame.up}, {4000.0, 4000.0, 4000.0}};
}

TEST(PlanetQuadtree, CastersCoverTheLightBoxOnceAndAsFinelyAsDrawn)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {20_deg, 10_deg}, 0.0), terrain, 50.0);
    quadtree.update(camera, kWidth, kHeight, kAll);
    const OrientedBox box = box_around_eye(terrain.globe(), camera);
    const std::vector<PlanetPatch> casters = quadtree.casters(box);
    const auto times_at = [&](const Vector3& direction) {
        return std::ranges::count_if(casters, [&](const PlanetPatch& patch) {
            return place_in_tile(direction, patch.tile.level).tile == patch.tile;
        });
    };
    std::mt19937 random(23);
    std::uniform_real_distribution<double> side(-3900.0, 3900.0);
    for (int i = 0; i < 500; ++i) {
        const Vector3 direction =
            normalized(camera.eye_m + box.axes[0] * side(random) + box.axes[1] * side(random));
        EXPECT_EQ(times_at(direction), 1);
    }
    EXPECT_EQ(times_at(normalized(camera.eye_m) * -1.0), 0);
    for (const PlanetPatch& patch : casters) {
        const bool drawn = std::ranges::any_of(quadtree.patches(),
                                               [&](const PlanetPatch& p) { return p.tile == patch.tile; });
        const PlanetFrustum frustum(terrain.globe(), camera, static_cast<double>(kWidth) / kHeight);
        EXPECT_TRUE(drawn || !frustum.may_see(quadtree.tiles().find(patch.tile)->box)
                    || length(camera.eye_m) > 0.0);
        EXPECT_NO_FATAL_FAILURE(quadtree.heights_of(patch.tile));
    }
}

// Pixels of a patch's squares where they are largest.
double pixels_of_squares(const PlanetQuadtree& quadtree, const PlanetPatch& patch, const Vector3& eye_m)
{
    const double square_m = patch.step * spacing_m(quadtree.terrain().globe(), patch.tile.level);
    return square_m * kPixelsPerRadian / distance_m(eye_m, quadtree.tiles().find(patch.tile)->box);
}

TEST(PlanetQuadtree, SkipsAsManyCornersAsMakeSquaresOfTwoPixels)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    std::array<std::size_t, kLargestPatchStep + 1> patches_of_step = {};
    for (const double over_ground_m : {5.0, 2000.0, 300000.0, 4e6}) {
        const PlanetCamera camera =
            kept_above_ground(camera_over(terrain.globe(), {20_deg, 10_deg}, 0.0), terrain, over_ground_m);
        quadtree.update(camera, kWidth / 16, kHeight / 16, kAll);
        for (const PlanetPatch& patch : quadtree.patches()) {
            ++patches_of_step.at(patch.step);
            const double pixels = pixels_of_squares(quadtree, patch, camera.eye_m) / 16.0;
            EXPECT_TRUE(patch.step == 1 || pixels <= 2.0001) << patch.step << ": " << pixels;
            EXPECT_TRUE(patch.step == kLargestPatchStep || pixels >= 0.9999) << patch.step << ": " << pixels;
        }
    }
    for (const std::size_t step : {2U, 4U})
        EXPECT_GT(patches_of_step.at(step), 0U) << step;
}

TEST(PlanetQuadtree, SkipsNoCornersThatItsOptionsAskFor)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain, {.square_pixels = 0.5});
    const PlanetCamera camera = camera_over(terrain.globe(), {20_deg, 10_deg}, 1e6);
    quadtree.update(camera, kWidth / 16, kHeight / 16, kAll);
    for (const PlanetPatch& patch : quadtree.patches())
        EXPECT_TRUE(patch.step == 1 || pixels_of_squares(quadtree, patch, camera.eye_m) / 16.0 <= 0.5001);
}

TEST(PlanetQuadtree, SkipsCornersOfCastersThatAreFinerThanTheTexels)
{
    const PlanetTerrain terrain = small_planet();
    PlanetQuadtree quadtree(terrain);
    const PlanetCamera camera =
        kept_above_ground(camera_over(terrain.globe(), {20_deg, 10_deg}, 0.0), terrain, 50.0);
    quadtree.update(camera, kWidth, kHeight, kAll);
    const OrientedBox box = box_around_eye(terrain.globe(), camera);
    const std::vector<PlanetPatch> fine = quadtree.casters(box);
    const double texel_m = 4.0 * spacing_m(terrain.globe(), terrain.deepest_level());
    const std::vector<PlanetPatch> coarse = quadtree.casters(box, texel_m);
    ASSERT_EQ(fine.size(), coarse.size());
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        EXPECT_EQ(fine[i].tile, coarse[i].tile);
        EXPECT_GE(coarse[i].step, fine[i].step);
        if (coarse[i].step == fine[i].step)
            continue;
        ++skipped;
        EXPECT_LE(coarse[i].step * spacing_m(terrain.globe(), coarse[i].tile.level), 1.0001 * texel_m);
    }
    EXPECT_GT(skipped, 3U);
}

TEST(PlanetQuadtree, RefusesOptionsAndPicturesThatAreNone)
{
    const PlanetTerrain terrain = small_planet();
    EXPECT_THROW(PlanetQuadtree(terrain, {.square_pixels = 0.0}), InvalidInput);
    EXPECT_THROW(PlanetQuadtree(terrain, {.most_tiles = 10}), InvalidInput);
    PlanetQuadtree quadtree(terrain);
    EXPECT_THROW(quadtree.update(camera_over(terrain.globe(), {}, 10.0), 0, 10, 1), InvalidInput);
}

// As graphics cards do it: floats, relative to the tile's origin and to the eye.
struct Pixel {
    double x;
    double y;
};

template <typename Number>
Pixel projected(const CameraAxes& axes, const std::array<Number, 3>& from_eye)
{
    const auto along = [&](const Vector3& axis) {
        return static_cast<Number>(axis.x) * from_eye[0] + static_cast<Number>(axis.y) * from_eye[1]
               + static_cast<Number>(axis.z) * from_eye[2];
    };
    const auto scale = static_cast<Number>(1080.0 / (2.0 * 0.41421356));
    const Number ahead = along(axes.forward);
    return {static_cast<double>(scale * along(axes.right) / ahead),
            static_cast<double>(scale * along(axes.up) / ahead)};
}

bool in_picture(const Pixel& pixel)
{
    return std::abs(pixel.x) <= 960.0 && std::abs(pixel.y) <= 540.0;
}

TEST(PlanetPrecision, APointStaysWhereItIsWhileTheEyeCreepsAMetreAboveGround)
{
    const PlanetTerrain terrain = hilly_planet(kWgs84, 2.0, {});
    const Vector3 start = direction_of_degrees(kWgs84, -155.5, 19.6);
    const PlanetTile tile = place_in_tile(start, terrain.deepest_level()).tile;
    const TileHeights heights = terrain.heights_of(tile);
    const Vector3 origin = origin_m(kWgs84, tile, heights);
    PlanetCamera camera = camera_over(kWgs84, lon_lat_of(kWgs84, sample_direction(tile, 2, 64)), 0.0);
    camera.heading = lon_lat_of(kWgs84, sample_direction(tile, 3, 64)).latitude
                             > lon_lat_of(kWgs84, sample_direction(tile, 2, 64)).latitude
                         ? 0_deg
                         : 180_deg;
    double worst = 0.0;
    int seen = 0;
    for (int step = 0; step < 300; ++step) {
        camera = kept_above_ground(flown(kWgs84, camera, 0.0, 0.003, -1.0), terrain, 1.0);
        const CameraAxes axes = axes_of(kWgs84, camera);
        const Vector3 offset = origin - camera.eye_m;
        for (std::int32_t row = 0; row <= kTileSquares; row += 4)
            for (std::int32_t column = 0; column <= kTileSquares; column += 4) {
                const Vector3 vertex = sample_point_m(kWgs84, tile, heights, row, column) - origin;
                const Vector3 truth = vertex + offset;
                if (!in_picture(projected<double>(axes, {truth.x, truth.y, truth.z}))
                    || dot(truth, axes.forward) < 0.0)
                    continue;
                ++seen;
                const std::array<float, 3> from_eye = {
                    static_cast<float>(vertex.x) + static_cast<float>(offset.x),
                    static_cast<float>(vertex.y) + static_cast<float>(offset.y),
                    static_cast<float>(vertex.z) + static_cast<float>(offset.z)};
                const Pixel drawn = projected<float>(axes, from_eye);
                const Pixel right = projected<double>(axes, {truth.x, truth.y, truth.z});
                worst = std::max(worst, std::hypot(drawn.x - right.x, drawn.y - right.y));
            }
    }
    EXPECT_GT(seen, 1000);
    EXPECT_LT(worst, 0.1);
    RecordProperty("worst_pixels", std::to_string(worst));
}

} // namespace
} // namespace duskline
