// The silhouette map against its own definition, written down once more: lines across the light, one by one, in long
// double. And what it promises of its texels.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/smap.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr long double kNothingCasts = -std::numeric_limits<long double>::infinity();

// Every line beyond a place, without any of the library's frames. Lines lie across the light's larger component.
class RowsOnly {
public:
    RowsOnly(const HeightField& field, const DirectionalLight& light)
        : field_(field), frame_(light_frame(light, field.cell_size_m))
    {}

    // The height under which a point there is in shadow.
    long double shadow_m(long double row, long double column) const
    {
        const bool rows = frame_.lines_are_rows;
        const long double towards = frame_.first_line_is_index_0 ? -1.0L : 1.0L;
        const long double line = rows ? row : column;
        const long double cell = rows ? column : row;
        const auto last = static_cast<long double>((rows ? field_.rows() : field_.columns()) - 1);
        long double highest_m = kNothingCasts;
        const long double first =
            towards < 0 ? std::min(std::ceil(line) - 1, last) : std::max(std::floor(line) + 1, 0.0L);
        for (long double at = first; at >= 0 && at <= last; at += towards) {
            const long double lines = std::abs(at - line);
            highest_m =
                std::max(highest_m, surface_m(at, cell - frame_.lateral * lines) - frame_.drop_m * lines);
        }
        return highest_m;
    }

private:
    float sample(long double line, long double cell) const
    {
        const long double row = frame_.lines_are_rows ? line : cell;
        const long double column = frame_.lines_are_rows ? cell : line;
        if (!(row >= 0 && column >= 0 && row < static_cast<long double>(field_.rows())
              && column < static_cast<long double>(field_.columns())))
            return kNan;
        return field_.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }

    long double surface_m(long double line, long double cell) const
    {
        const long double before = std::floor(cell);
        const long double share = cell - before;
        const float a = sample(line, before);
        const float b = sample(line, before + 1);
        if (share <= 1e-6L && !std::isnan(a) && (std::isnan(b) || share == 0.0L))
            return a;
        if (share >= 1.0L - 1e-6L && !std::isnan(b) && std::isnan(a))
            return b;
        const long double height_m = a + (static_cast<long double>(b) - a) * share;
        return std::isnan(height_m) ? kNothingCasts : height_m;
    }

    HeightField field_;
    LightFrame frame_;
};

// How far heights may be apart for the two ways to compute them to differ.
double tie_m(const HeightField& field)
{
    const HeightRange range = height_range(field);
    return 1e-9 * (1.0 + std::abs(range.lowest_m) + std::abs(range.highest_m));
}

// The mask by that definition; `excused` are ties.
ShadowMask mask_by_definition(const HeightField& field, const DirectionalLight& light, Grid<char>& excused)
{
    const RowsOnly definition(field, light);
    const auto tie = static_cast<long double>(tie_m(field));
    ShadowMask mask(field.rows(), field.columns());
    excused = Grid<char>(field.rows(), field.columns(), 0);
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column) {
            const float ground_m = field.heights_m(row, column);
            const long double shadow_m =
                definition.shadow_m(static_cast<long double>(row), static_cast<long double>(column));
            mask(row, column) = std::isnan(ground_m)   ? Lit::unknown
                                : ground_m >= shadow_m ? Lit::yes
                                                       : Lit::no;
            excused(row, column) = std::abs(ground_m - shadow_m) <= tie;
        }
    return mask;
}

std::vector<SilhouetteMapOptions> every_way()
{
    std::vector<SilhouetteMapOptions> ways;
    for (const NextVSearch search : {NextVSearch::binary, NextVSearch::quad, NextVSearch::parallel_quad})
        for (const bool better : {false, true})
            ways.push_back({.search = search, .better_next_v = better});
    return ways;
}

testing::AssertionResult same_texels(const SilhouetteMap& a, const SilhouetteMap& b)
{
    const auto left = a.texels();
    const auto right = b.texels();
    if (left.rows() != right.rows() || left.columns() != right.columns())
        return testing::AssertionFailure() << "the maps have different sizes";
    for (std::size_t v = 0; v < left.rows(); ++v)
        for (std::size_t x = 0; x < left.columns(); ++x)
            if (left(v, x) != right(v, x))
                return testing::AssertionFailure() << "texel (" << v << ", " << x << ") is "
                                                   << left(v, x).bits << ", not " << right(v, x).bits;
    return testing::AssertionSuccess();
}

