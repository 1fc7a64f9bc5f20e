#include "planet_files.h"

#include <duskline/raster_io/read_planet_source.h>

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>

namespace duskline::planet_app {
namespace {

constexpr std::array kCarried = {"etopo20_world.tif", "hawaii_2048.tif"};

std::vector<std::string> carried_files()
{
    namespace fs = std::filesystem;
    const char* from_environment = std::getenv("DUSKLINE_DATA_DIR"); // NOLINT(concurrency-mt-unsafe)
    for (const fs::path& folder :
         {fs::path(from_environment != nullptr ? from_environment : "data"), fs::path(DUSKLINE_DATA_DIR)}) {
        std::vector<std::string> files;
        for (const char* name : kCarried)
            if (fs::exists(folder / name))
                files.push_back((folder / name).string());
        if (files.size() == kCarried.size())
            return files;
    }
    throw InputError(
        fmt::format("'{}' and '{}' are neither in the folder data nor in {}: name files of heights, or the "
                    "folder in DUSKLINE_DATA_DIR",
                    kCarried[0], kCarried[1], DUSKLINE_DATA_DIR));
}

} // namespace

ViewedPlanet read_viewed_planet(const PlanetOptions& options, cli::Report& report)
{
    const Execution execution{.threads = options.run.threads, .progress = {}};
    const bool bare = options.files.empty() && (options.moon || options.radius_km);
    const std::vector<std::string> files = !options.files.empty() ? options.files
                                           : bare                 ? std::vector<std::string>()
                                                                  : carried_files();
    std::vector<PlanetSource> sources;
    Globe globe = kWgs84;
    bool is_earth = !options.moon;
    for (const std::string& path : files) {
        PlanetSourceFile file = read_planet_source(path, execution);
        if (sources.empty())
            globe = file.globe;
        is_earth = is_earth && file.is_earth;
        report.note(fmt::format("heights of '{}'", path));
        sources.push_back(std::move(file.source));
    }
    const PlanetTerrainOptions terrain = {.sea = is_earth, .detail = options.detail};
    ViewedPlanet viewed;
    viewed.terrain =
        std::make_unique<PlanetTerrain>(globe_of(options, globe), std::move(sources), terrain, execution);
    viewed.air = is_earth;
    viewed.living = is_earth;
    return viewed;
}

} // namespace duskline::planet_app
