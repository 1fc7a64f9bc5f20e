// Every caster against shadows that are known on paper, from all eight compass directions and odd ones.
//
// The sun stands at altitude alpha. Places are metres from the middle of the terrain, measured in the light's
// own frame: `away` from the sun, and `across`. A cell is held to the formula unless the edge of the shadow
// passes within a cell of it (two for casters that are not exact, which interpolate between beams), and the
// shadow as a whole to its area.

#include "mask_assertions.h"

#include <duskline/casting/casters.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace duskline {
namespace {

using namespace angle_literals;

constexpr std::array kAzimuths{0.0,   45.0,  90.0,  135.0, 180.0, 225.0,       270.0,
                               315.0, 203.0, 100.3, 10.3,  289.7, 45.0 + 1e-9, 90.0 - 1e-9};

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180.0;
}

// Metres from the middle of the terrain.
struct Place {
    double away;
    double across;
};

// Whether the formula puts a place in shadow; nothing where the shape cannot be sampled.
using Formula = std::function<std::optional<bool>(Place)>;

// A formula's answers on a lattice of half cells, three cells beyond the grid on each side.
class FormulaOnGrid {
public:
    FormulaOnGrid(const HeightField& field, const DirectionalLight& light, const Formula& dark)
        : answers_(2 * field.rows() + 2 * kMargin - 1, 2 * field.columns() + 2 * kMargin - 1)
    {
        const double sine = std::sin(radians(light.azimuth.degrees()));
        const double cosine = std::cos(radians(light.azimuth.degrees()));
        const double middle_row = static_cast<double>(answers_.rows() - 1) / 2.0;
        const double middle_column = static_cast<double>(answers_.columns() - 1) / 2.0;
        for (std::size_t row = 0; row < answers_.rows(); ++row)
            for (std::size_t column = 0; column < answers_.columns(); ++column) {
                const double x = (static_cast<double>(column) - middle_column) / 2.0 * field.cell_size_m.x;
                const double y = (middle_row - static_cast<double>(row)) / 2.0 * field.cell_size_m.y;
                const std::optional<bool> answer = dark({-x * sine - y * cosine, x * cosine - y * sine});
                answers_(row, column) = answer ? (*answer ? kDark : kLit) : kUnsure;
            }
    }

    bool dark(std::size_t row, std::size_t column) const { return answer(row, column, 0, 0) == kDark; }

    // Whether another answer, or none, lies within `cells`, at most three, of a cell.
    bool edge_within(std::size_t row, std::size_t column, int cells) const
    {
        for (int down = -2 * cells; down <= 2 * cells; ++down)
            for (int right = -2 * cells; right <= 2 * cells; ++right)
                if (answer(row, column, down, right) != (dark(row, column) ? kDark : kLit))
                    return true;
        return false;
    }

    // The share of a cell that is dark: its middle, edges and corners, as the trapezoidal rule weighs them.
    double dark_share(std::size_t row, std::size_t column) const
    {
        double share = 0.0;
        for (int down = -1; down <= 1; ++down)
            for (int right = -1; right <= 1; ++right)
                if (answer(row, column, down, right) == kDark)
                    share += (down == 0 ? 0.5 : 0.25) * (right == 0 ? 0.5 : 0.25);
        return share;
    }

private:
    enum Answer : char { kLit, kDark, kUnsure };
    static constexpr std::size_t kMargin = 6;

    Answer answer(std::size_t row, std::size_t column, int down, int right) const
    {
        return answers_(2 * row + kMargin + static_cast<std::size_t>(down),
                        2 * column + kMargin + static_cast<std::size_t>(right));
    }

    Grid<Answer> answers_;
};

struct Tolerance {
    int cells = 1; // an inexact caster gets one more
    bool area_counts = true;
};

