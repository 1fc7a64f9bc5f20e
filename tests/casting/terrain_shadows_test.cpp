#include "mask_assertions.h"
#include "terrains.h"

#include <duskline/casting/exact.h>
#include <duskline/casting/terrain_shadows.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

namespace duskline {

static void PrintTo(const CellRectangle& rectangle, std::ostream* out)
{
    *out << rectangle.rows << " x " << rectangle.columns << " from " << rectangle.first_row << ", "
         << rectangle.first_column;
}

namespace {

constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();

DirectionalLight sun_at(double azimuth, double altitude)
{
    return {.azimuth = Angle::from_degrees(azimuth), .altitude = Angle::from_degrees(altitude)};
}

testing::AssertionResult same_as_from_scratch(const TerrainShadows& shadows, const HeightField& field,
                                              const DirectionalLight& sun)
{
    return same_mask(shadows.mask(), cast_by_exact(field, sun, {.threads = 1}))
           << ", azimuth " << sun.azimuth.degrees() << ", altitude " << sun.altitude.degrees();
}

// Some rows or columns: few, up to a border, or all.
void choose_span(Dice& dice, std::size_t there, std::size_t& first, std::size_t& count)
{
    first = dice.chance(0.2) ? 0 : dice.below(there);
    count = 1 + dice.below(std::min<std::size_t>(there - first, dice.chance(0.7) ? 8 : there));
    if (dice.chance(0.1))
        count = there - first;
}

// Raises, lowers, levels, digs holes into, or fills the holes of, any rectangle.
CellRectangle edit(Dice& dice, Terrain& terrain)
{
    Grid<float>& heights_m = terrain.heights_m;
    CellRectangle place;
    choose_span(dice, heights_m.rows(), place.first_row, place.rows);
    choose_span(dice, heights_m.columns(), place.first_column, place.columns);
    if (dice.chance(0.02))
        place = {0, 0, heights_m.rows(), heights_m.columns()};
    const std::size_t what = dice.below(5);
    const auto by_m = static_cast<float>(dice.between(1.0, dice.chance(0.2) ? 3000.0 : 300.0));
    const float first_m = heights_m(place.first_row, place.first_column);
    const float level_m = std::isnan(first_m) ? by_m : first_m;
    for (std::size_t row = place.first_row; row < place.first_row + place.rows; ++row)
        for (std::size_t column = place.first_column; column < place.first_column + place.columns; ++column) {
            float& height_m = heights_m(row, column);
            switch (what) {
            case 0:
                height_m += by_m;
                break;
            case 1:
                height_m -= by_m;
                break;
            case 2:
                height_m = level_m;
                break;
            case 3:
                height_m = kNoData;
                break;
            default:
                height_m = std::isnan(height_m) ? level_m : height_m + by_m * 0.1f;
                break;
            }
        }
    return place;
}

TEST(TerrainShadows, AreTheExactMaskOfEverySun)
{
    for_seeds(60, [](Dice& dice) {
        const Terrain terrain = random_terrain(dice);
        TerrainShadows shadows(terrain);
        for (int i = 0; i < 8; ++i) {
            const DirectionalLight sun = random_light(dice);
            shadows.cast(sun, {.threads = 1 + dice.below(3)});
            EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun));
        }
        for (const double altitude : {-10.0, 0.0, 90.0}) {
            const DirectionalLight sun = sun_at(dice.between(0.0, 360.0), altitude);
            shadows.cast(sun);
            EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun));
        }
    });
}

TEST(TerrainShadows, AreTheSameAfterAnyEdits)
{
    for_seeds(250, [](Dice& dice) {
        Terrain terrain = random_terrain(dice);
        TerrainShadows shadows(terrain);
        DirectionalLight sun = random_light(dice);
        shadows.cast(sun);
        for (int i = 0; i < 12; ++i) {
            if (dice.chance(0.15)) {
                sun = dice.chance(0.1) ? sun_at(100.0, dice.chance(0.5) ? 90.0 : -1.0) : random_light(dice);
                shadows.cast(sun);
            }
            const CellRectangle place = edit(dice, terrain);
            shadows.heights_changed(place, {.threads = 1 + dice.below(3)});
            ASSERT_TRUE(same_as_from_scratch(shadows, terrain, sun))
                << "edit " << i << " of " << testing::PrintToString(place);
        }
    });
}

TEST(TerrainShadows, AreTheSameWhereTheFrontStartsAndEndsInTheMiddle)
{
    // Shadows of some dozen cells on a wide terrain: most of it is not cast again.
    for_seeds(12, [](Dice& dice) {
        Terrain terrain = make_mountains({.grid = {420, 390, {30.0, 22.0}},
                                          .seed = dice.below(1000),
                                          .height_m = 500.0,
                                          .feature_m = 2000.0});
        TerrainShadows shadows(terrain);
        for (int i = 0; i < 8; ++i) {
            const DirectionalLight sun =
                sun_at(random_light(dice).azimuth.degrees(), dice.between(12.0, 70.0));
            shadows.cast(sun);
            const CellRectangle place = edit(dice, terrain);
            shadows.heights_changed(place, {.threads = 1 + dice.below(3)});
            ASSERT_TRUE(same_as_from_scratch(shadows, terrain, sun))
                << "edit of " << testing::PrintToString(place);
        }
    });
}

