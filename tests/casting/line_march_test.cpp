// The line marches against their definition, written down a second time: no offsets shared among cells, no early
// end, no way of counting but the grid's own.

#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/line_march.h>
#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

namespace duskline {
namespace {

using namespace angle_literals;

// The terrain's height at a place of the grid; nothing outside it, NaN where it is not known, and whether rounding
// may decide what it is.
struct Height {
    double height_m;
    bool doubtful = false;
};
using HeightAt = std::function<std::optional<Height>(const HeightField&, double row, double column)>;

bool is_inside(const HeightField& field, double row, double column)
{
    return row >= 0.0 && column >= 0.0 && row <= static_cast<double>(field.rows() - 1)
           && column <= static_cast<double>(field.columns() - 1);
}

double sample(const HeightField& field, double row, double column)
{
    return field.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
}

std::optional<Height> nearest_sample(const HeightField& field, double row, double column)
{
    if (!is_inside(field, std::round(row), std::round(column)))
        return std::nullopt;
    const auto near_half = [](double x) { return std::abs(x - std::floor(x) - 0.5) < 1e-6; };
    return Height{sample(field, std::round(row), std::round(column)), near_half(row) || near_half(column)};
}

std::optional<Height> bilinear_surface(const HeightField& field, double row, double column)
{
    const auto snapped = [](double x) { return std::abs(x - std::round(x)) < 1e-6 ? std::round(x) : x; };
    row = snapped(row);
    column = snapped(column);
    if (!is_inside(field, row, column))
        return std::nullopt;
    double sum = 0.0;
    for (const double y : {std::floor(row), std::floor(row) + 1.0})
        for (const double x : {std::floor(column), std::floor(column) + 1.0}) {
            const double weight = (1.0 - std::abs(row - y)) * (1.0 - std::abs(column - x));
            if (weight > 0.0)
                sum += weight * sample(field, y, x);
        }
    return Height{sum};
}

// A march from one cell: where it goes with each step, in rows and columns, and how high the ray is there.
struct March {
    double rows_a_step;
    double columns_a_step;
    double steps; // to go at most, less than one more
    std::function<double(double step)> ray_m;
};

// Lit::unknown where rounding decides.
Lit answer(const HeightField& field, std::size_t row, std::size_t column, const March& march,
           const HeightAt& height_at)
{
    Lit result = Lit::yes;
    for (double step = 1.0; step < march.steps; ++step) {
        const auto height = height_at(field, static_cast<double>(row) + step * march.rows_a_step,
                                      static_cast<double>(column) + step * march.columns_a_step);
        if (!height)
            break;
        const double above_m = height->height_m - march.ray_m(step);
        if (height->doubtful || std::abs(above_m) < 1e-6)
            return Lit::unknown;
        if (above_m > 0.0)
            result = Lit::no;
    }
    return result;
}

March towards(const DirectionalLight& light, const HeightField& field, double ground_m)
{
    const double azimuth = light.azimuth.radians();
    const double columns = std::sin(azimuth) / field.cell_size_m.x;
    const double rows = -std::cos(azimuth) / field.cell_size_m.y;
    const double metres = 1.0 / std::hypot(rows, columns); // of ground to a step of one cell
    const double climb_m = metres * std::tan(light.altitude.radians());
    return {rows * metres, columns * metres, std::numeric_limits<double>::infinity(),
            [=](double step) { return ground_m + step * climb_m; }};
}

March towards(const PointLight& lamp, std::size_t row, std::size_t column, double ground_m)
{
    const double rows = lamp.position.row - static_cast<double>(row);
    const double columns = lamp.position.column - static_cast<double>(column);
    const double cells = std::hypot(rows, columns);
    const double climb_m = lamp.position.height_m - ground_m;
    return {rows / cells, columns / cells, cells,
            [=](double step) { return ground_m + climb_m * step / cells; }};
}

// Every cell that rounding does not decide has the answer of the definition, and those are most.
template <typename Light>
void expect_definition(const HeightField& field, const Light& light, const ShadowMask& mask,
                       const HeightAt& height_at)
{
    std::size_t decided = 0;
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column) {
            const double ground_m = field.heights_m(row, column);
            if (std::isnan(ground_m)) {
                ASSERT_EQ(mask(row, column), Lit::unknown);
                ++decided;
                continue;
            }
            March march;
            if constexpr (std::is_same_v<Light, PointLight>)
                march = towards(light, row, column, ground_m);
            else
                march = towards(light, field, ground_m);
            const Lit expected = answer(field, row, column, march, height_at);
            if (expected == Lit::unknown)
                continue;
            ++decided;
            ASSERT_EQ(mask(row, column), expected) << "row " << row << ", column " << column;
        }
    EXPECT_GE(4 * decided, field.rows() * field.columns());
}

// Away from the angles at which places between two samples are a matter of rounding.
DirectionalLight odd_light(Dice& dice)
{
    return {Angle::from_degrees(dice.between(0.0, 360.0)), Angle::from_degrees(dice.between(0.5, 70.0))};
}

TEST(LineMarch, IsItsDefinitionUnderParallelLight)
{
    for_seeds(60, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const DirectionalLight light = odd_light(dice);
        expect_definition(terrain, light, cast_by_line_march(terrain, light, {.threads = 1}), nearest_sample);
        expect_definition(terrain, light, cast_by_line_march_bilinear(terrain, light, {.threads = 1}),
                          bilinear_surface);
    });
}

