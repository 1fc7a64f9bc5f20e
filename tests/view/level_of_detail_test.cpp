#include <duskline/geometry/invalid_input.h>
#include <duskline/terrain/synthetic_terrain.h>
#include <duskline/view/level_of_detail.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr auto kNaN = std::numeric_limits<float>::quiet_NaN();

Terrain mountains(std::size_t rows, std::size_t columns)
{
    return make_mountains({.grid = {.rows = rows, .columns = columns, .cell_size_m = {20.0, 25.0}},
                           .feature_m = 2000.0,
                           .roughness = 0.6});
}

std::vector<Camera> some_cameras(const HeightField& field, std::size_t count)
{
    std::mt19937 random(7);
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    std::vector<Camera> cameras;
    while (cameras.size() < count) {
        Camera camera;
        camera.position_m = {within(-500.0, 20.0 * static_cast<double>(field.columns())),
                             -within(0.0, 25.0 * static_cast<double>(field.rows())), within(0.0, 4000.0)};
        camera.heading = Angle::from_degrees(within(0.0, 360.0));
        camera.pitch = Angle::from_degrees(within(-80.0, 10.0));
        camera.vertical_view = 60_deg;
        cameras.push_back(kept_above_ground(camera, field, 5.0));
    }
    return cameras;
}

// One that has everything before it.
Frustum all_seeing(const HeightField& field)
{
    Camera camera;
    camera.position_m = {10.0 * static_cast<double>(field.columns()),
                         -12.5 * static_cast<double>(field.rows()), 1e6};
    camera.pitch = Angle::from_degrees(-89.9);
    return {camera, 1.0, 1.0};
}

std::size_t patch_cells(const MeshPatch& patch)
{
    return kPatchSquares << patch.level;
}

// Which patch covers each square of the grid: its index, -1 for none, -2 for more than one.
Grid<int> covered_squares(const HeightField& field, const std::vector<MeshPatch>& patches)
{
    Grid<int> covered(field.rows() - 1, field.columns() - 1, -1);
    for (std::size_t i = 0; i < patches.size(); ++i)
        for (std::size_t y = patches[i].row;
             y < std::min(patches[i].row + patch_cells(patches[i]), covered.rows()); ++y)
            for (std::size_t x = patches[i].column;
                 x < std::min(patches[i].column + patch_cells(patches[i]), covered.columns()); ++x)
                covered(y, x) = covered(y, x) == -1 ? static_cast<int>(i) : -2;
    return covered;
}

// How far a corner has turned into the next coarser level, as the vertex shader has it.
double morph(const HeightField& field, const Vector3& eye_m, const MorphRange& range, std::size_t row,
             std::size_t column)
{
    const GridPoint corner = {static_cast<double>(row), static_cast<double>(column),
                              static_cast<double>(field.heights_m(row, column))};
    const double away_m = length(position_m(corner, field.cell_size_m) - eye_m);
    if (std::isinf(range.end_m))
        return 0.0;
    return std::clamp((away_m - range.begin_m) / (range.end_m - range.begin_m), 0.0, 1.0);
}

TEST(LevelOfDetail, PatchesCoverTheTerrainOnce)
{
    const Terrain terrain = mountains(517, 300);
    const LevelOfDetail detail(terrain);
    const auto ranges = detail.morph_ranges(700.0, 2.0);
    for (const Camera& camera : some_cameras(terrain, 10)) {
        const auto patches = detail.select(camera.position_m, all_seeing(terrain), ranges);
        const Grid<int> covered = covered_squares(terrain, patches);
        EXPECT_TRUE(std::ranges::all_of(covered.values(), [](int patch) { return patch >= 0; }));
    }
}