TEST(TerrainShadows, CastOnlyWhatAnEditCanChange)
{
    Terrain terrain =
        make_mountains({.grid = {600, 800, {30.0, 30.0}}, .height_m = 300.0, .feature_m = 2000.0});
    TerrainShadows shadows(terrain);
    EXPECT_EQ(shadows.heights_changed({100, 100, 10, 10}), 0U) << "there is no sun yet";
    for (const double azimuth : {0.0, 45.0, 203.0, 281.0}) {
        const DirectionalLight sun = sun_at(azimuth, 30.0);
        shadows.cast(sun);
        for (std::size_t row = 300; row < 320; ++row)
            for (std::size_t column = 400; column < 420; ++column)
                terrain.heights_m(row, column) += 40.0f;
        // 340 m throw 20 cells of shadow at 30 degrees: some 80 lines of 50 beams.
        const std::size_t cells = shadows.heights_changed({300, 400, 20, 20});
        EXPECT_GE(cells, 400U);
        EXPECT_LE(cells, 5000U) << "azimuth " << azimuth;
        EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun));
    }
    EXPECT_EQ(shadows.heights_changed({5, 5, 0, 7}), 0U);
    shadows.cast(sun_at(0.0, -3.0));
    EXPECT_EQ(shadows.heights_changed({300, 400, 20, 20}), 400U) << "at night only the edit itself";
}

TEST(TerrainShadows, TakeAwayTheShadowOfGroundThatIsGone)
{
    // The tower's shadow is far longer than any the ground that is left could cast.
    for (const double azimuth : {0.0, 100.0, 225.0, 330.0}) {
        Terrain terrain{Grid<float>(200, 200, 10.0f), {30.0, 30.0}};
        const DirectionalLight sun = sun_at(azimuth, 15.0);
        terrain.heights_m(100, 90) = 600.0f;
        TerrainShadows shadows(terrain);
        shadows.cast(sun);
        for (const float height_m : {10.0f, 700.0f, kNoData, 500.0f, 0.0f}) {
            terrain.heights_m(100, 90) = height_m;
            shadows.heights_changed({100, 90, 1, 1});
            EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun)) << "height " << height_m;
        }
    }
}

TEST(TerrainShadows, SeeAWindowOfALargerTerrain)
{
    Dice dice(5);
    Terrain whole = random_terrain(dice, {.smallest = 40});
    const HeightField field = HeightField(whole).window(3, 5, 30, 33);
    TerrainShadows shadows(field);
    const DirectionalLight sun = sun_at(75.0, 20.0);
    shadows.cast(sun);
    whole.heights_m(3 + 12, 5 + 20) = 900.0f;
    shadows.heights_changed({12, 20, 1, 1});
    EXPECT_TRUE(same_as_from_scratch(shadows, field, sun));
}

TEST(TerrainShadows, TakeEmptyAndUnknownTerrain)
{
    const Terrain empty{Grid<float>(0, 0), {}};
    TerrainShadows none(empty);
    EXPECT_TRUE(none.cast(sun_at(10.0, 10.0)).empty());
    EXPECT_EQ(none.heights_changed({}), 0U);

    Terrain unknown{Grid<float>(7, 9, kNoData), {}};
    TerrainShadows shadows(unknown);
    const DirectionalLight sun = sun_at(160.0, 12.0);
    shadows.cast(sun);
    EXPECT_TRUE(same_as_from_scratch(shadows, unknown, sun));
    for (std::size_t i = 0; i < 7; ++i) {
        unknown.heights_m(i, i) = static_cast<float>(i);
        shadows.heights_changed({i, i, 1, 1});
        EXPECT_TRUE(same_as_from_scratch(shadows, unknown, sun));
    }
}

TEST(TerrainShadows, RefuseWhatLiesOutsideAndSurviveACancel)
{
    Terrain terrain = make_mountains({.grid = {80, 90, {30.0, 30.0}}});
    EXPECT_THROW(TerrainShadows(HeightField{terrain.heights_m.view(), {0.0, 30.0}}), InvalidInput);
    TerrainShadows shadows(terrain);
    const DirectionalLight sun = sun_at(40.0, 8.0);
    shadows.cast(sun);
    EXPECT_THROW(shadows.cast(sun_at(40.0, 91.0)), InvalidInput);
    EXPECT_THROW(shadows.heights_changed({79, 0, 2, 1}), InvalidInput);
    EXPECT_THROW(shadows.heights_changed({0, 91, 1, 0}), InvalidInput);
    EXPECT_THROW(shadows.heights_changed({1, 1, std::numeric_limits<std::size_t>::max(), 1}), InvalidInput);
    EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun));

    terrain.heights_m(20, 30) += 500.0f;
    EXPECT_THROW(shadows.heights_changed({20, 30, 1, 1}, {.progress = [](double) { return false; }}),
                 Cancelled);
    EXPECT_EQ(shadows.heights_changed({20, 30, 1, 1}), 0U) << "no current sun";
    shadows.cast(sun);
    EXPECT_TRUE(same_as_from_scratch(shadows, terrain, sun));
}

} // namespace
} // namespace duskline
