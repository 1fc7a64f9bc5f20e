#include <duskline/casting/light_frame.h>

#include <gtest/gtest.h>

#include <cmath>

namespace duskline {
namespace {

using namespace angle_literals;

LightFrame frame_from(double azimuth, CellSize cell = {1.0, 1.0})
{
    return light_frame({.azimuth = Angle::from_degrees(azimuth), .altitude = 45_deg}, cell);
}

TEST(LightFrame, LinesLieAcrossTheLightAndTheFirstIsNearestToIt)
{
    EXPECT_TRUE(frame_from(0.0).lines_are_rows);
    EXPECT_TRUE(frame_from(0.0).first_line_is_index_0) << "row 0 lies north";
    EXPECT_FALSE(frame_from(90.0).lines_are_rows);
    EXPECT_FALSE(frame_from(90.0).first_line_is_index_0) << "the last column lies east";
    EXPECT_TRUE(frame_from(180.0).lines_are_rows);
    EXPECT_FALSE(frame_from(180.0).first_line_is_index_0);
    EXPECT_FALSE(frame_from(270.0).lines_are_rows);
    EXPECT_TRUE(frame_from(270.0).first_line_is_index_0);
}

TEST(LightFrame, LightAlongAnAxisMovesNotSideways)
{
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0})
        for (const double beside : {0.0, 1e-13, -1e-9, 1e-5})
            EXPECT_EQ(frame_from(azimuth + beside).lateral, 0.0) << azimuth << ' ' << beside;
    EXPECT_NE(frame_from(1e-4).lateral, 0.0);
}

TEST(LightFrame, LightMovesSidewaysAndFallsByItsTangents)
{
    const double tangent_30 = std::sqrt(1.0 / 3.0);
    // Away from a light 30 degrees east of north: south, and west, where columns count down.
    EXPECT_NEAR(frame_from(30.0).lateral, -tangent_30, 1e-15);
    EXPECT_NEAR(frame_from(30.0).drop_m, 1.0 / std::sqrt(0.75), 1e-15);
    // 60 degrees: west, and south, where rows count up.
    EXPECT_NEAR(frame_from(60.0).lateral, tangent_30, 1e-15);
    // Columns three times as far apart as rows: fewer columns go by per row.
    EXPECT_NEAR(frame_from(30.0, {3.0, 1.0}).lateral, -tangent_30 / 3.0, 1e-15);
    EXPECT_TRUE(frame_from(60.0, {3.0, 1.0}).lines_are_rows);
    EXPECT_NEAR(frame_from(0.0, {3.0, 2.0}).drop_m, 2.0, 1e-15);
    EXPECT_NEAR(frame_from(90.0, {3.0, 2.0}).drop_m, 3.0, 1e-15);
}

TEST(LightFrame, NothingMovesMoreThanACellPerLine)
{
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 0.7)
        for (const double ratio : {0.3, 1.0, 2.2}) {
            const LightFrame frame = frame_from(azimuth, {ratio, 1.0});
            EXPECT_LE(std::abs(frame.lateral), 1.0) << azimuth;
            EXPECT_GT(frame.drop_m, 0.0) << azimuth;
        }
}

TEST(LightFrame, AQuarterTurnTurnsLinesToTheBitOnDiagonalsToo)
{
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 11.25) {
        const LightFrame frame = frame_from(azimuth, {2.0, 3.0});
        const LightFrame turned = frame_from(azimuth + 90.0, {3.0, 2.0});
        EXPECT_NE(frame.lines_are_rows, turned.lines_are_rows) << azimuth;
        EXPECT_EQ(std::abs(frame.lateral), std::abs(turned.lateral)) << azimuth;
        EXPECT_EQ(frame.drop_m, turned.drop_m) << azimuth;
        const LightFrame square = frame_from(azimuth);
        EXPECT_NE(square.lines_are_rows, frame_from(azimuth + 90.0).lines_are_rows) << azimuth;
    }
}

TEST(LightOrder, BeginsAtTheLight)
{
    Grid<int> grid(2, 3);
    for (std::size_t i = 0; i < 6; ++i)
        grid.values()[i] = static_cast<int>(i); // 0 1 2 / 3 4 5
    const auto from = [&](double azimuth) { return in_light_order(grid.view(), frame_from(azimuth)); };
    EXPECT_EQ(from(0.0).at(1, 2), 5);
    EXPECT_EQ(from(180.0).at(0, 2), 5) << "row 1 is nearest";
    EXPECT_EQ(from(90.0).lines, 3U);
    EXPECT_EQ(from(90.0).cells, 2U);
    EXPECT_EQ(from(90.0).at(0, 1), 5) << "column 2 is nearest";
    EXPECT_EQ(from(270.0).at(0, 1), 3) << "column 0 is nearest";
}

} // namespace
} // namespace duskline
