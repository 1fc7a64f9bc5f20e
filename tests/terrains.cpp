#include "terrains.h"

#include <duskline/terrain/ground_height.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace duskline {

double Dice::between(double low, double high)
{
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
}

std::size_t Dice::below(std::size_t count)
{
    return static_cast<std::size_t>(engine_() % count);
}

namespace {

void add_spikes(Dice& dice, Terrain& terrain)
{
    for (float& height_m : terrain.heights_m.values())
        if (dice.chance(0.02))
            height_m += static_cast<float>(dice.between(-200.0, 400.0));
}

void add_terraces(Dice& dice, Terrain& terrain)
{
    const auto step_m = static_cast<float>(dice.between(20.0, 200.0));
    for (float& height_m : terrain.heights_m.values())
        height_m = std::floor(height_m / step_m) * step_m;
}

void add_block(Dice& dice, Terrain& terrain, float height_m)
{
    Grid<float>& heights_m = terrain.heights_m;
    const std::size_t top = dice.below(heights_m.rows());
    const std::size_t left = dice.below(heights_m.columns());
    const std::size_t bottom = std::min(heights_m.rows(), top + 1 + dice.below(12));
    const std::size_t right = std::min(heights_m.columns(), left + 1 + dice.below(12));
    for (std::size_t row = top; row < bottom; ++row)
        for (std::size_t column = left; column < right; ++column)
            heights_m(row, column) = height_m;
}

void add_holes(Dice& dice, Terrain& terrain)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    add_block(dice, terrain, nan);
    for (float& height_m : terrain.heights_m.values())
        if (dice.chance(0.01))
            height_m = nan;
}

void roughen(Dice& dice, Terrain& terrain)
{
    if (dice.chance(0.3))
        add_terraces(dice, terrain);
    if (dice.chance(0.5))
        add_spikes(dice, terrain);
    for (int i = 0; i < 3; ++i)
        if (dice.chance(0.5))
            add_block(dice, terrain, static_cast<float>(dice.between(0.0, 1500.0)));
}

} // namespace

Terrain random_terrain(Dice& dice, const RandomTerrainOptions& options)
{
    const auto count = [&] { return options.smallest + dice.below(options.largest - options.smallest + 1); };
    const double cell_m = dice.between(5.0, 90.0);
    const double ratio = options.square_cells || dice.chance(0.5) ? 1.0 : dice.between(0.4, 2.5);
    MountainsOptions mountains;
    mountains.grid = {.rows = count(), .columns = count(), .cell_size_m = {cell_m, cell_m * ratio}};
    mountains.seed = dice.below(1U << 30U);
    mountains.lowest_m = dice.between(-500.0, 500.0);
    mountains.feature_m = dice.between(8.0, 60.0) * cell_m;
    mountains.height_m = mountains.feature_m * dice.between(0.1, 0.6);
    Terrain terrain = make_mountains(mountains, {.threads = 1});
    if (options.rough)
        roughen(dice, terrain);
    if (options.eighths)
        for (float& height_m : terrain.heights_m.values())
            height_m = std::round(height_m * 8.0f) / 8.0f;
    if (options.holes && dice.chance(0.5))
        add_holes(dice, terrain);
    return terrain;
}

DirectionalLight random_light(Dice& dice)
{
    double azimuth = dice.between(-360.0, 720.0);
    if (dice.chance(0.3)) {
        constexpr std::array beside{0.0, 0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-5, -1e-5};
        azimuth = static_cast<double>(dice.below(9)) * 45.0 + beside[dice.below(beside.size())];
    }
    // Whole multiples of 2^-40 degrees: a quarter turn added to them is exact.
    azimuth = std::round(azimuth * 0x1p40) * 0x1p-40;
    double altitude = dice.between(1.0, 75.0);
    if (dice.chance(0.1)) {
        constexpr std::array extreme{1e-6, 0.01, 0.3, 89.0, 89.999, 90.0 - 1e-12};
        altitude = extreme[dice.below(extreme.size())];
    }
    return {.azimuth = Angle::from_degrees(azimuth), .altitude = Angle::from_degrees(altitude)};
}

namespace {

// A coordinate of a lamp along `count` samples, a multiple of 2^-30: turning it is exact.
double lamp_coordinate(Dice& dice, std::size_t count)
{
    const double last = static_cast<double>(count) - 1.0;
    double place = dice.between(0.0, last);
    if (dice.chance(0.15))
        place = dice.between(-1.5 * last - 2.0, 2.5 * last + 2.0);
    else if (dice.chance(0.03))
        place = dice.between(-1e6, 1e6);
    if (dice.chance(0.3)) {
        constexpr std::array beside{0.0, 0.0, 0.0, 0.5, 1e-5, -1e-5, 0.01, -0.01};
        place = std::round(place) + beside[dice.below(beside.size())];
    }
    return std::round(place * 0x1p30) * 0x1p-30;
}

} // namespace