class ClosedForms : public testing::TestWithParam<Caster> {
protected:
    void expect_shadow(const HeightField& field, const DirectionalLight& light, const Formula& dark,
                       const Tolerance& tolerance) const
    {
        SCOPED_TRACE("azimuth " + std::to_string(light.azimuth.degrees()) + ", altitude "
                     + std::to_string(light.altitude.degrees()));
        const FormulaOnGrid expected(field, light, dark);
        const ShadowMask mask = GetParam().cast(field, light, {.threads = 1});
        const int slack = tolerance.cells + (GetParam().exact ? 0 : 1);
        double cells = 0.0;
        double expected_cells = 0.0;
        double cells_at_edge = 0.0;
        for (std::size_t row = 0; row < field.rows(); ++row)
            for (std::size_t column = 0; column < field.columns(); ++column) {
                cells += mask(row, column) == Lit::no;
                expected_cells += expected.dark_share(row, column);
                if (expected.edge_within(row, column, slack)) {
                    ++cells_at_edge;
                    continue;
                }
                ASSERT_EQ(mask(row, column), expected.dark(row, column) ? Lit::no : Lit::yes)
                    << "row " << row << ", column " << column;
            }
        // The cells at the edge are a band as wide as the slack to either side of it: this is a quarter of a
        // cell along the edge for each cell of slack.
        if (tolerance.area_counts) {
            EXPECT_NEAR(cells, expected_cells, 0.125 * cells_at_edge);
        }
    }

    void expect_shadow_from_everywhere(const HeightField& field, Angle altitude, const Formula& dark,
                                       const Tolerance& tolerance = {}) const
    {
        for (const double azimuth : kAzimuths) {
            expect_shadow(field, {.azimuth = Angle::from_degrees(azimuth), .altitude = altitude}, dark,
                          tolerance);
            if (HasFailure())
                return;
        }
    }
};

INSTANTIATE_TEST_SUITE_P(All, ClosedForms, testing::ValuesIn(kCasters), test_name);

constexpr SampleGrid kGrid{.rows = 151, .columns = 151};

TEST_P(ClosedForms, FlatGroundIsNeverInShadow)
{
    const Terrain flat = make_plane({.grid = {.rows = 41, .columns = 41}, .height_m = 123.4});
    for (const double altitude : {1e-6, 0.01, 1.0, 45.0, 89.0})
        expect_shadow_from_everywhere(flat, Angle::from_degrees(altitude), [](Place) { return false; });
}

TEST_P(ClosedForms, AStepShadesItsHeightOverTheTangent)
{
    // Table of shadow lengths behind 100 m: a line of cells away from the face.
    for (const auto& [altitude, length_m] : {std::pair{60.0, 57.7350},
                                             {30.0, 173.2051},
                                             {20.0, 274.7477},
                                             {15.0, 373.2051},
                                             {10.0, 567.1282},
                                             {5.0, 1143.0052},
                                             {2.0, 2863.6253}}) {
        const Terrain step = make_step({.grid = {.rows = 3, .columns = 3001},
                                        .height_m = 100.0,
                                        .facing = 270_deg,
                                        .offset_m = -1450.0});
        const ShadowMask mask =
            GetParam().cast(step, {.azimuth = 90_deg, .altitude = Angle::from_degrees(altitude)}, {});
        const auto dark = std::count(mask.row(1).begin(), mask.row(1).end(), Lit::no);
        const double in_grid = std::min(std::floor(length_m), 2950.0);
        EXPECT_NEAR(static_cast<double>(dark), in_grid, GetParam().exact ? 0.0 : 1.0) << altitude;
    }
}

