#pragma once

// A planet with a source of its own, for tests.

#include <duskline/planet/planet_terrain.h>

#include <cmath>
#include <vector>

namespace duskline {

inline PlanetTerrain hilly_planet(const Globe& globe, double cell_deg, const PlanetTerrainOptions& options)
{
    const auto rows = static_cast<std::size_t>(std::lround(180.0 / cell_deg));
    PlanetSource source = {Grid<float>(rows, 2 * rows), Angle::from_degrees(-180.0),
                           Angle::from_degrees(90.0), Angle::from_degrees(cell_deg),
                           Angle::from_degrees(cell_deg)};
    const double height_m = 2e-3 * globe.equatorial_radius_m;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < 2 * rows; ++column) {
            const double latitude = 90.0 - (static_cast<double>(row) + 0.5) * cell_deg;
            const double longitude = (static_cast<double>(column) + 0.5) * cell_deg;
            source.heights_m(row, column) =
                static_cast<float>(height_m
                                   * (1.0 + std::sin(0.2 * longitude) * std::cos(0.3 * latitude)
                                      + 0.3 * std::sin(1.3 * longitude + 0.7 * latitude)));
        }
    std::vector<PlanetSource> sources;
    sources.push_back(std::move(source));
    return PlanetTerrain(globe, std::move(sources), options);
}

/// With mountains 200 m high and samples of 25 m, which needs few levels.
inline PlanetTerrain small_planet()
{
    return hilly_planet(sphere_of_radius(50000.0), 1.0, {.sea = false, .finest_spacing_m = 25.0});
}

inline Vector3 direction_of_degrees(const Globe& globe, double longitude, double latitude)
{
    return direction_at(globe, {Angle::from_degrees(longitude), Angle::from_degrees(latitude)});
}

} // namespace duskline
