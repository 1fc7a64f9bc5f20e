#include "viewer_files.h"

#include "height_input.h"
#include "picture_options.h"

#include <duskline/products/ground_colours.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/read_colours.h>

#include <algorithm>
#include <cmath>

namespace duskline::viewer {
namespace {

// Heights, colours, masks and what is filled or on its way to the card.
constexpr double kBytesPerCell = 24.0;

void require_ground(const Terrain& terrain, const std::string& path)
{
    const auto heights_m = terrain.heights_m.values();
    if (std::ranges::all_of(heights_m, [](float height_m) { return std::isnan(height_m); }))
        throw InputError("'" + path + "' has no data in any cell: there is nothing to look at");
}

} // namespace

ViewedTerrain read_viewed_terrain(const ViewerOptions& options, cli::Report& report)
{
    const Execution execution{.threads = options.run.threads, .progress = {}};
    ViewedTerrain viewed{cli::open_heights(options.input, options.run, report), {}, {}};
    require_memory(viewed.file.rows(), viewed.file.columns(), kBytesPerCell, "'" + options.input.path + "'");
    viewed.terrain = read_terrain(viewed.file, execution);
    cli::report_reading(viewed.file, report);
    require_ground(viewed.terrain, options.input.path);
    const Tint tint = cli::choose_tint(options.picture, viewed.terrain, viewed.file, report);
    const Picture texture = options.picture.texture.empty()
                                ? Picture()
                                : read_colours(options.picture.texture, viewed.file, execution);
    viewed.ground = ground_picture(viewed.terrain, tint, texture.view(), execution);
    const EarthCurvature curvature = cli::choose_curvature(options.input, viewed.file, report);
    if (curvature.coefficient != 0.0)
        CurvedEarth(curvature, viewed.terrain.cell_size_m, viewed.terrain.heights_m.columns())
            .lower(viewed.terrain.heights_m.view());
    viewed.ambient = static_cast<float>(cli::choose_ambient(options.picture, viewed.file));
    viewed.air = cli::has_air(viewed.file);
    return viewed;
}

} // namespace duskline::viewer
