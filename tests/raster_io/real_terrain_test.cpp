// Every caster on real mountains, against the truth. docs/accuracy.md has the numbers these bounds hold.

#include "disc_average.h"
#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/casters.h>
#include <duskline/products/mask_difference.h>
#include <duskline/raster_io/read_height_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace duskline {
namespace {

constexpr const char* kOwnData = DUSKLINE_DATA;
constexpr const char* kSharedData = DUSKLINE_SHARED_DATA;

struct RealTerrain {
    const char* name;
    const char* folder;
    const char* file;
};

constexpr std::array kTerrains = {
    RealTerrain{"Hawaii", kOwnData, "hawaii_2048.tif"},
    RealTerrain{"Fuji", kSharedData, "fuji/mt_fuji_90m.tif"},
    RealTerrain{"BigTujunga", kSharedData, "bigtujunga/bigtujunga.tif"},
    RealTerrain{"Sierra", kSharedData, "lakes/sierra_30m_1100.tif"},
    RealTerrain{"Moon", kSharedData, "moon/moon_tycho_2048.tif"},
};

// Suns whose rays run through no corners of the grid: at 45 degrees every method that looks at nearest cells
// seems right.
struct RealLight {
    double azimuth;
    double altitude;
};

constexpr std::array kLights = {RealLight{203.0, 20.0}, RealLight{203.0, 5.0}, RealLight{100.3, 20.0},
                                RealLight{100.3, 5.0}, RealLight{90.5, 20.0}};

// The share of all cells that an inexact caster may get wrong. Light nearly along the rows is the worst for the
// sweep, whose beams then stay midway between two cells for many lines.
double most_wrong(const Caster& caster, const RealTerrain& terrain, const RealLight& light)
{
    const std::string name = terrain.name;
    if (takes_slopes_for_stairs(caster))
        return name == "Hawaii" ? 0.015 : 0.05;
    if (answers_beside_centres(caster) && (name != "Hawaii" || light.altitude < 20.0))
        return 0.02;
    if (name == "Hawaii")
        return light.altitude < 20.0 ? 0.004 : 0.0005;
    return 0.008;
}

std::string path_of(const RealTerrain& terrain)
{
    return std::string(terrain.folder) + "/" + terrain.file;
}

Terrain read(const RealTerrain& terrain)
{
    HeightFile file(path_of(terrain));
    return read_terrain(file);
}

// Also excuses cells beside a hole, where the ground between samples is anyone's guess.
Grid<char> excuses_and_holes(const Caster& caster, const HeightField& field, const DirectionalLight& light)
{
    Grid<char> excused = excuses(caster, field, light);
    if (caster.exact)
        return excused;
    const auto is_hole = [&](std::size_t row, std::size_t column) {
        return row < field.rows() && column < field.columns()
               && field.heights_m(row, column) != field.heights_m(row, column);
    };
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column)
            for (std::size_t i = 0; i < 9 && !excused(row, column); ++i)
                excused(row, column) = is_hole(row + i / 3 - 1, column + i % 3 - 1); // -1 wraps to no row
    return excused;
}

class OnRealTerrain : public testing::TestWithParam<std::tuple<RealTerrain, RealLight>> {};

std::string scene_name(const testing::TestParamInfo<OnRealTerrain::ParamType>& info)
{
    const auto& [terrain, light] = info.param;
    std::ostringstream name;
    name << terrain.name << "_azimuth_" << light.azimuth << "_altitude_" << light.altitude;
    std::string text = name.str();
    std::ranges::replace(text, '.', '_');
    return text;
}

INSTANTIATE_TEST_SUITE_P(All, OnRealTerrain,
                         testing::Combine(testing::ValuesIn(kTerrains), testing::ValuesIn(kLights)),
                         scene_name);

TEST_P(OnRealTerrain, EveryCasterIsAsRightAsItPromises)
{
    const auto& [place, from] = GetParam();
    if (!std::filesystem::exists(path_of(place)))
        GTEST_SKIP() << path_of(place) << " is not here";
    const Terrain terrain = read(place);
    const DirectionalLight light{Angle::from_degrees(from.azimuth), Angle::from_degrees(from.altitude)};
    const ShadowMask truth = cast_by_fast_ray(terrain, light);
    const auto cells = static_cast<double>(truth.size());

    for (const Caster& caster : kCasters) {
        if (is_truth(caster))
            continue; // see the test below
        if (steps_over_crests(caster) && from.altitude < 20.0)
            continue; // takes long; docs/accuracy.md has the figures
        SCOPED_TRACE(caster.name);
        const ShadowMask mask = caster.cast(terrain, light, {});
        const MaskDifference difference = mask_difference(truth, mask);
        const auto wrong = static_cast<double>(difference.differing);
        if (!caster.exact) {
            EXPECT_LE(wrong / cells, most_wrong(caster, place, from));
        }
        if (steps_over_crests(caster))
            continue; // wrong behind any of them
        EXPECT_TRUE(same_mask(mask, truth, excuses_and_holes(caster, terrain, light)));
        if (caster.exact)
            continue;
        // The others are beside a shadow narrower than a cell, which no cell of the truth shows. A caster that is
        // wrong in a handful of millions of cells may have one of them there.
        EXPECT_LE(static_cast<double>(difference.differing - difference.beside_edge),
                  std::max(wrong / 8.0, 1e-6 * cells));
    }
}

