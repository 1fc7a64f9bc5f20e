#include <duskline/casting/shadow_mask.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace duskline {

namespace {

// A grid of what `value(row, column)` says for every cell with data and `no_data` elsewhere.
template <typename T, typename Value>
Grid<T> where_data(const HeightField& field, T no_data, const Value& value)
{
    Grid<T> result(field.rows(), field.columns());
    for (std::size_t y = 0; y < field.rows(); ++y) {
        const auto heights = field.heights_m.row(y);
        const auto out = result.row(y);
        for (std::size_t x = 0; x < heights.size(); ++x)
            out[x] = std::isnan(heights[x]) ? no_data : value(y, x);
    }
    return result;
}

} // namespace

std::optional<Lit> uniform_answer(const DirectionalLight& light)
{
    if (light.altitude.degrees() <= 0.0)
        return Lit::no;
    if (light.altitude.degrees() >= 90.0)
        return Lit::yes;
    return std::nullopt;
}

ShadowMask uniform_mask(const HeightField& field, Lit answer)
{
    return where_data(field, Lit::unknown, [answer](std::size_t, std::size_t) { return answer; });
}

ShadowField uniform_shadow_heights(const HeightField& field, Lit answer)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float height_m = answer == Lit::no ? infinity : -infinity;
    return where_data(field, std::numeric_limits<float>::quiet_NaN(),
                      [height_m](std::size_t, std::size_t) { return height_m; });
}

float shadow_height_as_float(double height_m)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float most = std::numeric_limits<float>::max();
    if (std::isinf(height_m))
        return height_m > 0.0 ? infinity : -infinity;
    const auto nearest = static_cast<float>(std::clamp<double>(height_m, -most, most));
    return nearest < height_m ? std::nextafter(nearest, infinity) : nearest;
}

ShadowMask mask_of(const HeightField& field, const ShadowField& shadow_heights_m)
{
    assert(shadow_heights_m.rows() == field.rows() && shadow_heights_m.columns() == field.columns());
    return where_data(field, Lit::unknown, [&](std::size_t y, std::size_t x) {
        return field.heights_m(y, x) >= shadow_heights_m(y, x) ? Lit::yes : Lit::no;
    });
}

bool has_other_neighbour(const ShadowMask& mask, std::size_t row, std::size_t column)
{
    const Lit own = mask(row, column);
    const std::size_t last_row = std::min(row + 1, mask.rows() - 1);
    const std::size_t last_column = std::min(column + 1, mask.columns() - 1);
    for (std::size_t y = row - std::min<std::size_t>(row, 1); y <= last_row; ++y)
        for (std::size_t x = column - std::min<std::size_t>(column, 1); x <= last_column; ++x)
            if (mask(y, x) != own && mask(y, x) != Lit::unknown)
                return true;
    return false;
}

} // namespace duskline