TEST(LineMarch, IsItsDefinitionAlongAxesAndDiagonals)
{
    for_seeds(24, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice, {.square_cells = true});
        const DirectionalLight light{Angle::from_degrees(45.0 * static_cast<double>(dice.below(8))),
                                     Angle::from_degrees(dice.between(0.5, 70.0))};
        expect_definition(terrain, light, cast_by_line_march(terrain, light, {.threads = 1}), nearest_sample);
        expect_definition(terrain, light, cast_by_line_march_bilinear(terrain, light, {.threads = 1}),
                          bilinear_surface);
    });
}

TEST(LineMarch, IsItsDefinitionUnderALamp)
{
    for_seeds(60, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const HeightField field = terrain;
        // Off the lines of samples: on them the places half-way between two are many.
        PointLight lamp{{dice.between(-10.0, 60.0), dice.between(-10.0, 60.0), dice.between(-100.0, 3000.0)}};
        if (const auto ground_m = ground_height_m(field, lamp.position.row, lamp.position.column))
            lamp.position.height_m = *ground_m + dice.between(0.1, 500.0);
        expect_definition(field, lamp, cast_by_line_march(field, lamp, {.threads = 1}), nearest_sample);
        expect_definition(field, lamp, cast_by_line_march_bilinear(field, lamp, {.threads = 1}),
                          bilinear_surface);
    });
}

TEST(LineMarch, ShadowHeightsUnderALampMeanTheMask)
{
    for_seeds(40, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        const PointLight lamp = random_lamp(dice, terrain);
        EXPECT_TRUE(same_mask(mask_of(terrain, shadow_heights_by_line_march(terrain, lamp, {.threads = 1})),
                              cast_by_line_march(terrain, lamp, {.threads = 1})));
        EXPECT_TRUE(
            same_mask(mask_of(terrain, shadow_heights_by_line_march_bilinear(terrain, lamp, {.threads = 1})),
                      cast_by_line_march_bilinear(terrain, lamp, {.threads = 1})));
    });
}

TEST(LineMarch, ALampFarAwayIsTheSun)
{
    const Terrain terrain = make_mountains({.grid = {80, 70, {30.0, 30.0}}, .seed = 4});
    const DirectionalLight sun{203_deg, 14_deg};
    constexpr double kAway = 1e9; // metres
    const PointLight lamp{{-std::cos(sun.azimuth.radians()) * kAway / 30.0,
                           std::sin(sun.azimuth.radians()) * kAway / 30.0,
                           kAway * std::tan(sun.altitude.radians())}};
    const auto differing = [](const ShadowMask& a, const ShadowMask& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            count += a.values()[i] != b.values()[i];
        return count;
    };
    EXPECT_LE(differing(cast_by_line_march(terrain, lamp), cast_by_line_march(terrain, sun)), 3U);
    EXPECT_LE(
        differing(cast_by_line_march_bilinear(terrain, lamp), cast_by_line_march_bilinear(terrain, sun)), 3U);
}

// What docs/algorithms/line-march.md says of the nearest sample.
TEST(LineMarch, TheNearestSampleDarkensASlopeAcrossLowLightAndTheBilinearSurfaceDoesNot)
{
    const Terrain slope = make_plane({.grid = {40, 40, {10.0, 10.0}}, .slope = 40_deg, .aspect = 0_deg});
    const DirectionalLight light{.azimuth = 105_deg,
                                 .altitude = 20_deg}; // 12 degrees are the slope's that way
    ASSERT_TRUE(same_mask(cast_by_ray(slope, light), ShadowMask(40, 40, Lit::yes)));
    EXPECT_TRUE(same_mask(cast_by_line_march_bilinear(slope, light), ShadowMask(40, 40, Lit::yes)));
    EXPECT_EQ(cast_by_line_march(slope, light)(20, 20), Lit::no);
}

} // namespace
} // namespace duskline