PointLight random_lamp(Dice& dice, const HeightField& field)
{
    PointLight lamp;
    lamp.position.row = lamp_coordinate(dice, field.rows());
    lamp.position.column = lamp_coordinate(dice, field.columns());
    const auto ground_m = ground_height_m(field, lamp.position.row, lamp.position.column);
    const HeightRange range = height_range(field);
    const double lowest_m = std::isfinite(range.lowest_m) ? range.lowest_m : 0.0;
    const double relief_m = std::isfinite(range.lowest_m) ? range.highest_m - lowest_m + 1.0 : 1.0;
    const double choice = dice.between(0.0, 1.0);
    if (choice < 0.5 || !ground_m)
        lamp.position.height_m = lowest_m + relief_m * dice.between(-0.2, 1.5);
    else if (choice < 0.95)
        lamp.position.height_m = *ground_m + relief_m * std::pow(dice.between(0.0, 1.0), 3.0);
    else
        lamp.position.height_m = *ground_m;
    // A lamp far away that sees the ground at all.
    const double away = std::hypot(lamp.position.row, lamp.position.column) / 300.0;
    if (away > 1.0)
        lamp.position.height_m += relief_m * away * dice.between(0.0, 2.0);
    return lamp;
}

DirectionalLight random_sun(Dice& dice, CellSize cell_size_m)
{
    double azimuth = dice.between(0.0, 360.0);
    if (dice.chance(1.0 / 3.0)) {
        const double across_cells = Angle::from_radians(std::atan2(cell_size_m.x, cell_size_m.y)).degrees();
        const double quarter = 90.0 * static_cast<double>(dice.below(4));
        const std::array directions{quarter,
                                    quarter + 45.0,
                                    across_cells,
                                    180.0 - across_cells,
                                    180.0 + across_cells,
                                    360.0 - across_cells};
        constexpr std::array beside{0.0, 0.0, 0.0, 1e-9, -1e-9, 1e-4, -1e-4};
        azimuth = directions[dice.below(directions.size())] + beside[dice.below(beside.size())];
    }
    const double altitude = std::exp(dice.between(std::log(0.5), std::log(85.0)));
    return {.azimuth = Angle::from_degrees(azimuth), .altitude = Angle::from_degrees(altitude)};
}

void for_seeds(std::uint64_t count, const std::function<void(Dice& dice)>& check)
{
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Dice dice(seed);
        check(dice);
        if (testing::Test::HasFailure())
            return;
    }
}

Terrain copy_of(const HeightField& field)
{
    Terrain copy{Grid<float>(field.rows(), field.columns()), field.cell_size_m};
    for (std::size_t row = 0; row < field.rows(); ++row)
        std::ranges::copy(field.heights_m.row(row), copy.heights_m.row(row).begin());
    return copy;
}

Terrain turned(const Terrain& terrain)
{
    return {turned(terrain.heights_m), {terrain.cell_size_m.y, terrain.cell_size_m.x}};
}

DirectionalLight turned(const DirectionalLight& light)
{
    DirectionalLight result = light;
    result.azimuth = light.azimuth + Angle::from_degrees(90.0);
    return result;
}

PointLight turned(const PointLight& lamp, const Terrain& terrain)
{
    const double last_row = static_cast<double>(terrain.heights_m.rows()) - 1.0;
    return {{lamp.position.column, last_row - lamp.position.row, lamp.position.height_m}};
}

Terrain mirrored(const Terrain& terrain)
{
    return {mirrored(terrain.heights_m), terrain.cell_size_m};
}

DirectionalLight mirrored(const DirectionalLight& light)
{
    DirectionalLight result = light;
    result.azimuth = -light.azimuth;
    return result;
}

PointLight mirrored(const PointLight& lamp, const Terrain& terrain)
{
    const double last_column = static_cast<double>(terrain.heights_m.columns()) - 1.0;
    return {{lamp.position.row, last_column - lamp.position.column, lamp.position.height_m}};
}

Terrain framed_by_no_data(const Terrain& terrain, std::size_t cells)
{
    const std::size_t rows = terrain.heights_m.rows();
    const std::size_t columns = terrain.heights_m.columns();
    Terrain framed{
        Grid<float>(rows + 2 * cells, columns + 2 * cells, std::numeric_limits<float>::quiet_NaN()),
        terrain.cell_size_m};
    for (std::size_t row = 0; row < rows; ++row)
        std::ranges::copy(terrain.heights_m.row(row),
                          framed.heights_m.row(row + cells).begin() + static_cast<std::ptrdiff_t>(cells));
    return framed;
}

} // namespace duskline
