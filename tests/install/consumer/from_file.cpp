// A foreign project that reads its terrain from a file: the wall of main.cpp, as ASCII grid.

#include <duskline/casting/ray.h>
#include <duskline/raster_io/read_height_field.h>

#include <algorithm>
#include <iostream>

int main(int, char** arguments)
{
    using namespace duskline::angle_literals;

    duskline::HeightFile file(arguments[1]);
    const duskline::Terrain terrain = duskline::read_terrain(file);
    const auto mask = duskline::cast_by_ray(terrain, {.azimuth = 90_deg, .altitude = 44.9_deg});
    std::cout << "file: " << std::ranges::count(mask.row(0), duskline::Lit::no) << " cells\n";
}