TEST(LevelOfDetail, WhatTheCameraSeesIsNotCulled)
{
    const Terrain terrain = mountains(400, 400);
    const LevelOfDetail detail(terrain);
    const auto ranges = detail.morph_ranges(700.0, 2.0);
    for (const Camera& camera : some_cameras(terrain, 5)) {
        const Frustum frustum(camera, 1.3, 1.0);
        const Grid<int> covered = covered_squares(terrain, detail.select(camera.position_m, frustum, ranges));
        for (std::size_t row = 0; row < covered.rows(); row += 3)
            for (std::size_t column = 0; column < covered.columns(); column += 3) {
                const GridPoint at = {static_cast<double>(row), static_cast<double>(column),
                                      static_cast<double>(terrain.heights_m(row, column))};
                const Vector3 place = position_m(at, terrain.cell_size_m);
                if (frustum.may_see({place, place})) {
                    EXPECT_GE(covered(row, column), 0) << row << ", " << column;
                }
            }
    }
}

// Where levels meet, the finer has wholly turned and the coarser has not begun: the meshes share their border.
TEST(LevelOfDetail, LeavesNoCracks)
{
    const Terrain terrain = mountains(700, 600);
    const LevelOfDetail detail(terrain);
    std::size_t meetings = 0;
    for (const double pixel_error : {0.5, 4.0, 40.0}) {
        const auto ranges = detail.morph_ranges(700.0, pixel_error);
        for (const Camera& camera : some_cameras(terrain, 8)) {
            const auto patches = detail.select(camera.position_m, all_seeing(terrain), ranges);
            const Grid<int> covered = covered_squares(terrain, patches);
            const auto level_at = [&](std::size_t y, std::size_t x) {
                return patches[static_cast<std::size_t>(covered(y, x))].level;
            };
            const auto expect_fit = [&](std::uint32_t level, std::uint32_t other, std::size_t row,
                                        std::size_t column) {
                if (level == other)
                    return;
                ++meetings;
                ASSERT_LE(std::max(level, other) - std::min(level, other), 1U);
                const double turned = morph(terrain, camera.position_m, ranges[level], row, column);
                ASSERT_EQ(turned, level < other ? 1.0 : 0.0) << row << ", " << column;
            };
            for (std::size_t y = 1; y < covered.rows(); ++y)
                for (std::size_t x = 1; x < covered.columns(); ++x) {
                    expect_fit(level_at(y, x), level_at(y, x - 1), y, x);
                    expect_fit(level_at(y, x - 1), level_at(y, x), y, x);
                    expect_fit(level_at(y, x), level_at(y - 1, x), y, x);
                    expect_fit(level_at(y - 1, x), level_at(y, x), y, x);
                }
        }
    }
    EXPECT_GT(meetings, 10000U);
}

TEST(LevelOfDetail, EverythingIsDrawnNearTheEye)
{
    const Terrain terrain = mountains(600, 600);
    const LevelOfDetail detail(terrain);
    const Camera camera = kept_above_ground({{6000.0, -7500.0, 0.0}}, terrain, 2.0);
    const auto ranges = detail.morph_ranges(700.0, 2.0);
    const auto patches = detail.select(camera.position_m, all_seeing(terrain), ranges);
    const Grid<int> covered = covered_squares(terrain, patches);
    EXPECT_EQ(patches[static_cast<std::size_t>(covered(300, 300))].level, 0U);
    EXPECT_GT(ranges[0].begin_m, 16 * 20.0);
}

TEST(LevelOfDetail, APlaneNeedsNoMoreThanItsCoarsestLevels)
{
    const Terrain plane = make_plane({.grid = {.rows = 513, .columns = 513}, .slope = 10_deg});
    const LevelOfDetail detail(plane);
    for (std::size_t level = 0; level < detail.levels(); ++level)
        EXPECT_LT(detail.error_m(level), 1e-3);
    const auto patches =
        detail.select({256.0, -256.0, 20000.0}, all_seeing(plane), detail.morph_ranges(700.0, 1.0));
    EXPECT_EQ(patches.size(), 1U);
    EXPECT_EQ(patches.front().level + 1U, detail.levels());
}

