#include <duskline/terrain/height_field.h>

#include <cmath>

namespace duskline {

void require_valid(const HeightField& field)
{
    const auto [x, y] = field.cell_size_m;
    if (!(x > 0.0 && std::isfinite(x) && y > 0.0 && std::isfinite(y)))
        throw InvalidInput("cell size must be above 0 metres, got " + std::to_string(x) + " x "
                           + std::to_string(y));
}

} // namespace duskline
