#include "made_raster.h"

#include <duskline/raster_io/read_height_field.h>

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace duskline {
namespace {

using namespace raster_test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using GeoTransform = std::array<double, 6>;

/// UTM zone 33 north, 30 m: row steps and column steps given in map metres.
GeoTransform utm(double column_x, double column_y, double row_x, double row_y)
{
    return {500000.0, column_x, row_x, 5200000.0, column_y, row_y};
}

class Georeferences : public FolderTest {
protected:
    HeightFile opened(const GeoTransform& gt, const std::string& crs = "EPSG:32633", std::size_t rows = 4,
                      std::size_t columns = 6) const
    {
        return HeightFile(made({.rows = rows, .columns = columns, .geotransform = gt, .crs = crs}));
    }

    std::string refusal(const GeoTransform& gt, const std::string& crs, std::size_t rows = 4,
                        std::size_t columns = 6) const
    {
        return why_not(made({.rows = rows, .columns = columns, .geotransform = gt, .crs = crs}));
    }

    static std::string why_not(const std::string& path)
    {
        try {
            const HeightFile file(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(Georeferences, NorthUpRastersAreTakenAsTheyAre)
{
    const HeightFile file = opened(utm(30, 0, 0, -20));
    EXPECT_EQ(file.ground().cell_size_m.x, 30.0);
    EXPECT_EQ(file.ground().cell_size_m.y, 20.0);
    EXPECT_FALSE(file.ground().rows_flipped);
    EXPECT_FALSE(file.ground().columns_flipped);
    EXPECT_EQ(file.ground().grid_north.degrees(), 0.0);
}

TEST_F(Georeferences, EveryOrientationGivesTheSameTerrain)
{
    // One slope, highest in the north-east, stored in eight ways. Turned by quarters, its north is elsewhere
    // in the grid: then azimuths are turned.
    struct Stored {
        GeoTransform gt;
        bool rows_flipped;
        bool columns_flipped;
        double grid_north;
    };
    for (const Stored& stored :
         {Stored{utm(30, 0, 0, -30), false, false, 0.0}, Stored{utm(30, 0, 0, 30), true, false, 0.0},
          Stored{utm(-30, 0, 0, -30), false, true, 0.0}, Stored{utm(-30, 0, 0, 30), true, true, 0.0}}) {
        MadeRaster raster{.rows = 3, .columns = 3, .geotransform = stored.gt};
        raster.value = [&](std::size_t, std::size_t row, std::size_t column) {
            const double x = stored.gt[1] * static_cast<double>(column);
            const double y = stored.gt[5] * static_cast<double>(row);
            return x / 30.0 + (stored.gt[1] < 0 ? 2.0 : 0.0)
                   + 10.0 * (y / 30.0 + (stored.gt[5] < 0 ? 2.0 : 0.0));
        };
        HeightFile file(made(raster));
        EXPECT_EQ(file.ground().rows_flipped, stored.rows_flipped);
        EXPECT_EQ(file.ground().columns_flipped, stored.columns_flipped);
        EXPECT_EQ(file.ground().grid_north.degrees(), 0.0);
        const Terrain terrain = read_terrain(file);
        for (std::size_t y = 0; y < 3; ++y)
            for (std::size_t x = 0; x < 3; ++x)
                EXPECT_EQ(terrain.heights_m(y, x), static_cast<float>(x + 10 * (2 - y)));
    }
}

TEST_F(Georeferences, RotationTurnsAzimuths)
{
    for (const double turn : {20.0, -20.0, 44.0, 90.0, -90.0, 135.0, 180.0, -100.0}) {
        const double c = 30.0 * std::cos(turn * std::numbers::pi / 180.0);
        const double s = 30.0 * std::sin(turn * std::numbers::pi / 180.0);
        // Clockwise: columns run east and south, rows south and west.
        const HeightFile file = opened(utm(c, -s, -s, -c));
        EXPECT_NEAR(file.ground().cell_size_m.x, 30.0, 1e-9);
        // Turned by more than a right angle it is the same as turned the other way and flipped twice.
        const bool upside_down = std::abs(turn) > 90.0;
        EXPECT_EQ(file.ground().rows_flipped, upside_down) << turn;
        EXPECT_EQ(file.ground().columns_flipped, upside_down) << turn;
        const double rest = upside_down ? turn - std::copysign(180.0, turn) : turn;
        EXPECT_NEAR(file.ground().grid_north.degrees(), rest, 1e-9) << turn;
        EXPECT_NEAR(file.ground().from_map_north(Angle::from_degrees(50.0)).degrees(), 50.0 - rest, 1e-9);
    }
}

TEST_F(Georeferences, MirroredAndRotatedIsBoth)
{
    const HeightFile file = opened(utm(0, -30, 30, 0)); // transposed: rows run east, columns south
    EXPECT_NE(file.ground().rows_flipped, file.ground().columns_flipped);
    EXPECT_NEAR(std::abs(file.ground().grid_north.degrees()), 90.0, 1e-9);
}

TEST_F(Georeferences, ShearedRastersAreRefusedWithARemedy)
{
    EXPECT_THAT(refusal(utm(30, 0, 10, -30), "EPSG:32633"),
                AllOf(HasSubstr("sheared"), HasSubstr("gdalwarp -t_srs EPSG:32633")));
    EXPECT_THAT(opened(utm(30, 0, 0.7, -30)).facts().warnings, ElementsAre(HasSubstr("right angle")));
}

TEST_F(Georeferences, CellsWithoutWidthAreRefused)
{
    for (const char* gt : {"0, 0, 0, 0, 0, -30", "0, nan, 0, 0, 0, -30", "0, 30, 0, 0, 0, 1e400"}) {
        std::ofstream(path("flat.vrt"))
            << "<VRTDataset rasterXSize=\"6\" rasterYSize=\"4\"><GeoTransform>" << gt
            << "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"/>"
               "</VRTDataset>";
        EXPECT_THAT(why_not(path("flat.vrt")), HasSubstr("must be above 0")) << gt;
    }
}

TEST_F(Georeferences, DegreesAreMeasuredAtTheLatitudeOfTheCentre)
{
    // WGS 84 at 45 degrees: 111 131.745 m and 78 846.835 m per degree (its radii of curvature).
    const double cell = 1.0 / 1200.0;
    const HeightFile file = opened({10.0, cell, 0.0, 45.0 + 2 * cell, 0.0, -cell}, "EPSG:4326");
    EXPECT_NEAR(file.ground().cell_size_m.y, 111131.745 * cell, 1e-4);
    EXPECT_NEAR(file.ground().cell_size_m.x, 78846.835 * cell, 1e-4);
    EXPECT_NEAR(file.ground().centre->latitude.degrees(), 45.0, 1e-12);
    EXPECT_NEAR(file.ground().centre->longitude.degrees(), 10.0 + 3 * cell, 1e-12);
    EXPECT_EQ(file.ground().map_north.degrees(), 0.0);
    EXPECT_THAT(file.facts().warnings, IsEmpty());
    EXPECT_THAT(file.facts().notes, ::testing::Contains(HasSubstr("at latitude 45")));
}

TEST_F(Georeferences, DegreesFarNorthAreWarnedAboutAndPolesRefused)
{
    const auto tile = [](double north, double size) {
        return GeoTransform{10.0, size / 6, 0.0, north, 0.0, -size / 4};
    };
    EXPECT_THAT(opened(tile(50.0, 1.0), "EPSG:4326").facts().warnings, ElementsAre(HasSubstr("2.1 %")));
    EXPECT_THAT(opened(tile(61.5, 0.1), "EPSG:4326").facts().warnings, ElementsAre(HasSubstr("EPSG:32632")));
    EXPECT_THAT(refusal(tile(85.0, 8.0), "EPSG:4326"),
                AllOf(HasSubstr("factor of 2"), HasSubstr("gdalwarp")));
    EXPECT_THAT(refusal(tile(90.0, 1.0), "EPSG:4326"), AllOf(HasSubstr("pole"), HasSubstr("+proj=laea")));
    EXPECT_THAT(refusal(tile(90.5, 1.0), "EPSG:4326"), HasSubstr("pole"));
}

TEST_F(Georeferences, GradsAndOtherMeridiansAreUnderstood)
{
    // NTF (Paris), in grads east of Paris: 50 grads north = 45 degrees; Paris is at 2.33722917 degrees.
    const HeightFile file = opened({0.0, 0.001, 0.0, 50.0, 0.0, -0.001}, "EPSG:4807");
    EXPECT_NEAR(file.ground().centre->longitude.degrees(), 2.33722917 + 0.003 * 0.9, 1e-6);
    EXPECT_NEAR(file.ground().centre->latitude.degrees(), (50.0 - 0.002) * 0.9, 1e-9);
    EXPECT_NEAR(file.ground().cell_size_m.y, 100.0, 0.1);
}

TEST_F(Georeferences, MapsInFeetAreMeasuredInMetres)
{
    EXPECT_NEAR(opened({6000000.0, 10.0, 0.0, 2000000.0, 0.0, -10.0}, "EPSG:2227").ground().cell_size_m.x,
                10.0 * 1200.0 / 3937.0, 1e-9);
}

TEST_F(Georeferences, TheNorthOfTheMapIsTurnedFromTrueNorth)
{
    // UTM 33 (15 degrees east) at 12.4 degrees east, 47 north: the convergence is (12.4 - 15) sin 47 =
    // -1.90 degrees, a little more on the ellipsoid.
    const HeightFile file = opened({302400.0, 30.0, 0.0, 5208500.0, 0.0, -30.0});
    EXPECT_NEAR(file.ground().map_north.degrees(), -1.902, 0.003);
    EXPECT_NEAR(file.ground().from_true_north(Angle::from_degrees(180.0)).degrees(), 181.902, 0.003);
    EXPECT_EQ(opened({500000.0 - 90.0, 30.0, 0.0, 5208500.0, 0.0, -30.0}).ground().map_north.degrees(), 0.0);
}

TEST_F(Georeferences, PolarMapsKnowTheirMeridians)
{
    // Polar stereographic north, 0 degrees downwards: at 90 degrees east, to the right, north is leftwards.
    const HeightFile file = opened({1000000.0, 30.0, 0.0, 60.0, 0.0, -30.0}, "EPSG:3995");
    EXPECT_NEAR(file.ground().centre->longitude.degrees(), 90.0, 0.01);
    EXPECT_NEAR(file.ground().map_north.degrees(), 90.0, 0.01);
    // Over the pole itself.
    const HeightFile pole = opened({-90.0, 30.0, 0.0, 60.0, 0.0, -30.0}, "EPSG:3995");
    EXPECT_NEAR(pole.ground().centre->latitude.degrees(), 90.0, 0.01);
    EXPECT_GT(pole.ground().cell_size_m.x, 29.0);
}

TEST_F(Georeferences, TheStretchOfWebMercatorIsTakenOut)
{
    const HeightFile file = opened({1113194.9, 30.0, 0.0, 8399737.9, 0.0, -30.0}, "EPSG:3857"); // 60 north
    EXPECT_NEAR(file.ground().cell_size_m.x, 15.0, 0.1);
    EXPECT_NEAR(file.ground().cell_size_m.y, 15.0, 0.1);
    EXPECT_THAT(file.facts().notes, ::testing::Contains(HasSubstr("stretches")));
}

TEST_F(Georeferences, SouthOrientatedMapsHaveTheirNorthAtTheTop)
{
    // Hartebeesthoek94 / Lo29: x counts west, y counts south. Upper left corner in the north-west.
    const HeightFile file = opened({1000.0, -30.0, 0.0, 3000000.0, 0.0, 30.0}, "EPSG:2053");
    EXPECT_FALSE(file.ground().rows_flipped);
    EXPECT_FALSE(file.ground().columns_flipped);
    EXPECT_EQ(file.ground().grid_north.degrees(), 0.0);
    EXPECT_NEAR(file.ground().map_north.degrees(), 0.0, 0.1);
    EXPECT_NEAR(file.ground().centre->latitude.degrees(), -27.1, 0.1);
}

TEST_F(Georeferences, OtherBodiesKeepTheirRadius)
{
    const HeightFile moon = opened({10.0, 0.01, 0.0, 20.0, 0.0, -0.01},
                                   "GEOGCS[\"Moon\",DATUM[\"Moon\",SPHEROID[\"Moon\",1737400,0]],"
                                   "PRIMEM[\"Reference\",0],UNIT[\"degree\",0.0174532925199433]]");
    EXPECT_EQ(moon.ground().body->name, "Moon");
    EXPECT_FALSE(moon.ground().body->is_earth);
    EXPECT_EQ(moon.ground().body->local_radius_m, 1737400.0);
    EXPECT_NEAR(moon.ground().cell_size_m.y, 1737400.0 * std::numbers::pi / 180.0 * 0.01, 1e-6);
    const HeightFile earth = opened(utm(30, 0, 0, -30));
    EXPECT_TRUE(earth.ground().body->is_earth);
    EXPECT_NEAR(earth.ground().body->local_radius_m, 6380300.0, 2000.0); // sqrt(M N) at 47 degrees
}

TEST_F(Georeferences, WithoutACoordinateSystemUnitsAreMetres)
{
    const HeightFile file = opened({1000.0, 5.0, 0.0, 2000.0, 0.0, -5.0}, "");
    EXPECT_EQ(file.ground().cell_size_m.x, 5.0);
    EXPECT_FALSE(file.ground().centre.has_value());
    EXPECT_FALSE(file.ground().body.has_value());
    EXPECT_THAT(file.facts().warnings, IsEmpty());
    EXPECT_THAT(file.facts().notes, ::testing::Contains(HasSubstr("no coordinate system")));
}

TEST_F(Georeferences, DegreesWithoutACoordinateSystemAreNeverTakenAsMetres)
{
    const GeoTransform degrees = {10.0, 0.001, 0.0, 45.0, 0.0, -0.001};
    EXPECT_THAT(refusal(degrees, ""), AllOf(HasSubstr("look like degrees"), HasSubstr("EPSG:4326")));
    const HeightFile asked(made({.geotransform = degrees, .crs = ""}), {.cell_size_m = 0.001});
    EXPECT_EQ(asked.ground().cell_size_m.x, 0.001);
}

TEST_F(Georeferences, WithoutAnyCellsAreOneMetreWithAWarning)
{
    const std::string path = made({.geotransform = {}, .crs = ""});
    EXPECT_THAT(HeightFile(path).facts().warnings, ElementsAre(HasSubstr("cells taken as 1 m")));
    const HeightFile asked(path, {.cell_size_m = 2.5});
    EXPECT_EQ(asked.ground().cell_size_m.y, 2.5);
    EXPECT_FALSE(asked.ground().rows_flipped);
    EXPECT_THAT(asked.facts().warnings, IsEmpty());
}

TEST(SharedGeoreferences, TychoIsOnTheMoon)
{
    DUSKLINE_NEED_SHARED_DATA("moon/moon_tycho_2048.tif");
    const HeightFile file(shared_data("moon/moon_tycho_2048.tif"));
    EXPECT_EQ(file.ground().body->name, "Moon");
    // Plate carree: true along meridians, stretched by 1 / cos 46 along parallels.
    EXPECT_NEAR(file.ground().cell_size_m.y, 473.80235, 1e-3);
    EXPECT_NEAR(file.ground().cell_size_m.x, 473.80235 * std::cos(46.0 * std::numbers::pi / 180.0), 0.01);
}

TEST(SharedGeoreferences, TheWholeWorldIsRefused)
{
    DUSKLINE_NEED_SHARED_DATA("world/etopo20_world.tif");
    try {
        const HeightFile file(shared_data("world/etopo20_world.tif"));
        FAIL() << "cells of no width were accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("pole"), HasSubstr("gdal_translate -projwin")));
    }
}

} // namespace
} // namespace duskline
