#include "made_raster.h"

#include <duskline/planet/planet_terrain.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/raster_io/read_planet_source.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duskline {
namespace {

using raster_test::MadeRaster;
using raster_test::shared_data;

class ReadPlanetSource : public raster_test::FolderTest {};

constexpr const char* kHawaii = DUSKLINE_DATA "/hawaii_2048.tif";
constexpr const char* kWorld = DUSKLINE_DATA "/etopo20_world.tif";

LonLat degrees(double longitude, double latitude)
{
    return {Angle::from_degrees(longitude), Angle::from_degrees(latitude)};
}

float highest_m(const PlanetSource& source)
{
    return std::ranges::max(source.heights_m.values(), [](float a, float b) {
        return (std::isnan(a) ? -1e9f : a) < (std::isnan(b) ? -1e9f : b);
    });
}

TEST_F(ReadPlanetSource, TakesDegreesAsTheyAre)
{
    MadeRaster raster;
    raster.crs = "EPSG:4326";
    raster.geotransform = std::array{-10.0, 0.5, 0.0, 47.0, 0.0, -0.5};
    const PlanetSourceFile file = read_planet_source(made(raster));
    EXPECT_EQ(file.source.heights_m.rows(), 4U);
    EXPECT_EQ(file.source.heights_m(3, 5), 305.0f);
    EXPECT_DOUBLE_EQ(file.source.west.degrees(), -10.0);
    EXPECT_DOUBLE_EQ(file.source.north.degrees(), 47.0);
    EXPECT_DOUBLE_EQ(file.source.cell_height.degrees(), 0.5);
    EXPECT_TRUE(file.is_earth);
    EXPECT_NEAR(file.globe.polar_radius_m, kWgs84.polar_radius_m, 1e-3);
}

TEST_F(ReadPlanetSource, TurnsSouthUpRastersRound)
{
    MadeRaster raster;
    raster.crs = "EPSG:4326";
    raster.geotransform = std::array{-10.0, 0.5, 0.0, 45.0, 0.0, 0.5};
    const PlanetSourceFile file = read_planet_source(made(raster));
    EXPECT_EQ(file.source.heights_m(0, 5), 305.0f);
    EXPECT_DOUBLE_EQ(file.source.north.degrees(), 47.0);
    EXPECT_DOUBLE_EQ(file.source.cell_height.degrees(), 0.5);
}

TEST_F(ReadPlanetSource, KeepsUnitsAndLeavesOutNoData)
{
    MadeRaster raster;
    raster.crs = "EPSG:4326";
    raster.geotransform = std::array{-10.0, 0.5, 0.0, 47.0, 0.0, -0.5};
    raster.no_data = 101.0;
    raster.scale = 2.0;
    const PlanetSourceFile file = read_planet_source(made(raster));
    EXPECT_TRUE(std::isnan(file.source.heights_m(1, 1)));
    EXPECT_EQ(file.source.heights_m(2, 3), 406.0f);
}

TEST_F(ReadPlanetSource, WarpsAMapToThePlacesItShows)
{
    // 600 x 600 km around 15 east, 40 north in UTM 33: heights are the latitudes.
    MadeRaster raster;
    raster.rows = 60;
    raster.columns = 60;
    raster.geotransform = std::array{200000.0, 10000.0, 0.0, 4700000.0, 0.0, -10000.0};
    raster.value = [](std::size_t, std::size_t row, std::size_t) {
        return (4695000.0 - 10000.0 * static_cast<double>(row)) / 1000.0;
    };
    const PlanetSourceFile file = read_planet_source(made(raster));
    // On the central meridian, where northings are arcs of the meridian times 0.9996.
    std::vector<PlanetSource> sources;
    sources.push_back({file.source.heights_m.copy(), file.source.west, file.source.north,
                       file.source.cell_width, file.source.cell_height});
    const PlanetTerrain terrain(file.globe, std::move(sources), {.detail = 0.0, .border_cells = 3});
    EXPECT_NEAR(terrain.height_m(direction_at(file.globe, degrees(15.0, 40.0)), 9), 4427.757,
                0.5); // km of northing
    EXPECT_TRUE(std::isnan(file.source.heights_m(0, 0)) || file.source.heights_m(0, 0) > 4600.0f);
}

TEST_F(ReadPlanetSource, RefusesRastersWithoutAPlace)
{
    MadeRaster raster;
    raster.crs = "";
    raster.geotransform = std::nullopt;
    const std::string lost = made(raster);
    EXPECT_THROW(
        {
            try {
                read_planet_source(lost);
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), testing::HasSubstr("heights.tif"));
                EXPECT_THAT(error.what(), testing::HasSubstr("gdal_edit.py"));
                throw;
            }
        },
        InputError);
    EXPECT_THROW(read_planet_source(path("none.tif")), InputError);
}