TEST(SilhouetteMap, GivesTheAnswersOfItsDefinitionWhateverIsInTheMap)
{
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        Grid<char> ties;
        const ShadowMask expected = mask_by_definition(terrain, light, ties);
        for (const SilhouetteMapOptions& way : every_way())
            EXPECT_TRUE(same_mask(SilhouetteMap(terrain, light, way).cast(), expected, ties))
                << "azimuth " << light.azimuth.degrees() << ", altitude " << light.altitude.degrees()
                << ", search " << static_cast<int>(way.search) << ", better " << way.better_next_v;
        EXPECT_TRUE(same_mask(cast_by_full_scan(terrain, light), expected, ties));
    });
}

// By the same arithmetic the full scan has no ties.
TEST(SilhouetteMap, IsTheFullScanInEveryCell)
{
    for_seeds(200, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 70});
        const DirectionalLight light = random_light(dice);
        EXPECT_TRUE(same_mask(cast_by_smap(terrain, light), cast_by_full_scan(terrain, light)))
            << "azimuth " << light.azimuth.degrees() << ", altitude " << light.altitude.degrees();
    });
    const Terrain mountains =
        make_mountains({.grid = {.rows = 300, .columns = 410, .cell_size_m = {40.0, 30.0}}, .seed = 11});
    for (const double azimuth : {0.0, 17.0, 45.0, 90.5, 135.0, 203.0, 270.0, 300.1})
        for (const double altitude : {0.01, 3.0, 12.0, 40.0}) {
            const DirectionalLight light{Angle::from_degrees(azimuth), Angle::from_degrees(altitude)};
            EXPECT_TRUE(same_mask(cast_by_smap(mountains, light), cast_by_full_scan(mountains, light)))
                << azimuth << ", " << altitude;
        }
}

TEST(SilhouetteMap, FindsTheSameTexelsByBothQuadSearchesAndWithoutLeavingOutByAllThree)
{
    for_seeds(120, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.largest = 150});
        const DirectionalLight light = random_light(dice);
        const auto map_by = [&](NextVSearch search, bool better) {
            return SilhouetteMap(terrain, light, {.search = search, .better_next_v = better});
        };
        for (const bool better : {false, true})
            EXPECT_TRUE(
                same_texels(map_by(NextVSearch::parallel_quad, better), map_by(NextVSearch::quad, better)));
        EXPECT_TRUE(same_texels(map_by(NextVSearch::binary, false), map_by(NextVSearch::quad, false)));
    });
}

// The layout that smap.h promises, followed by hand.
TEST(SilhouetteMap, NamesTheNearestBlackSectionOfTheSameBeam)
{
    for_seeds(60, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        const SilhouetteMap map(terrain, light, {.better_next_v = false});
        const auto texels = map.texels();
        const LightFrame& frame = map.frame();
        EXPECT_EQ(texels.rows(),
                  frame.lines_are_rows ? terrain.heights_m.rows() : terrain.heights_m.columns());
        EXPECT_EQ(texels.columns(),
                  (frame.lines_are_rows ? terrain.heights_m.columns() : terrain.heights_m.rows()) + 1);
        for (std::size_t v = 0; v < texels.rows(); ++v)
            for (std::size_t x = 0; x < texels.columns(); ++x) {
                std::int32_t expected = -1;
                for (auto w = static_cast<std::int32_t>(v); w-- > 0 && expected < 0;) {
                    const auto line = static_cast<std::size_t>(w);
                    const auto there = static_cast<std::size_t>(
                        static_cast<std::int64_t>(x) + map.lines()[line].shift - map.lines()[v].shift);
                    if (there < texels.columns() && texels(line, there).is_black())
                        expected = w;
                }
                ASSERT_EQ(texels(v, x).next_v(), expected) << v << ", " << x;
            }
    });
}

TEST(SilhouetteMap, SaysInWhichColumnAPointLies)
{
    for (const double azimuth : {0.0, 20.0, 45.0, 77.0, 163.0, 200.0, 271.0, 340.0}) {
        const Terrain plane = make_plane({.grid = {.rows = 37, .columns = 53}});
        const SilhouetteMap map(plane, {.azimuth = Angle::from_degrees(azimuth), .altitude = 20_deg});
        const double lateral = map.frame().lateral;
        for (std::size_t v = 0; v < map.lines().size(); ++v) {
            const SilhouetteLineFacts& line = map.lines()[v];
            EXPECT_NEAR(line.shift + static_cast<double>(line.part), lateral * static_cast<double>(v),
                        1e-7 * 64);
            EXPECT_GE(line.part, 0.0f);
            EXPECT_LT(line.part, 1.0f);
            for (std::size_t u = 0; u + 1 < map.texels().columns(); ++u) {
                const auto cell = static_cast<double>(u);
                const double x = std::floor(cell - lateral * static_cast<double>(v)) + line.shift + 1.0;
                EXPECT_GE(x, 0.0);
                EXPECT_LT(x, static_cast<double>(map.texels().columns()));
                EXPECT_LE(x - 1.0 + static_cast<double>(line.part), cell + 1e-5);
                EXPECT_GE(x + static_cast<double>(line.part), cell - 1e-5);
            }
        }
    }
}

