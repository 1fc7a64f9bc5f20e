#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace duskline {
namespace {

constexpr double kRadius_m = 6371000.0;

TEST(EarthCurvature, TheGroundFallsAsTheTablesSay)
{
    for (const auto& [distance_km, drop_m] : {std::pair{1.0, 0.078},
                                              {5.0, 1.962},
                                              {10.0, 7.848},
                                              {20.0, 31.392},
                                              {50.0, 196.202},
                                              {100.0, 784.806},
                                              {200.0, 3139.225}})
        EXPECT_NEAR(curvature_drop_m(distance_km * 1000.0, 1.0, kRadius_m), drop_m, 0.0006) << distance_km;
    EXPECT_NEAR(curvature_drop_m(50e3, 6.0 / 7.0, kRadius_m), 168.173, 0.0006);
    EXPECT_NEAR(curvature_drop_m(100e3, 6.0 / 7.0, kRadius_m), 672.691, 0.0006);
    EXPECT_NEAR(curvature_drop_m(100e3, 0.87, kRadius_m), 682.781, 0.0006);
    EXPECT_EQ(curvature_drop_m(100e3, 0.0, kRadius_m), 0.0);
}

TEST(EarthCurvature, EveryCellSinksByItsDistanceFromTheTangentPoint)
{
    const EarthCurvature curvature{.tangent_row = 10.25, .tangent_column = 31.5};
    Grid<float> heights(41, 64, 1000.0f);
    CurvedEarth(curvature, {900.0, 700.0}, 64).lower(heights.view());
    for (std::size_t row = 0; row < 41; ++row)
        for (std::size_t column = 0; column < 64; ++column) {
            const double distance = std::hypot((static_cast<double>(row) - 10.25) * 700.0,
                                               (static_cast<double>(column) - 31.5) * 900.0);
            EXPECT_NEAR(heights(row, column), 1000.0 - curvature_drop_m(distance, 6.0 / 7.0, kRadius_m),
                        1e-4);
        }
}

TEST(EarthCurvature, AFlatEarthChangesNoBit)
{
    const Terrain before = make_mountains({.grid = {.rows = 30, .columns = 50, .cell_size_m = {90.0, 90.0}}});
    Grid<float> after = before.heights_m.copy();
    CurvedEarth({.coefficient = 0.0, .tangent_row = 7.0}, before.cell_size_m, 50).lower(after.view());
    for (std::size_t i = 0; i < after.size(); ++i)
        EXPECT_EQ(after.values()[i], before.heights_m.values()[i]);
}

TEST(EarthCurvature, BlocksGiveTheBitsOfTheWhole)
{
    const Terrain terrain =
        make_mountains({.grid = {.rows = 53, .columns = 71, .cell_size_m = {300.0, 300.0}}});
    const CurvedEarth earth({.tangent_row = 26.0, .tangent_column = 35.0}, terrain.cell_size_m, 71);
    Grid<float> whole = terrain.heights_m.copy();
    earth.lower(whole.view());
    Grid<float> blocks = terrain.heights_m.copy();
    for (std::size_t row = 0; row < 53; row += 17)
        for (std::size_t column = 0; column < 71; column += 13)
            earth.lower(blocks.view().window(row, column, std::min<std::size_t>(17, 53 - row),
                                             std::min<std::size_t>(13, 71 - column)),
                        row, column);
    for (std::size_t i = 0; i < whole.size(); ++i)
        EXPECT_EQ(blocks.values()[i], whole.values()[i]);
}

TEST(EarthCurvature, NoDataStaysNoData)
{
    Grid<float> heights(3, 3, std::numeric_limits<float>::quiet_NaN());
    CurvedEarth({}, {30.0, 30.0}, 3).lower(heights.view());
    for (const float height : heights.values())
        EXPECT_TRUE(std::isnan(height));
}

TEST(EarthCurvature, ValuesOutOfRangeAreRefused)
{
    const double nan = std::nan("");
    EXPECT_THROW(CurvedEarth({}, {0.0, 1.0}, 3), InvalidInput);
    EXPECT_THROW(CurvedEarth({.coefficient = nan}, {}, 3), InvalidInput);
    EXPECT_THROW(CurvedEarth({.radius_m = 0.0}, {}, 3), InvalidInput);
    EXPECT_THROW(CurvedEarth({.radius_m = nan}, {}, 3), InvalidInput);
    EXPECT_THROW(CurvedEarth({.tangent_row = nan}, {}, 3), InvalidInput);
    EXPECT_THROW(CurvedEarth({.tangent_column = nan}, {}, 3), InvalidInput);
}

} // namespace
} // namespace duskline
