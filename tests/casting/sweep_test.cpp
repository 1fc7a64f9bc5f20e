#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/sweep.h>
#include <duskline/terrain/synthetic_terrain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace duskline {
namespace {

using namespace angle_literals;

// Mountains with holes in them, of a size that no vector length or strip divides.
Terrain holey_mountains(std::size_t rows, std::size_t columns, std::uint32_t seed)
{
    Terrain terrain = make_mountains({.grid = {rows, columns, {30.0, 25.0}}, .seed = seed});
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < rows * columns / 50; ++i)
        terrain.heights_m.values()[random() % terrain.heights_m.size()] =
            std::numeric_limits<float>::quiet_NaN();
    return terrain;
}

const std::vector<double> kAzimuths = {0,        45,   90,          135,         180,   225,
                                       270,      315,  11.3,        100.3,       157.7, 203.0,
                                       289.9999, 1e-9, 90.0 + 1e-9, 45.0 - 1e-9, 331.6};

template <typename Answer>
void expect_same(const Grid<Answer>& expected, const Grid<Answer>& actual)
{
    ASSERT_EQ(expected.rows(), actual.rows());
    ASSERT_EQ(expected.columns(), actual.columns());
    const auto same_bits = [](Answer a, Answer b) {
        if constexpr (std::is_same_v<Answer, float>)
            return a == b || (std::isnan(a) && std::isnan(b));
        else
            return a == b;
    };
    const auto [at, other] = std::ranges::mismatch(expected.values(), actual.values(), same_bits);
    const auto cell = static_cast<std::size_t>(at - expected.values().begin());
    EXPECT_EQ(at, expected.values().end())
        << "row " << cell / expected.columns() << ", column " << cell % expected.columns();
}

// A sweep that is told its SIMD level, its threads and how many lines it gets at a time.
template <typename Answer>
Grid<Answer> sweep_in_blocks(const Terrain& terrain, const DirectionalLight& light, std::string_view isa,
                             std::size_t threads, std::size_t lines_at_a_time)
{
    const LightFrame frame = light_frame(light, terrain.cell_size_m);
    const auto heights = in_light_order(terrain.heights_m.view(), frame);
    Grid<Answer> answers(terrain.heights_m.rows(), terrain.heights_m.columns());
    const auto out = in_light_order(answers.view(), frame);
    SweepFront front(heights.lines, heights.cells, frame, isa);
    for (std::size_t v = 0; v < heights.lines; v += lines_at_a_time) {
        const std::size_t lines = std::min(lines_at_a_time, heights.lines - v);
        front.advance(heights.part(v, lines), out.part(v, lines), {.threads = threads});
    }
    return answers;
}