TEST(SilhouetteMap, KeepsOutOfNextVWhatCannotShadow)
{
    const Terrain mountains =
        make_mountains({.grid = {.rows = 200, .columns = 230, .cell_size_m = {30.0, 30.0}}, .seed = 4});
    const DirectionalLight light{.azimuth = 203_deg, .altitude = 8_deg};
    const SilhouetteStatistics nearest =
        SilhouetteMap(mountains, light, {.better_next_v = false}).statistics();
    const SilhouetteStatistics better = SilhouetteMap(mountains, light).statistics();
    EXPECT_EQ(nearest.cells, 200U * 230U);
    EXPECT_EQ(nearest.texels, 200U * 231U);
    EXPECT_EQ(nearest.black, better.black);
    EXPECT_GT(better.look_ups, 0U);
    EXPECT_LT(better.look_ups, nearest.look_ups / 2);
}

// Level ground has no silhouettes but its border towards the dark, and one ridge makes one line of them.
TEST(SilhouetteMap, IsBlackAlongARidge)
{
    Terrain ridge{Grid<float>(40, 30, 5.0f), {10.0, 10.0}};
    for (std::size_t column = 0; column < 30; ++column)
        ridge.heights_m(17, column) = 50.0f;
    const SilhouetteMap map(ridge, {.azimuth = 0_deg, .altitude = 30_deg});
    for (std::size_t v = 0; v < 40; ++v)
        for (std::size_t x = 1; x < 30; ++x) // the first and last have no section, or half of one
            EXPECT_EQ(map.texels()(v, x).is_black(), v == 17 || v == 39) << v << ", " << x;
    // The shadow is 45 m high and falls by 5.8 m from line to line.
    EXPECT_EQ(map.texels()(24, 12).next_v(), 17);
    EXPECT_FALSE(map.texels()(25, 12).has_next());
    EXPECT_FALSE(map.texels()(17, 12).has_next());
    EXPECT_FALSE(map.texels()(10, 12).has_next());
}

// Two lines that turn from towards the light to away from it in the middle of a section, between its five places.
TEST(SilhouetteMap, FindsASilhouetteBetweenThePlacesOfTheSource)
{
    Terrain cross{Grid<float>(3, 3, 0.0f), {1.0, 1.0}};
    // Along the light (from the north, rows): column 0 rises towards it, column 1 falls; both by less than half way.
    const float heights[3][3] = {{10.0f, 6.0f, 6.0f}, {9.0f, 9.0f, 9.0f}, {6.0f, 10.0f, 10.0f}};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            cross.heights_m(row, column) = heights[row][column];
    // A drop of next to nothing: line 1 is higher than line 0 from a quarter of the section on, and than line 2 up to
    // three quarters of it.
    const SilhouetteMap map(cross, {.azimuth = 0_deg, .altitude = Angle::from_degrees(0.01)});
    EXPECT_TRUE(map.texels()(1, 1).is_black());
    // A point that only the middle of that section shades.
    EXPECT_TRUE(map.is_shadowed({.row = 2.0, .column = 0.5, .height_m = 8.9}));
    EXPECT_FALSE(map.is_shadowed({.row = 2.0, .column = 0.5, .height_m = 9.1}));
}

TEST(SilhouetteMap, AnswersForPointsAnywhereAboveTheGround)
{
    for_seeds(150, [&](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = random_light(dice);
        const HeightField field = terrain;
        const SilhouetteMap map(terrain, light);
        const RowsOnly definition(terrain, light);
        const float highest_m = height_range(field).highest_m;
        for (int i = 0; i < 40; ++i) {
            const auto place = [&](std::size_t count) {
                const double at = dice.between(-3.0, static_cast<double>(count) + 3.0);
                return dice.chance(0.3) ? std::floor(at) : at;
            };
            const double row = place(field.rows());
            const double column = place(field.columns());
            // Above all samples around, and so above the ground.
            float ground_m = height_range(field).lowest_m;
            for (const double y : {std::floor(row), std::ceil(row)})
                for (const double x : {std::floor(column), std::ceil(column)})
                    if (y >= 0 && x >= 0 && y < static_cast<double>(field.rows())
                        && x < static_cast<double>(field.columns()))
                        ground_m = std::fmax(ground_m, field.heights_m(static_cast<std::size_t>(y),
                                                                       static_cast<std::size_t>(x)));
            if (!(highest_m >= ground_m))
                continue; // nothing but no data
            const double height_m = dice.between(ground_m, ground_m + 0.5 * (highest_m - ground_m) + 1.0);
            const long double shadow_m = definition.shadow_m(row, column);
            if (std::abs(shadow_m - static_cast<long double>(height_m)) < 1e-7L)
                continue;
            EXPECT_EQ(map.is_shadowed({row, column, height_m}), shadow_m > height_m)
                << row << ' ' << column << ' ' << height_m << ", azimuth " << light.azimuth.degrees()
                << ", altitude " << light.altitude.degrees();
            if (shadow_m > height_m) {
                EXPECT_NEAR(map.shadow_height_m(row, column), static_cast<double>(shadow_m),
                            1e-7 * (1.0 + std::abs(highest_m)));
            }
        }
    });
}