TEST_P(ClosedForms, AWallShadesItsHeightOverTheTangentTimesTheCosineOfTheAngleToItsNormal)
{
    // The wall runs north-south through the middle, three cells thick, 30 m high; only what passes it
    // within the grid counts.
    const Terrain wall = make_wall({.grid = kGrid, .height_m = 30.0, .thickness_m = 3.0});
    for (const double azimuth : kAzimuths)
        for (const double altitude : {60.0, 30.0, 20.0}) {
            const DirectionalLight light{.azimuth = Angle::from_degrees(azimuth),
                                         .altitude = Angle::from_degrees(altitude)};
            const double east = std::sin(radians(azimuth));
            const double north = std::cos(radians(azimuth));
            const double climb = std::tan(radians(altitude));
            expect_shadow(
                wall, light,
                [&](Place place) -> std::optional<bool> {
                    const double x = -place.away * east + place.across * north;
                    const double y = -place.away * north - place.across * east;
                    if (std::abs(east) < 1e-6 || std::abs(x) <= 1.0)
                        return false;
                    // Between its beams an inexact caster smears the foot of a cliff.
                    if (!GetParam().exact && std::abs(x) < 2.5)
                        return std::nullopt;
                    // The ray ends at the far face's edge, a metre from the middle, or at the border;
                    // the ground rises to the edge over the last metre, from one sample to the next.
                    const double to_edge = (-std::copysign(1.0, east) - x) / east;
                    const double to_border =
                        north == 0.0 ? to_edge : (std::copysign(75.0, north) - y) / north;
                    const double to_end = std::min(to_edge, to_border);
                    const double surface = 30.0 * std::clamp(2.0 - std::abs(x + to_end * east), 0.0, 1.0);
                    return to_edge > 0.0 && to_end * climb < surface;
                },
                {.area_counts = false}); // straight edges come in whole cells
        }
}

TEST_P(ClosedForms, AConeCastsTheTriangleOfItsTipAndShadesItsOwnFarSide)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    for (const auto& [slope, altitude] : {std::pair{45.0, 30.0}, {45.0, 20.0}, {30.0, 20.0}, {20.0, 10.0}}) {
        const double side = std::tan(radians(slope));
        const double climb = std::tan(radians(altitude));
        const double radius = 30.0;
        const double height = radius * side;
        const double tip = height / climb;
        const double half_angle = std::asin(climb / side);
        const double own_sector = std::acos(climb / side);
        const Terrain cone =
            make_cone({.grid = kGrid, .height_m = height, .slope = Angle::from_degrees(slope)});
        expect_shadow_from_everywhere(cone, Angle::from_degrees(altitude), [&](Place place) {
            if (std::hypot(place.away, place.across) < radius)
                return std::abs(std::atan2(place.across, place.away)) < own_sector;
            return place.away > radius * radius / tip
                   && std::abs(place.across) < (tip - place.away) * std::tan(half_angle);
        });
    }
    // As steep as the sun is high, or less: no shadow at all.
    const Terrain low = make_cone({.grid = kGrid, .height_m = 20.0, .slope = 29_deg});
    expect_shadow_from_everywhere(low, 30_deg, [](Place) { return false; });
}

TEST_P(ClosedForms, ADomeCastsHalfAnEllipse)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    const double radius = 25.0;
    const Terrain dome = make_dome({.grid = kGrid, .radius_m = radius});
    for (const double altitude : {60.0, 45.0, 30.0, 20.0}) {
        const double sine = std::sin(radians(altitude));
        const double cosine = std::cos(radians(altitude));
        expect_shadow_from_everywhere(dome, Angle::from_degrees(altitude),
                                      [&](Place place) -> std::optional<bool> {
                                          const double squared = radius * radius - place.away * place.away
                                                                 - place.across * place.across;
                                          // The foot is a cliff, which lies somewhere between two samples.
                                          if (std::abs(std::hypot(place.away, place.across) - radius) < 1.0)
                                              return std::nullopt;
                                          if (squared > 0.0) // on the dome: what looks away from the light
                                              return std::sqrt(squared) * sine < place.away * cosine;
                                          return place.away > 0.0
                                                 && std::hypot(place.away * sine, place.across) < radius;
                                      },
                                      {.area_counts = false});
    }
}