TEST(Sweep, GivesTheSameBytesOnEverySimdLevel)
{
    const Terrain terrain = holey_mountains(301, 277, 1);
    for (const double azimuth : kAzimuths) {
        const DirectionalLight light{Angle::from_degrees(azimuth), 9_deg};
        const auto mask = sweep_in_blocks<Lit>(terrain, light, "scalar", 1, 10'000);
        const auto heights = sweep_in_blocks<float>(terrain, light, "scalar", 1, 10'000);
        for (const kernels::Kernels& level : kernels::runnable_kernels()) {
            SCOPED_TRACE(std::string(level.isa) + ", azimuth " + std::to_string(azimuth));
            expect_same(mask, sweep_in_blocks<Lit>(terrain, light, level.isa, 1, 10'000));
            expect_same(heights, sweep_in_blocks<float>(terrain, light, level.isa, 1, 10'000));
        }
    }
}

TEST(Sweep, GivesTheSameBytesForAnyThreadsAndAnyBlocks)
{
    // Wider than a strip both ways.
    const Terrain terrain = holey_mountains(1403, 1317, 2);
    const std::string_view isa = kernels::runnable_kernels().front().isa;
    for (const double azimuth : {0.0, 45.0, 203.0, 100.3, 280.0, 315.0, 331.6}) {
        SCOPED_TRACE("azimuth " + std::to_string(azimuth));
        const DirectionalLight light{Angle::from_degrees(azimuth), 7_deg};
        const auto mask = sweep_in_blocks<Lit>(terrain, light, isa, 1, 10'000);
        expect_same(mask, sweep_in_blocks<Lit>(terrain, light, isa, 7, 10'000));
        expect_same(mask, sweep_in_blocks<Lit>(terrain, light, isa, 2, 100));
        expect_same(mask, sweep_in_blocks<Lit>(terrain, light, isa, 1, 37));
        expect_same(mask, cast_by_sweep(terrain, light));
        const auto heights = sweep_in_blocks<float>(terrain, light, isa, 1, 10'000);
        expect_same(heights, sweep_in_blocks<float>(terrain, light, isa, 3, 257));
    }
}

TEST(Sweep, ShadowHeightsMeanTheMask)
{
    const Terrain terrain = holey_mountains(200, 211, 3);
    for (const double azimuth : kAzimuths) {
        const DirectionalLight light{Angle::from_degrees(azimuth), 12_deg};
        const ShadowMask mask = cast_by_sweep(terrain, light);
        const ShadowField shadows = shadow_heights_by_sweep(terrain, light);
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const float ground = terrain.heights_m.values()[i];
            const float shadow = shadows.values()[i];
            if (mask.values()[i] == Lit::unknown) {
                EXPECT_TRUE(std::isnan(ground) && std::isnan(shadow));
            } else if (std::abs(ground - shadow) > 0.01f) { // nearer, rounding decides
                EXPECT_EQ(mask.values()[i] == Lit::yes, ground >= shadow) << ground << " " << shadow;
            }
        }
    }
}

TEST(Sweep, ReadsAWindowOfALargerGridInPlace)
{
    const Terrain terrain = holey_mountains(150, 170, 4);
    Terrain cut{Grid<float>(90, 101), terrain.cell_size_m};
    const HeightField window = HeightField(terrain).window(20, 31, 90, 101);
    for (std::size_t y = 0; y < 90; ++y)
        std::ranges::copy(window.heights_m.row(y), cut.heights_m.row(y).begin());
    for (const double azimuth : {10.0, 100.0, 190.0, 280.0}) {
        const DirectionalLight light{Angle::from_degrees(azimuth), 10_deg};
        expect_same(cast_by_sweep(cut, light), cast_by_sweep(window, light));
    }
}

// There a beam is over no ground for many lines, and would miss the walls that it passes meanwhile.
TEST(Sweep, ShadesTheOutermostLineOfCellsInLightNearlyAlongIt)
{
    Terrain walls{Grid<float>(101, 401, 0.0f), {10.0, 10.0}};
    for (std::size_t row = 0; row < 101; ++row)
        for (std::size_t column = 0; column < 401; column += 25)
            walls.heights_m(row, column) = 20.0f; // with a shadow of 11 cells
    for (const double azimuth : {89.5, 90.2, 90.5, 91.0, 95.0, 269.5, 270.2, 270.5, 271.0}) {
        const ShadowMask mask =
            cast_by_sweep(walls, {.azimuth = Angle::from_degrees(azimuth), .altitude = 10_deg});
        const auto in_shadow = [&](std::size_t row) { return std::ranges::count(mask.row(row), Lit::no); };
        const bool light_from_the_south = azimuth > 90.0 && azimuth < 270.0;
        EXPECT_EQ(in_shadow(light_from_the_south ? 0 : 100), in_shadow(50)) << "azimuth " << azimuth;
    }
}

TEST(Sweep, RefusesASimdLevelThereIsNot)
{
    EXPECT_THROW(SweepFront(10, 10, LightFrame{}, "avx1024"), InvalidInput);
}

TEST(Kernels, TransposeAnyRectangle)
{
    std::mt19937 random(5);
    for (const kernels::Kernels& level : kernels::runnable_kernels())
        for (int i = 0; i < 60; ++i) {
            const std::size_t rows = random() % 70;
            const std::size_t columns = random() % 70;
            Grid<float> floats(rows, columns + 3);
            Grid<std::uint8_t> bytes(rows, columns + 3);
            for (float& value : floats.values())
                value = static_cast<float>(random() % 10'000);
            for (std::uint8_t& value : bytes.values())
                value = static_cast<std::uint8_t>(random());
            const auto from_stride = static_cast<std::ptrdiff_t>(columns + 3);
            const auto to_stride = static_cast<std::ptrdiff_t>(rows + 5);
            for (const kernels::RowsFirst rows_first :
                 {kernels::RowsFirst::read, kernels::RowsFirst::written}) {
                Grid<float> turned_floats(columns, rows + 5, -1.0f);
                Grid<std::uint8_t> turned_bytes(columns, rows + 5, 7);
                level.transpose_floats(floats.data(), from_stride, rows, columns, turned_floats.data(),
                                       to_stride, rows_first);
                level.transpose_bytes(bytes.data(), from_stride, rows, columns, turned_bytes.data(),
                                      to_stride, rows_first);
                for (std::size_t x = 0; x < columns; ++x) {
                    for (std::size_t y = 0; y < rows; ++y) {
                        ASSERT_EQ(turned_floats(x, y), floats(y, x));
                        ASSERT_EQ(turned_bytes(x, y), bytes(y, x));
                    }
                    for (std::size_t y = rows; y < rows + 5; ++y) { // the rest is left alone
                        ASSERT_EQ(turned_floats(x, y), -1.0f);
                        ASSERT_EQ(turned_bytes(x, y), 7);
                    }
                }
            }
        }
}

TEST(Kernels, BeamsShiftByAtMostOneCellALine)
{
    for (const double lateral : {0.0, 1e-9, 0.3, 0.5, 0.999999, 0.9999999, 1.0, -0.7}) {
        kernels::BeamShift before;
        for (std::size_t v = 0; v < 5000; ++v) {
            const kernels::BeamShift shift = kernels::beam_shift(lateral, v);
            EXPECT_GE(shift.fraction, 0.0f);
            EXPECT_LT(shift.fraction, 1.0f);
            EXPECT_NEAR(static_cast<double>(shift.whole) + shift.fraction,
                        std::abs(lateral) * static_cast<double>(v), 2e-6);
            EXPECT_GE(shift.whole, before.whole);
            EXPECT_LE(shift.whole, before.whole + 1);
            before = shift;
        }
    }
}

} // namespace
} // namespace duskline