TEST(LevelOfDetail, RougherTerrainAndFinerDemandsTakeMorePatches)
{
    const Terrain terrain = mountains(1000, 1000);
    const LevelOfDetail detail(terrain);
    const Vector3 eye = {10000.0, -12500.0, 6000.0};
    const auto count = [&](double pixel_error) {
        return detail.select(eye, all_seeing(terrain), detail.morph_ranges(700.0, pixel_error)).size();
    };
    EXPECT_LT(detail.error_m(1), detail.error_m(2));
    EXPECT_GT(count(1.0), count(8.0));
}

TEST(LevelOfDetail, ChangedHeightsAreFoundAsIfMeasuredAnew)
{
    Terrain terrain = mountains(300, 340);
    LevelOfDetail detail(terrain);
    const CellRectangle rectangle{.first_row = 60, .first_column = 128, .rows = 40, .columns = 7};
    for (std::size_t row = 60; row < 100; ++row)
        std::ranges::fill(terrain.heights_m.row(row).subspan(128, 7), row % 2 == 0 ? 9000.0f : kNaN);
    detail.heights_changed(rectangle);
    const LevelOfDetail anew(terrain);
    for (std::uint32_t level = 0; level < anew.levels(); ++level) {
        EXPECT_EQ(detail.error_m(level), anew.error_m(level)) << level;
        for (std::uint32_t row = 0; row < 300; row += static_cast<std::uint32_t>(kPatchSquares) << level)
            for (std::uint32_t column = 0; column < 340;
                 column += static_cast<std::uint32_t>(kPatchSquares) << level) {
                const Box box = detail.box_of({row, column, level});
                const Box fresh = anew.box_of({row, column, level});
                EXPECT_EQ(box.low.z, fresh.low.z);
                EXPECT_EQ(box.high.z, fresh.high.z);
            }
    }
    EXPECT_EQ(detail.heights().highest_m, 9000.0f);
    EXPECT_EQ(detail.morph_ranges(700.0, 1000.0)[0].end_m, anew.morph_ranges(700.0, 1000.0)[0].end_m);
}

TEST(LevelOfDetail, DrawsGroundThatHasBecomeRougherMoreFinely)
{
    Terrain terrain = make_plane({.grid = {.rows = 300, .columns = 300, .cell_size_m = {20.0, 20.0}}});
    LevelOfDetail detail(terrain);
    const double before_m = detail.error_m(1);
    const Terrain rough = mountains(300, 300);
    std::ranges::copy(rough.heights_m.values(), terrain.heights_m.values().begin());
    detail.heights_changed({0, 0, 300, 300}, {.threads = 1});
    EXPECT_GT(detail.error_m(1), before_m + 0.5);
}

TEST(LevelOfDetail, WhatHasNoDataIsNotDrawn)
{
    Terrain terrain = mountains(200, 200);
    std::ranges::fill(terrain.heights_m.values(), kNaN);
    terrain.heights_m(10, 190) = 5.0f;
    const LevelOfDetail detail(terrain);
    const auto patches =
        detail.select({4000.0, -250.0, 50.0}, all_seeing(terrain), detail.morph_ranges(700.0, 1.0));
    for (const MeshPatch& patch : patches) {
        EXPECT_LE(patch.row, 10U);
        EXPECT_GE(patch.column + patch_cells(patch), 190U);
    }
    EXPECT_FALSE(patches.empty());
}

constexpr auto kAll = [](const Box&) { return true; };

TEST(LevelOfDetail, PatchesOfALevelCoverTheTerrainOnce)
{
    const Terrain terrain = mountains(150, 201);
    const LevelOfDetail detail(terrain);
    ASSERT_EQ(detail.levels(), 4U);
    for (std::size_t level = 0; level < detail.levels(); ++level) {
        const auto patches = detail.patches_of(level, kAll);
        for (const MeshPatch& patch : patches)
            EXPECT_EQ(patch.level, level);
        const Grid<int> covered = covered_squares(terrain, patches);
        for (const int cover : covered.values())
            ASSERT_GE(cover, 0);
    }
    EXPECT_THROW(detail.patches_of(detail.levels(), kAll), InvalidInput);
}

