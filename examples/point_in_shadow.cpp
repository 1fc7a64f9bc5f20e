// Is this point in the sun? For any point, on the ground or above it, by a ray.

#include <duskline/casting/ray.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <iostream>

int main()
{
    using namespace duskline::angle_literals;

    // A cone 300 m high in the middle of a plain, cells of 10 m; the sun in the west, 15 degrees up.
    const duskline::Terrain terrain =
        duskline::make_cone({.grid = {.rows = 201, .columns = 401, .cell_size_m = {.x = 10.0, .y = 10.0}},
                             .height_m = 300.0,
                             .slope = 30_deg});
    const duskline::DirectionalLight sun{.azimuth = 270_deg, .altitude = 15_deg};

    // Made once; it answers any number of questions, from any thread.
    const duskline::TerrainRays rays(terrain);

    // Rows count southwards and columns eastwards from the centre of the first cell, fractions allowed.
    // The cone stands on row 100, column 200.
    for (const double column : {100.0, 280.5, 300.0, 320.0})
        for (const double height_m : {0.0, 50.0}) {
            const duskline::GridPoint point{.row = 100.0, .column = column, .height_m = height_m};
            std::cout << "column " << column << ", " << height_m
                      << " m up: " << (rays.is_shadowed(point, sun) ? "in shadow" : "in the sun") << '\n';
        }

    std::cout << "at column 280.5 the sun shines from " << rays.shadow_height_m(100.0, 280.5, sun)
              << " m up\n";
}
