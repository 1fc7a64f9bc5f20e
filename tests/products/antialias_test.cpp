// The lit part of cells against super-sampling: k x k points over each cell, on the surface that is bilinear between
// four samples (and so straight along rows and columns), each with a ray of its own.

#include <duskline/casting/finer_mask.h>
#include <duskline/casting/ray.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/refined.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr std::size_t kPoints = 8; // along each side of a cell

double super_sampled(const HeightField& field, const TerrainRays& rays, const DirectionalLight& light,
                     std::size_t row, std::size_t column)
{
    std::size_t lit = 0;
    for (std::size_t j = 0; j < kPoints; ++j)
        for (std::size_t i = 0; i < kPoints; ++i) {
            const auto offset = [](std::size_t k) { return (static_cast<double>(k) + 0.5) / kPoints - 0.5; };
            const double y = static_cast<double>(row) + offset(j);
            const double x = static_cast<double>(column) + offset(i);
            lit += ground_height_m(field, y, x).value() >= rays.shadow_height_m(y, x, light) ? 1U : 0U;
        }
    return static_cast<double>(lit) / (kPoints * kPoints);
}

struct Errors {
    double antialiased = 0.0; // means over the cells that an edge passes through
    double by_heights = 0.0;
    double mask = 0.0;
    double bias = 0.0;
    double worst = 0.0;
    std::size_t cells = 0;
};

Errors errors_on(const HeightField& field, const DirectionalLight& light)
{
    const TerrainRays rays(field);
    const ShadowField shadows_m = rays.shadow_heights(light);
    const ShadowMask mask = mask_of(field, shadows_m);
    const LitFraction lit = super_sampled_lit_fraction(field, mask, light);
    const LitFraction by_heights = lit_fraction(field, shadows_m, light);
    Errors errors;
    for (std::size_t row = 1; row + 1 < field.rows(); ++row)
        for (std::size_t column = 1; column + 1 < field.columns(); ++column) {
            const double expected = super_sampled(field, rays, light, row, column);
            const double actual = lit(row, column);
            const double hard = mask(row, column) == Lit::yes ? 1.0 : 0.0;
            if (expected == hard && actual == hard && by_heights(row, column) == hard)
                continue;
            errors.by_heights += std::abs(by_heights(row, column) - expected);
            errors.antialiased += std::abs(actual - expected);
            errors.bias += actual - expected;
            errors.mask += std::abs(hard - expected);
            errors.worst = std::max(errors.worst, std::abs(actual - expected));
            ++errors.cells;
        }
    const auto cells = static_cast<double>(errors.cells);
    errors.antialiased /= cells;
    errors.mask /= cells;
    errors.by_heights /= cells;
    errors.bias /= cells;
    return errors;
}

std::string in_words(const Errors& errors)
{
    return std::to_string(errors.cells) + " cells at edges: mean error " + std::to_string(errors.antialiased)
           + ", worst " + std::to_string(errors.worst) + ", from shadow heights "
           + std::to_string(errors.by_heights) + ", of the mask " + std::to_string(errors.mask);
}

TEST(Antialias, OfAHillsShadowOnAPlainIsTheSuperSampledOne)
{
    const Terrain terrain =
        make_gaussian_hill({.grid = {100, 100, {10.0, 10.0}}, .height_m = 120.0, .sigma_m = 60.0});
    for (const double azimuth : {203.0, 45.0}) {
        const Errors errors =
            errors_on(terrain, {.azimuth = Angle::from_degrees(azimuth), .altitude = 20_deg});
        SCOPED_TRACE(in_words(errors));
        EXPECT_GT(errors.cells, 50U);
        EXPECT_LT(errors.antialiased, 0.04);
        EXPECT_LT(errors.worst, 0.25);
        EXPECT_LT(std::abs(errors.bias), 0.02);
        EXPECT_LT(errors.antialiased, errors.by_heights);
    }
}

