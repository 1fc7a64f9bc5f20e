#include <duskline/geometry/invalid_input.h>
#include <duskline/planet/planet_level.h>

#include <string>

namespace duskline {

void require_valid(const PlanetLevel& ground)
{
    require_valid(ground.globe);
    if (ground.level > kDeepestTileLevel)
        throw InvalidInput("the level of a planet's ground must be 0 to " + std::to_string(kDeepestTileLevel)
                           + ", got " + std::to_string(ground.level));
    if (!(ground.range.lowest_m <= ground.range.highest_m))
        throw InvalidInput("the range of a planet's heights must not be empty");
}

} // namespace duskline