TEST(LevelOfDetail, PatchesOfALevelAreThoseWantedAndLookedForOnlyAroundThem)
{
    const Terrain terrain = mountains(400, 500);
    const LevelOfDetail detail(terrain);
    const Vector3 place_m = {4100.0, -3300.0, 1000.0};
    std::size_t questions = 0;
    const auto near = [&](const Box& box) {
        ++questions;
        return distance_m(place_m, box) < 1000.0;
    };
    const auto patches = detail.patches_of(0, near);
    const std::size_t asked = questions;
    const auto all = detail.patches_of(0, kAll);
    for (const MeshPatch& patch : all)
        EXPECT_EQ(std::ranges::count(patches, patch), near(detail.box_of(patch)) ? 1 : 0);
    EXPECT_GT(patches.size(), 4U);
    EXPECT_LT(asked, all.size() / 2);
}

TEST(LevelOfDetail, PatchesOfALevelHaveData)
{
    Terrain terrain = mountains(200, 200);
    std::ranges::fill(terrain.heights_m.values(), kNaN);
    const LevelOfDetail nothing(terrain);
    EXPECT_TRUE(nothing.patches_of(0, kAll).empty());
    terrain.heights_m(10, 190) = 5.0f;
    const LevelOfDetail detail(terrain);
    EXPECT_EQ(detail.patches_of(0, kAll), (std::vector<MeshPatch>{{0, 160, 0}}));
    EXPECT_EQ(detail.patches_of(1, kAll), (std::vector<MeshPatch>{{0, 128, 1}}));
    const Terrain empty{Grid<float>(0, 0), {1.0, 1.0}};
    EXPECT_TRUE(LevelOfDetail(empty).patches_of(0, kAll).empty());
}

TEST(LevelOfDetail, TakesGridsOfAnySize)
{
    for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 50}, {2, 2}, {33, 33}, {34, 200}}) {
        const Terrain terrain = mountains(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
        const LevelOfDetail detail(terrain);
        const auto patches =
            detail.select({0.0, 0.0, 5000.0}, all_seeing(terrain), detail.morph_ranges(700.0, 1.0));
        EXPECT_FALSE(patches.empty());
    }
    const Terrain empty{Grid<float>(0, 0), {1.0, 1.0}};
    const LevelOfDetail detail(empty);
    EXPECT_TRUE(detail.select({}, all_seeing(empty), detail.morph_ranges(700.0, 1.0)).empty());
}

TEST(FilledHoles, KeepDataAndTakeTheirSurroundings)
{
    Terrain terrain{Grid<float>(40, 40, 100.0f), {1.0, 1.0}};
    for (std::size_t row = 10; row < 30; ++row)
        std::ranges::fill(terrain.heights_m.row(row).subspan(10, 25), kNaN);
    terrain.heights_m(0, 0) = 7.0f;
    const Grid<float> filled = with_holes_filled(terrain);
    EXPECT_EQ(filled(0, 0), 7.0f);
    EXPECT_EQ(filled(39, 39), 100.0f);
    EXPECT_TRUE(std::ranges::all_of(filled.values(), [](float h) { return h >= 7.0f && h <= 100.0f; }));
    EXPECT_NEAR(filled(20, 30), 100.0f, 20.0f);
}

TEST(FilledHoles, OfNoDataAtAllAreLevel)
{
    const Terrain terrain{Grid<float>(5, 3, kNaN), {1.0, 1.0}};
    const Grid<float> filled = with_holes_filled(terrain);
    EXPECT_TRUE(std::ranges::all_of(filled.values(), [](float h) { return h == 0.0f; }));
}

} // namespace
} // namespace duskline