std::vector<RealTerrain> all_places()
{
    constexpr std::array more = {RealTerrain{"Lakes", kSharedData, "lakes/lakes_dem.tif"},
                                 RealTerrain{"Tile", kSharedData, "hawaii/srtm3_dt1/n19_w156_3arc_v2.dt1"},
                                 RealTerrain{"Holes", kSharedData, "awkward/sea_nan_f32.tif"}};
    std::vector<RealTerrain> places(kTerrains.begin(), kTerrains.end());
    places.insert(places.end(), more.begin(), more.end());
    return places;
}

// `check_exact` does the same with all cells and hundreds of suns (CONTRIBUTING.md).
TEST(RealTerrain, ExactCastersAreTheRayFromAnyPartUnderRandomSuns)
{
    Dice dice(3);
    for (const RealTerrain& place : all_places()) {
        if (!std::filesystem::exists(path_of(place)))
            continue;
        const Terrain terrain = read(place);
        const HeightField whole = terrain;
        const std::size_t rows = std::min<std::size_t>(whole.rows(), 250);
        const std::size_t columns = std::min<std::size_t>(whole.columns(), 250);
        for (int i = 0; i < 6; ++i) {
            const HeightField part = whole.window(dice.below(whole.rows() - rows + 1),
                                                  dice.below(whole.columns() - columns + 1), rows, columns);
            const DirectionalLight light = random_sun(dice, part.cell_size_m);
            const ShadowMask truth = cast_by_fast_ray(part, light);
            for (const Caster& caster : kCasters) {
                if (!caster.exact || is_truth(caster))
                    continue;
                EXPECT_TRUE(same_mask(caster.cast(part, light, {}), truth, excuses(caster, part, light)))
                    << caster.name << " on " << place.name << ", sun " << i << ", azimuth "
                    << light.azimuth.degrees() << ", altitude " << light.altitude.degrees();
            }
        }
    }
}

TEST(RealTerrain, ExactCastersAreTheRayUnderRandomLamps)
{
    Dice dice(5);
    for (const RealTerrain& place : all_places()) {
        if (!std::filesystem::exists(path_of(place)))
            continue;
        const Terrain terrain = read(place);
        const HeightField whole = terrain;
        const std::size_t rows = std::min<std::size_t>(whole.rows(), 300);
        const std::size_t columns = std::min<std::size_t>(whole.columns(), 350);
        for (int i = 0; i < 6; ++i) {
            const HeightField part = whole.window(dice.below(whole.rows() - rows + 1),
                                                  dice.below(whole.columns() - columns + 1), rows, columns);
            const PointLight lamp = random_lamp(dice, part);
            const ShadowMask truth = cast_by_fast_ray(part, lamp);
            for (const Caster& caster : kCasters)
                if (caster.exact && caster.cast_lamp != nullptr && !is_truth(caster)) {
                    EXPECT_TRUE(same_mask(caster.cast_lamp(part, lamp, {}), truth))
                        << caster.name << " on " << place.name << ", lamp at row " << lamp.position.row
                        << ", column " << lamp.position.column << ", " << lamp.position.height_m << " m";
                }
        }
    }
}

// docs/algorithms/soft.md has the figures of larger crops and more suns.
TEST(RealTerrain, SoftShadowsAreAveragesOverTheDisc)
{
    struct Crop {
        RealTerrain place;
        std::size_t row;
        std::size_t column;
    };
    for (const Crop& crop : {Crop{{"BigTujunga", kSharedData, "bigtujunga/bigtujunga.tif"}, 100, 300},
                             Crop{{"Hawaii", kOwnData, "hawaii_2048.tif"}, 700, 700}}) {
        if (!std::filesystem::exists(path_of(crop.place)))
            continue;
        const Terrain whole = read(crop.place);
        const HeightField part = HeightField(whole).window(crop.row, crop.column, 160, 160);
        const DirectionalLight light{Angle::from_degrees(203.0), Angle::from_degrees(5.0)};
        const FractionError error = fraction_error(visible_fraction(part, light, caster_named("exact")),
                                                   disc_average(part, light, 150));
        EXPECT_GT(error.cells, 100U) << crop.place.name;
        EXPECT_LT(error.mean, 0.012) << crop.place.name;
        EXPECT_LT(static_cast<double>(error.far_off), 0.01 * static_cast<double>(error.cells))
            << crop.place.name;
    }
}

// The plain ray takes seconds where the fast one takes a tenth, hence once and on the smallest.
TEST(RealTerrain, TheRayAndTheFastRayAgreeInEveryBit)
{
    const RealTerrain place = {"BigTujunga", kSharedData, "bigtujunga/bigtujunga.tif"};
    if (!std::filesystem::exists(path_of(place)))
        GTEST_SKIP() << path_of(place) << " is not here";
    const Terrain terrain = read(place);
    const DirectionalLight light{Angle::from_degrees(203.0), Angle::from_degrees(20.0)};
    EXPECT_TRUE(same_bits(shadow_heights_by_fast_ray(terrain, light), shadow_heights_by_ray(terrain, light)));
    EXPECT_TRUE(same_mask(cast_by_fast_ray(terrain, light), cast_by_ray(terrain, light)));
}

} // namespace
} // namespace duskline
