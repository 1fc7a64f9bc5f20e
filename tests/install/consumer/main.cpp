// A foreign project: a 10 m wall in a sun at 45 degrees shades ten cells of one metre.

#include <duskline/casting/casters.h>
#include <duskline/terrain/height_field.h>

#include <algorithm>
#include <iostream>

int main()
{
    using namespace duskline::angle_literals;

    duskline::Terrain terrain{duskline::Grid<float>(1, 32, 0.0f), {.x = 1.0, .y = 1.0}};
    terrain.heights_m(0, 20) = 10.0f;
    for (const duskline::Caster& caster : duskline::kCasters) {
        const auto mask = caster.cast(terrain, {.azimuth = 90_deg, .altitude = 44.9_deg}, {});
        std::cout << caster.name << ": " << std::ranges::count(mask.row(0), duskline::Lit::no) << " cells\n";
    }
}