TEST(PlanetOfFiles, HasTheIslandOfHawaiiInAWholeEarth)
{
    std::vector<PlanetSource> sources;
    sources.push_back(read_planet_source(kWorld).source);
    PlanetSourceFile island = read_planet_source(kHawaii);
    const float summit_m = highest_m(island.source);
    EXPECT_GT(summit_m, 4180.0f);
    sources.push_back(std::move(island.source));
    const PlanetTerrain earth(kWgs84, std::move(sources), {.detail = 0.0});

    // Mauna Kea, the caldera of Mauna Loa, and a slope, as `gdallocationinfo -wgs84` reads them from the map.
    EXPECT_NEAR(earth.height_m(direction_at(kWgs84, degrees(-155.4681, 19.8207)), 14), 4198.4, 10.0);
    EXPECT_NEAR(earth.height_m(direction_at(kWgs84, degrees(-155.6027, 19.4755)), 14), 3991.1, 10.0);
    EXPECT_NEAR(earth.height_m(direction_at(kWgs84, degrees(-155.3, 19.6)), 14), 1499.0, 10.0);
    EXPECT_EQ(earth.height_m(direction_at(kWgs84, degrees(-154.75, 19.0)), 14), 0.0f);
    // Elsewhere the coarse world: Tibet high, the Pacific and the North Pole sea.
    EXPECT_GT(earth.height_m(direction_at(kWgs84, degrees(88.0, 32.0)), 8), 4000.0f);
    EXPECT_EQ(earth.height_m(direction_at(kWgs84, degrees(-140.0, 0.0)), 8), 0.0f);
    EXPECT_EQ(earth.height_m(direction_at(kWgs84, degrees(0.0, 90.0)), 8), 0.0f);
    EXPECT_GT(earth.height_m(direction_at(kWgs84, degrees(0.0, -90.0)), 8), 2000.0f);
}

TEST(PlanetOfFiles, HasTychoOnTheMoon)
{
    DUSKLINE_NEED_SHARED_DATA("moon/moon_tycho_2048.tif");
    const PlanetSourceFile moon = read_planet_source(shared_data("moon/moon_tycho_2048.tif"));
    EXPECT_EQ(moon.globe, sphere_of_radius(kMoonRadius_m));
    EXPECT_FALSE(moon.is_earth);
    EXPECT_NEAR(moon.source.west.degrees(), -32.0, 0.02);
    EXPECT_NEAR(moon.source.north.degrees(), -30.0, 0.02);
    std::vector<PlanetSource> sources;
    sources.push_back({moon.source.heights_m.copy(), moon.source.west, moon.source.north,
                       moon.source.cell_width, moon.source.cell_height});
    const PlanetTerrain terrain(moon.globe, std::move(sources), {.sea = false, .detail = 0.0});
    const auto height_m = [&](double longitude, double latitude) {
        return terrain.height_m(direction_at(moon.globe, degrees(longitude, latitude)), 11);
    };
    // Tycho's northern rim, floor and middle peak, as `gdallocationinfo -geoloc` reads them from the map.
    EXPECT_NEAR(height_m(-11.36, -41.9), 1948.0, 60.0);
    EXPECT_NEAR(height_m(-11.36, -42.9), -2467.0, 30.0);
    EXPECT_NEAR(height_m(-11.36, -43.31), -911.0, 60.0);
}

} // namespace
} // namespace duskline