TEST_P(ClosedForms, APitIsShadedByTheMirrorImageOfItsRim)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    const double radius = 70.0;
    for (const double depth : {70.0, 35.0})
        for (const double altitude : {60.0, 45.0, 30.0, 15.0}) {
            const double sine = std::sin(radians(altitude));
            const double cosine = std::cos(radians(altitude));
            const double centre = radius - depth;
            const double rim = std::sqrt(depth * (2.0 * radius - depth));
            const Terrain pit = make_pit({.grid = kGrid, .radius_m = radius, .depth_m = depth});
            const auto dark = [&](Place place) -> std::optional<bool> {
                // The rim lies somewhere between two samples.
                const double distance = std::hypot(place.away, place.across);
                if (std::abs(distance - rim) < 1.0)
                    return std::nullopt;
                if (distance > rim)
                    return false;
                // Where the ray leaves the sphere again; in the open if that is above the rim.
                const double below = -std::sqrt(radius * radius - distance * distance);
                const double path = -2.0 * (below * sine - place.away * cosine);
                return centre + below + path * sine < 0.0;
            };
            // The shadow's edge moves farther than the rim.
            expect_shadow_from_everywhere(pit, Angle::from_degrees(altitude), dark,
                                          {.cells = 2, .area_counts = false});
        }
}

TEST_P(ClosedForms, AHemisphericalPitIsDarkInACosineSquareOfItsPlan)
{
    const SampleGrid grid{.rows = 401, .columns = 401};
    const Terrain pit = make_pit({.grid = grid, .radius_m = 195.0, .depth_m = 195.0});
    const double plan = std::numbers::pi * 195.0 * 195.0;
    for (const auto& [altitude, share] :
         {std::pair{75.0, 0.066987}, {60.0, 0.25}, {45.0, 0.5}, {30.0, 0.75}, {15.0, 0.933013}}) {
        const ShadowMask mask =
            GetParam().cast(pit, {.azimuth = 203_deg, .altitude = Angle::from_degrees(altitude)}, {});
        const auto dark =
            static_cast<double>(std::count(mask.values().begin(), mask.values().end(), Lit::no));
        // A march by whole cells steps over the edge of the rim, half a cell of it on average.
        EXPECT_NEAR(dark / plan, share, steps_over_crests(GetParam()) ? 0.008 : 0.005) << altitude;
    }
}

// Where the shadow of a Gaussian ridge line of height `height` begins and ends, metres behind its crest;
// nothing when it is nowhere as steep as the light.
struct Span {
    double begin = 0.0;
    double end = 0.0;
};

Span gaussian_shadow(double height, double sigma, double climb)
{
    const double steepest = height / (sigma * std::sqrt(std::numbers::e));
    if (steepest <= climb)
        return {};
    const auto ground = [&](double x) { return height * std::exp(-x * x / (2.0 * sigma * sigma)); };
    const auto bisect = [](double low, double high, const auto& is_low) {
        for (int i = 0; i < 30; ++i)
            (is_low((low + high) / 2.0) ? low : high) = (low + high) / 2.0;
        return low;
    };
    Span span;
    span.begin = bisect(0.0, sigma, [&](double x) { return x / (sigma * sigma) * ground(x) < climb; });
    span.end = bisect(sigma, span.begin + height / climb + sigma,
                      [&](double x) { return ground(span.begin) - (x - span.begin) * climb > ground(x); });
    return span;
}

