#pragma once

#include "day_suns.h"

#include <duskline/products/tiles.h>
#include <duskline/raster_io/read_height_field.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace duskline::cli {

/// A picture of all maps side by side.
struct MapAtlas {
    std::string file;
    TileLayout layout;
    std::size_t tile_rows = 0;
    std::size_t tile_columns = 0;
};

/// What a manifest says besides the job itself.
struct DayManifest {
    std::string encoding;               ///< what the numbers mean, in words
    std::vector<std::string> map_files; ///< one each, or one for all when they are its bands
    std::optional<MapAtlas> atlas;
    std::optional<std::string> sheet; ///< contact sheet
    std::optional<std::string> animation;
};

/// The manifest of a day: for every map its file, or band (from 1), time, sun, and the span over which it is blended with
/// its neighbours; see docs/day_maps.md.
nlohmann::ordered_json manifest_of(const DayManifest& manifest, const nlohmann::ordered_json& job,
                                   const DaySuns& day, const HeightFile& file);

} // namespace duskline::cli
