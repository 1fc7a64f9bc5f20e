#pragma once

#include <duskline/terrain/height_field.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace duskline {

/// The surface between samples as the definition has it, as plainly as it can be said and in long double: linear
/// along rows and columns, none where a sample is missing. What `ray` is tested against.
class PlainSurface {
public:
    explicit PlainSurface(const HeightField& field) : field_(field) {}

    /// On the row (or column) `line`, a whole number up to rounding, at a fraction of a cell along it. Without
    /// data minus infinity.
    long double height_m(long double line, long double at, bool is_column) const
    {
        constexpr long double slack = 1e-6L;
        const long double left = std::floor(at);
        const long double t = at - left;
        const long double a = sample(std::round(line), left, is_column);
        const long double b = sample(std::round(line), left + 1.0L, is_column);
        if (!std::isnan(a) && !std::isnan(b))
            return a + (b - a) * t;
        if (!std::isnan(a) && t <= slack)
            return a;
        if (!std::isnan(b) && t >= 1.0L - slack)
            return b;
        return -std::numeric_limits<long double>::infinity();
    }

private:
    long double sample(long double line, long double at, bool is_column) const
    {
        const long double row = is_column ? at : line;
        const long double column = is_column ? line : at;
        if (row < 0.0L || column < 0.0L || row >= static_cast<long double>(field_.rows())
            || column >= static_cast<long double>(field_.columns()))
            return std::numeric_limits<long double>::quiet_NaN();
        return field_.heights_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }

    HeightField field_;
};

} // namespace duskline
