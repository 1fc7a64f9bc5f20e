#include "viewer_files.h"

#include "height_input.h"
#include "picture_options.h"

#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/read_colours.h>

#include <algorithm>
#include <cmath>

namespace duskline::viewer {
namespace {

// Heights at rest, moved and seen, colours, masks and what is filled or on its way to the card.
constexpr double kBytesPerCell = 32.0;

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
    ViewedTerrain viewed{cli::open_heights(options.input, options.run, report), {}};
    require_memory(viewed.file.rows(), viewed.file.columns(), kBytesPerCell, "'" + options.input.path + "'");
    Terrain terrain = read_terrain(viewed.file, execution);
    cli::report_reading(viewed.file, report);
    require_ground(terrain, options.input.path);
    Tint tint = cli::choose_tint(options.picture, terrain, viewed.file, report);
    Picture texture = options.picture.texture.empty()
                          ? Picture()
                          : read_colours(options.picture.texture, viewed.file, execution);
    const EarthCurvature curvature = cli::choose_curvature(options.input, viewed.file, report);
    std::optional<CurvedEarth> globe;
    if (curvature.coefficient != 0.0)
        globe.emplace(curvature, terrain.cell_size_m, terrain.heights_m.columns());
    viewed.ground = std::make_unique<ChangingGround>(std::move(terrain), std::move(tint), std::move(texture),
                                                     std::move(globe), execution);
    viewed.ambient = static_cast<float>(cli::choose_ambient(options.picture, viewed.file));
    viewed.air = cli::has_air(viewed.file);
    return viewed;
}

} // namespace duskline::viewer
