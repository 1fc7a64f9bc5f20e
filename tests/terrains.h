#pragma once

// Terrains for tests: random and nasty ones, and ways to turn, mirror and change them.

#include <duskline/light/directional_light.h>
#include <duskline/light/point_light.h>
#include <duskline/terrain/height_field.h>

#include <cstdint>
#include <functional>
#include <random>

namespace duskline {

/// Random numbers that are the same on every machine, as those of <random>'s distributions are not.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}

    /// In [low, high).
    double between(double low, double high);
    /// 0 to count - 1.
    std::size_t below(std::size_t count);
    bool chance(double probability) { return between(0.0, 1.0) < probability; }

private:
    std::mt19937_64 engine_;
};

/// What a random terrain may be made of.
struct RandomTerrainOptions {
    std::size_t smallest = 1; ///< rows and columns, both
    std::size_t largest = 60;
    bool rough = true; ///< spikes, cliffs and terraces, not only mountains
    bool holes = true; ///< no-data
    bool square_cells = false;
    bool eighths = false; ///< all heights multiples of 1/8 metre
};

/// A small terrain of random size, cells and make. Steep: shadows are some cells to some dozen cells long at
/// altitudes of 5 to 60 degrees.
Terrain random_terrain(Dice& dice, const RandomTerrainOptions& options = {});

/// Any azimuth, with those along rows, columns and diagonals, and next to them, more often than chance has
/// it; altitudes of 1 to 75 degrees, sometimes nearly 0 or 90.
DirectionalLight random_light(Dice& dice);

/// A lamp anywhere: over the grid, on its lines and samples and next to them, beside it and far away; low, high,
/// between the heights of the terrain, on the ground and now and then under it.
PointLight random_lamp(Dice& dice, const HeightField& field);

/// Where the sun may stand: altitudes of 0.5 to 85 degrees, low ones as often as high ones are by their
/// logarithms; any azimuth, but one in three along an axis or a diagonal, of the ground or of the cells, or
/// next to it.
DirectionalLight random_sun(Dice& dice, CellSize cell_size_m);

/// Calls `check(dice)` with `count` different seeds, and names the seed when it fails.
void for_seeds(std::uint64_t count, const std::function<void(Dice& dice)>& check);

Terrain copy_of(const HeightField& field);

/// A quarter turn clockwise, of the terrain or of anything on its grid: north becomes east.
template <typename T>
Grid<T> turned(const Grid<T>& grid)
{
    Grid<T> result(grid.columns(), grid.rows());
    for (std::size_t row = 0; row < grid.rows(); ++row)
        for (std::size_t column = 0; column < grid.columns(); ++column)
            result(column, grid.rows() - 1 - row) = grid(row, column);
    return result;
}
Terrain turned(const Terrain& terrain);
DirectionalLight turned(const DirectionalLight& light);
PointLight turned(const PointLight& lamp, const Terrain& terrain);

/// West becomes east.
template <typename T>
Grid<T> mirrored(const Grid<T>& grid)
{
    Grid<T> result(grid.rows(), grid.columns());
    for (std::size_t row = 0; row < grid.rows(); ++row)
        for (std::size_t column = 0; column < grid.columns(); ++column)
            result(row, grid.columns() - 1 - column) = grid(row, column);
    return result;
}
Terrain mirrored(const Terrain& terrain);
DirectionalLight mirrored(const DirectionalLight& light);
PointLight mirrored(const PointLight& lamp, const Terrain& terrain);

/// The terrain with `cells` rows and columns of no data around it.
Terrain framed_by_no_data(const Terrain& terrain, std::size_t cells);

} // namespace duskline
