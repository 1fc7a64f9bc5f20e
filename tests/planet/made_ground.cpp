#include "planet/made_ground.h"

#include <cmath>
#include <utility>

namespace duskline {

MadeGround::MadeGround(const Globe& globe, HeightRange range, HeightIn height_in)
    : globe_(globe), range_(range), height_in_(std::move(height_in))
{}

const TileHeights& MadeGround::heights_of(const PlanetTile& tile) const
{
    return *shared_heights_of(tile);
}

std::shared_ptr<const TileHeights> MadeGround::shared_heights_of(const PlanetTile& tile) const
{
    std::shared_ptr<const TileHeights>& made = tiles_[tile];
    if (made == nullptr) {
        auto heights = std::make_shared<TileHeights>();
        for (std::int32_t row = -1; row <= kTileSquares + 1; ++row)
            for (std::int32_t column = -1; column <= kTileSquares + 1; ++column) {
                const auto height = static_cast<float>(height_in_(sample_direction(tile, row, column)));
                heights->heights_m(static_cast<std::size_t>(row) + 1, static_cast<std::size_t>(column) + 1) =
                    height;
                if (row >= 0 && row <= kTileSquares && column >= 0 && column <= kTileSquares)
                    heights->range.include(height);
            }
        made = std::move(heights);
    }
    return made;
}

PlanetLevel MadeGround::at_level(std::uint32_t level) const
{
    return {globe_, level, range_,
            [this](const PlanetTile& tile) -> const TileHeights& { return heights_of(tile); }};
}

double mountains_m(const Vector3& d)
{
    const auto ridges = [&](double frequency) {
        const double x = std::sin(frequency * d.x + 2.0 * std::sin(frequency * d.y));
        const double y = std::sin(frequency * 1.3 * d.y - 1.7 * std::cos(frequency * d.z));
        return 1.0 - std::abs(x + y + std::sin(frequency * 0.8 * d.z)) / 3.0;
    };
    return 9000.0 * (0.5 * ridges(9.0) + 0.2 * ridges(31.0) + 0.2 * ridges(89.0) + 0.1 * ridges(230.0))
           * ridges(5.0);
}

} // namespace duskline