// Rough ground, where shadows are a few cells wide and edges run through bent ground.
TEST(Antialias, OnMountainsIsTheSuperSampledOne)
{
    const Terrain terrain = make_mountains({.grid = {70, 70, {30.0, 30.0}}, .seed = 11, .roughness = 0.5});
    for (const double altitude : {8.0, 25.0}) {
        const Errors errors =
            errors_on(terrain, {.azimuth = 203_deg, .altitude = Angle::from_degrees(altitude)});
        SCOPED_TRACE(in_words(errors));
        EXPECT_GT(errors.cells, 200U);
        EXPECT_LT(errors.antialiased, 0.04);
        EXPECT_LT(std::abs(errors.bias), 0.02);
        EXPECT_LT(errors.by_heights, errors.mask);
    }
}

TEST(Antialias, LeavesBordersAndHolesToTheGroundThereIs)
{
    Terrain terrain{Grid<float>(9, 40, 0.0f), {1.0, 1.0}};
    for (std::size_t y = 0; y < 9; ++y)
        terrain.heights_m(y, 0) = 10.25f;
    terrain.heights_m(4, 20) = std::nanf("");
    const DirectionalLight light = {.azimuth = 270_deg, .altitude = 45_deg};
    const LitFraction lit = super_sampled_lit_fraction(terrain, cast_by_ray(terrain, light), light);
    for (std::size_t y = 0; y < 9; ++y) { // the shadow ends 10.25 cells from the wall
        EXPECT_EQ(lit(y, 9), 0.0f) << y;
        EXPECT_EQ(lit(y, 10), 0.25f) << y;
        EXPECT_EQ(lit(y, 11), 1.0f) << y;
    }
    EXPECT_TRUE(std::isnan(lit(4, 20)));
    EXPECT_EQ(lit(4, 21), 1.0f);
    EXPECT_THROW(super_sampled_lit_fraction(terrain, ShadowMask(9, 41, Lit::yes), light), InvalidInput);
}

TEST(Antialias, FinerCellsAddUpToTheCellsTheyShare)
{
    // 4 x 4 points in each of 4 x 4 finer cells: 256 points a cell, where the cell alone has 16.
    const Terrain terrain =
        make_gaussian_hill({.grid = {60, 60, {10.0, 10.0}}, .height_m = 120.0, .sigma_m = 60.0});
    const DirectionalLight light = {.azimuth = 203_deg, .altitude = 20_deg};
    const ShadowMask mask = cast_by_ray(terrain, light);
    const LitFraction coarse = super_sampled_lit_fraction(terrain, mask, light);
    const Terrain finer_ground = refined(terrain, 240, 240);
    const ShadowMask finer_cells = finer_mask(terrain, mask, light, finer_ground);
    const LitFraction finer = finer_super_sampled_lit_fraction(terrain, finer_cells, light);
    std::size_t edges = 0;
    for (std::size_t row = 1; row + 1 < 60; ++row)
        for (std::size_t column = 1; column + 1 < 60; ++column) {
            double sum = 0.0;
            for (std::size_t i = 0; i < 16; ++i)
                sum += finer(4 * row + i / 4, 4 * column + i % 4);
            ASSERT_NEAR(sum / 16.0, coarse(row, column), 0.15) << row << ' ' << column;
            edges += coarse(row, column) > 0.0f && coarse(row, column) < 1.0f ? 1U : 0U;
        }
    EXPECT_GT(edges, 30U);
    EXPECT_THROW(finer_super_sampled_lit_fraction(terrain, ShadowMask(60, 59, Lit::yes), light),
                 InvalidInput);
}

TEST(Antialias, IsTheSameForAnyNumberOfThreads)
{
    const Terrain terrain = make_mountains({.grid = {60, 80, {30.0, 30.0}}, .seed = 11});
    const DirectionalLight light = {.azimuth = 100.3_deg, .altitude = 12_deg};
    const ShadowMask mask = cast_by_ray(terrain, light);
    const LitFraction one = super_sampled_lit_fraction(terrain, mask, light, {.threads = 1});
    const LitFraction many = super_sampled_lit_fraction(terrain, mask, light, {.threads = 5});
    EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
}

} // namespace
} // namespace duskline