TEST_P(ClosedForms, AGaussianHillIsDarkFromWhereItGrowsSteepToWhereTheRayComesDown)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    // The published numbers first: they are what the test's own solution must give.
    const Span published = gaussian_shadow(300.0, 500.0, std::tan(radians(10.0)));
    ASSERT_NEAR(published.begin, 154.0848, 1e-3);
    ASSERT_NEAR(published.end, 1773.4128, 1e-3);
    ASSERT_NEAR(gaussian_shadow(1000.0, 1000.0, std::tan(radians(30.0))).end, 1468.7895, 1e-3);
    ASSERT_EQ(gaussian_shadow(300.0, 500.0, std::tan(radians(20.0))).end, 0.0);

    const Terrain hill =
        make_gaussian_hill({.grid = {.rows = 111, .columns = 111, .cell_size_m = {40.0, 40.0}},
                            .height_m = 300.0,
                            .sigma_m = 500.0});
    for (const double altitude : {10.0, 15.0, 20.0}) {
        if (altitude == 20.0 && answers_beside_centres(GetParam()))
            continue; // the hill is as steep as that to three digits: between samples it may well be steeper
        const double climb = std::tan(radians(altitude));
        expect_shadow_from_everywhere(hill, Angle::from_degrees(altitude), [&](Place place) {
            const double line = 300.0 * std::exp(-place.across * place.across / (2.0 * 500.0 * 500.0));
            const Span span = gaussian_shadow(line, 500.0, climb);
            return place.away > span.begin && place.away < span.end;
        });
    }
}

TEST_P(ClosedForms, APlaneThatFallsAwayFromTheLightIsDarkWhenSteeperThanItAndElseLit)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    for (const double azimuth : kAzimuths)
        for (const double slope : {29.9, 30.1}) {
            const Terrain plane = make_plane({.grid = {.rows = 41, .columns = 41, .cell_size_m = {2.0, 3.0}},
                                              .slope = Angle::from_degrees(slope),
                                              .aspect = Angle::from_degrees(azimuth + 180.0)});
            const ShadowMask mask =
                GetParam().cast(plane, {.azimuth = Angle::from_degrees(azimuth), .altitude = 30_deg}, {});
            // Nothing shades the cells on the border towards the light, which an inexact caster smears.
            const std::size_t border = GetParam().exact ? 1 : 4;
            for (std::size_t row = border; row < 41 - border; ++row)
                for (std::size_t column = border; column < 41 - border; ++column)
                    ASSERT_EQ(mask(row, column), slope > 30.0 ? Lit::no : Lit::yes)
                        << azimuth << ": " << row << ' ' << column;
        }
}

TEST_P(ClosedForms, ASlopeOf45DegreesSeenAlongItsDiagonalRisesBy35)
{
    if (takes_slopes_for_stairs(GetParam()))
        GTEST_SKIP() << "takes slopes for stairs";
    // atan(1 / sqrt 2) = 35.26439 degrees, and not the 39.76 of tools that measure diagonals in cells.
    const Terrain slope =
        make_plane({.grid = {.rows = 41, .columns = 41}, .slope = 45_deg, .aspect = 270_deg});
    for (const double azimuth : {45.0, 135.0}) {
        EXPECT_EQ(GetParam().cast(slope, {.azimuth = Angle::from_degrees(azimuth), .altitude = 35.26_deg},
                                  {})(20, 20),
                  Lit::no);
        EXPECT_EQ(GetParam().cast(slope, {.azimuth = Angle::from_degrees(azimuth), .altitude = 35.27_deg},
                                  {})(20, 20),
                  Lit::yes);
    }
}

TEST_P(ClosedForms, ShadowHeightsFallByTheTangentBehindAWall)
{
    const Terrain wall = make_wall({.grid = {.rows = 101, .columns = 101, .cell_size_m = {10.0, 10.0}},
                                    .height_m = 300.0,
                                    .thickness_m = 30.0});
    for (const double azimuth : {90.0, 75.0, 112.3, 90.0 - 1e-9}) {
        const double climb_m = 10.0 * std::tan(radians(25.0)) / std::sin(radians(azimuth));
        const ShadowField shadows = GetParam().shadow_heights(
            wall, {.azimuth = Angle::from_degrees(azimuth), .altitude = 25_deg}, {});
        for (std::size_t away = 1; away <= 40; ++away)
            EXPECT_NEAR(shadows(50, 49 - away), 300.0 - static_cast<double>(away) * climb_m,
                        GetParam().exact ? 1e-3 : climb_m)
                << azimuth << ", " << away;
    }
}

} // namespace
} // namespace duskline
