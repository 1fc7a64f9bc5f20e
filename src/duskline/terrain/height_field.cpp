#include <duskline/terrain/height_field.h>

#include <cmath>

namespace duskline {

HeightRange height_range(const HeightField& field)
{
    HeightRange range;
    for (std::size_t y = 0; y < field.rows(); ++y)
        for (const float height_m : field.heights_m.row(y))
            range.include(height_m);
    return range;
}

void require_valid(const HeightField& field)
{
    const auto [x, y] = field.cell_size_m;
    if (!(x > 0.0 && std::isfinite(x) && y > 0.0 && std::isfinite(y)))
        throw InvalidInput("cell size must be above 0 metres, got " + std::to_string(x) + " x "
                           + std::to_string(y));
}

} // namespace duskline
