#include "mask_assertions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>

namespace duskline {

std::ostream& operator<<(std::ostream& out, Lit lit)
{
    return out << (lit == Lit::yes ? "lit" : lit == Lit::no ? "shadow" : "unknown");
}

void PrintTo(const Caster& caster, std::ostream* out)
{
    *out << caster.name;
}

std::string test_name(const testing::TestParamInfo<Caster>& info)
{
    std::string name(info.param.name);
    std::ranges::replace(name, '-', '_');
    return name;
}

bool is_truth(const Caster& caster)
{
    return caster.name == "ray" || caster.name == "fast-ray";
}

bool takes_slopes_for_stairs(const Caster& caster)
{
    return caster.name == "line-march";
}

bool steps_over_crests(const Caster& caster)
{
    return caster.name.starts_with("line-march");
}

bool answers_beside_centres(const Caster& caster)
{
    return caster.name == "strider";
}

namespace {

// Whether a cell of another answer lies within `distance` of this one.
bool near_edge(const ShadowMask& mask, std::size_t row, std::size_t column, std::size_t distance)
{
    const std::size_t last_row = std::min(row + distance, mask.rows() - 1);
    const std::size_t last_column = std::min(column + distance, mask.columns() - 1);
    for (std::size_t y = row - std::min(row, distance); y <= last_row; ++y)
        for (std::size_t x = column - std::min(column, distance); x <= last_column; ++x)
            if (mask(y, x) != mask(row, column) && mask(y, x) != Lit::unknown)
                return true;
    return false;
}

Grid<char> ties(const HeightField& field, const DirectionalLight& light)
{
    const ShadowField shadows = shadow_heights_by_fast_ray(field, light);
    const double rounding_m = float_rounding_m(field);
    Grid<char> result(field.rows(), field.columns());
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column)
            result(row, column) = std::abs(field.heights_m(row, column) - shadows(row, column)) <= rounding_m;
    return result;
}

// Whether the shadow's height over a cell differs from that over a neighbour by more than the cell's own ground
// is away from it: the edge of a shadow narrower than a cell passes by, and need not show in any centre.
bool edge_passes_by(const HeightField& field, const ShadowField& shadows, std::size_t row, std::size_t column)
{
    const float shadow_m = shadows(row, column);
    const float clearance_m = std::abs(field.heights_m(row, column) - shadow_m);
    const std::size_t last_row = std::min(row + 1, field.rows() - 1);
    const std::size_t last_column = std::min(column + 1, field.columns() - 1);
    for (std::size_t y = row - std::min<std::size_t>(row, 1); y <= last_row; ++y)
        for (std::size_t x = column - std::min<std::size_t>(column, 1); x <= last_column; ++x)
            if (std::isfinite(shadows(y, x)) && std::abs(shadows(y, x) - shadow_m) >= clearance_m)
                return true;
    return false;
}

Grid<char> edges(const HeightField& field, const ShadowField& shadows)
{
    const ShadowMask mask = mask_of(field, shadows);
    Grid<char> result(mask.rows(), mask.columns());
    for (std::size_t row = 0; row < mask.rows(); ++row)
        for (std::size_t column = 0; column < mask.columns(); ++column)
            result(row, column) =
                near_edge(mask, row, column, 1) || edge_passes_by(field, shadows, row, column);
    return result;
}

// Counts the cells for which `wrong(row, column)` and describes the first few.
template <typename Wrong>
testing::AssertionResult none_wrong(const ShadowMask& actual, const ShadowMask& expected, const Wrong& wrong)
{
    if (actual.rows() != expected.rows() || actual.columns() != expected.columns())
        return testing::AssertionFailure() << "the masks have different sizes";
    std::size_t count = 0;
    testing::AssertionResult failure = testing::AssertionFailure();
    for (std::size_t row = 0; row < actual.rows(); ++row)
        for (std::size_t column = 0; column < actual.columns(); ++column)
            if (wrong(row, column) && ++count <= 5)
                failure << "cell (" << row << ", " << column << ") is " << actual(row, column) << ", not "
                        << expected(row, column) << '\n';
    if (count == 0)
        return testing::AssertionSuccess();
    return failure << count << " of " << actual.rows() << " x " << actual.columns() << " cells are wrong";
}

} // namespace

double float_rounding_m(const HeightField& field)
{
    const HeightRange range = height_range(field);
    return 7e-6 * std::max(std::abs(range.lowest_m), std::abs(range.highest_m));
}

Grid<char> ties(const HeightField& field, const ShadowField& shadow_m)
{
    Grid<char> tied(field.rows(), field.columns(), 0);
    for (std::size_t row = 0; row < field.rows(); ++row)
        for (std::size_t column = 0; column < field.columns(); ++column)
            tied(row, column) =
                std::abs(field.heights_m(row, column) - shadow_m(row, column)) < float_rounding_m(field);
    return tied;
}

Grid<char> excuses(const Caster& caster, const HeightField& field, const DirectionalLight& light)
{
    if (is_truth(caster) || field.heights_m.empty())
        return {field.rows(), field.columns(), 0};
    return caster.exact ? ties(field, light) : edges(field, shadow_heights_by_fast_ray(field, light));
}

Grid<char> excuses(const Caster& caster, const HeightField& field, const PointLight& lamp)
{
    if (caster.exact || field.heights_m.empty())
        return {field.rows(), field.columns(), 0};
    return edges(field, shadow_heights_by_fast_ray(field, lamp));
}

testing::AssertionResult same_mask(const ShadowMask& actual, const ShadowMask& expected)
{
    return same_mask(actual, expected, Grid<char>(expected.rows(), expected.columns(), 0));
}

testing::AssertionResult same_mask(const ShadowMask& actual, const ShadowMask& expected,
                                   const Grid<char>& excused)
{
    return none_wrong(actual, expected, [&](std::size_t row, std::size_t column) {
        return actual(row, column) != expected(row, column) && !excused(row, column);
    });
}

testing::AssertionResult no_new_shadow(const ShadowMask& before, const ShadowMask& after,
                                       const Grid<char>& excused)
{
    return none_wrong(after, before, [&](std::size_t row, std::size_t column) {
        return before(row, column) == Lit::yes && after(row, column) == Lit::no && !excused(row, column);
    });
}

testing::AssertionResult same_bits(const Grid<float>& actual, const Grid<float>& expected)
{
    if (actual.rows() != expected.rows() || actual.columns() != expected.columns())
        return testing::AssertionFailure() << "the grids have different sizes";
    for (std::size_t row = 0; row < actual.rows(); ++row)
        for (std::size_t column = 0; column < actual.columns(); ++column) {
            const float a = actual(row, column);
            const float b = expected(row, column);
            if (std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b)
                && !(std::isnan(a) && std::isnan(b)))
                return testing::AssertionFailure() << "cell (" << row << ", " << column << ") is " << a
                                                   << ", not " << b << ", " << a - b << " apart";
        }
    return testing::AssertionSuccess();
}

} // namespace duskline
