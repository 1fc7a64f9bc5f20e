#include "planet/made_ground.h"

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

} // namespace duskline
