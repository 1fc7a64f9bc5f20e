#include "raster_site.h"

namespace duskline::cli {

LightSite light_site(const GroundFrame& ground)
{
    LightSite site;
    site.place = ground.centre;
    site.map_to_grid_north = ground.from_map_north(Angle());
    site.true_to_grid_north = ground.from_true_north(Angle());
    if (ground.body && !ground.body->is_earth)
        site.body = ground.body->name;
    return site;
}

} // namespace duskline::cli
