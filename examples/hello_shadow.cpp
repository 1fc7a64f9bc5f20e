// A hill on a plain under a low evening sun, and the shadow it casts, as text.

#include <duskline/casting/casters.h>
#include <duskline/terrain/height_field.h>

#include <cmath>
#include <iostream>

namespace {

// A round hill, 60 m high, left of the middle of a plain 960 m wide; cells of 20 m.
duskline::Terrain hill_on_a_plain()
{
    duskline::Terrain terrain{duskline::Grid<float>(24, 48), {.x = 20.0, .y = 20.0}};
    for (std::size_t row = 0; row < terrain.heights_m.rows(); ++row)
        for (std::size_t column = 0; column < terrain.heights_m.columns(); ++column) {
            const double south_m = 20.0 * (static_cast<double>(row) - 11.5);
            const double east_m = 20.0 * (static_cast<double>(column) - 14.5);
            const double distance_m = std::hypot(south_m, east_m);
            terrain.heights_m(row, column) =
                static_cast<float>(60.0 * std::exp(-std::pow(distance_m / 80.0, 2)));
        }
    return terrain;
}

} // namespace

int main()
{
    using namespace duskline::angle_literals;

    const duskline::Terrain terrain = hill_on_a_plain();
    const duskline::DirectionalLight evening_sun{.azimuth = 280_deg, .altitude = 8_deg};
    const duskline::Caster& caster = duskline::caster_named("ray");
    const duskline::ShadowMask mask = caster.cast(terrain, evening_sun, {});

    for (std::size_t row = 0; row < mask.rows(); ++row) {
        for (const duskline::Lit lit : mask.row(row))
            std::cout << (lit == duskline::Lit::no ? '#' : '.');
        std::cout << '\n';
    }
}