TEST(SilhouetteMap, AnswersForPointsBesideTheGridWhoseRaysPassOverIt)
{
    Terrain tower{Grid<float>(21, 21, 0.0f), {1.0, 1.0}};
    for (std::size_t row = 9; row <= 11; ++row)
        for (std::size_t column = 9; column <= 11; ++column)
            tower.heights_m(row, column) = 40.0f;
    for (const double azimuth : {0.0, 30.0, 60.0, 90.0, 150.0, 210.0, 240.0, 330.0}) {
        const double east = std::sin(azimuth * std::numbers::pi / 180.0);
        const double north = std::cos(azimuth * std::numbers::pi / 180.0);
        const SilhouetteMap map(tower, {.azimuth = Angle::from_degrees(azimuth), .altitude = 45_deg});
        for (const double away : {5.0, 20.0, 30.0, 38.0})
            EXPECT_TRUE(map.is_shadowed({.row = 10.0 + away * north, .column = 10.0 - away * east}))
                << azimuth << ", " << away;
        for (const double away : {-5.0, -30.0, 45.0, 1e6})
            EXPECT_FALSE(map.is_shadowed({.row = 10.0 + away * north, .column = 10.0 - away * east}))
                << azimuth << ", " << away;
    }
}

TEST(SilhouetteMap, IsTheSameByEveryKernelAndNumberOfThreads)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 170, .columns = 231, .cell_size_m = {40.0, 75.0}}, .seed = 9});
    for (const double azimuth : {0.0, 45.0, 100.3, 203.0}) {
        const DirectionalLight light{Angle::from_degrees(azimuth), 7_deg};
        const SilhouetteMap one(terrain, light, {}, {.threads = 1});
        for (const std::size_t threads : {2U, 3U, 0U})
            EXPECT_TRUE(same_texels(SilhouetteMap(terrain, light, {}, {.threads = threads}), one));
        for (const kernels::Kernels& kernels : kernels::runnable_kernels())
            EXPECT_TRUE(same_texels(SilhouetteMap(terrain, light, {.isa = kernels.isa}), one)) << kernels.isa;
    }
}

TEST(SilhouetteMap, NeedsNoTexelsAtNightOrNoon)
{
    const Terrain cone = make_cone({.grid = {.rows = 9, .columns = 9}, .height_m = 3.0, .slope = 80_deg});
    const SilhouetteMap night(cone, {.altitude = 0_deg});
    const SilhouetteMap noon(cone, {.altitude = 90_deg});
    EXPECT_TRUE(night.texels().empty());
    EXPECT_TRUE(noon.texels().empty());
    EXPECT_TRUE(night.is_shadowed({4.0, 4.0, 1e9}));
    EXPECT_FALSE(noon.is_shadowed({4.0, 3.0, 0.0}));
    EXPECT_EQ(night.shadow_height_m(4.0, 4.0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(noon.shadow_height_m(4.0, 4.0), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(night.statistics().look_ups, 0U);
    EXPECT_FALSE(SilhouetteMap({}, {.altitude = 10_deg}).is_shadowed({}));
}

TEST(SilhouetteMap, RefusesPlacesThatAreNone)
{
    const Terrain flat = make_plane({.grid = {.rows = 4, .columns = 4}});
    const SilhouetteMap map(flat, {});
    EXPECT_THROW(map.is_shadowed({std::nan(""), 0.0, 0.0}), InvalidInput);
    EXPECT_THROW(map.is_shadowed({0.0, 1e300, 0.0}), InvalidInput);
    EXPECT_THROW(map.is_shadowed({0.0, 0.0, std::nan("")}), InvalidInput);
    EXPECT_THROW(map.shadow_height_m(0.0, std::nan("")), InvalidInput);
}

} // namespace
} // namespace duskline
