#pragma once

#include "cli11_names.h"
#include "light_pixels.h"
#include "report.h"

#include <duskline/products/light_map.h>
#include <duskline/raster_io/read_height_field.h>

#include <cstddef>
#include <optional>
#include <string>

namespace duskline::cli {

/// Rows and columns of a map.
struct MapSize {
    std::size_t rows = 0;
    std::size_t columns = 0;

    bool operator==(const MapSize&) const = default;
};

/// What a light map is to be: --model, --ambient, --ambient-colour, --normals, --texture, --size, --ot, and how its
/// shadows are cast: --soft, --antialias, --no-shadows.
struct LightMapCommandOptions {
    const NamedLightModel* model = &kLightModels.front();
    std::optional<double> ambient = {}; ///< else as suits the model
    Colour ambient_colour = {1, 1, 1};
    bool packed_normals = false;
    std::string texture = {};         ///< a raster of colours; empty: none
    std::optional<MapSize> size = {}; ///< columns 0: rows is the longer side; else that of the raster
    SampleDepth depth = SampleDepth::byte;
    bool soft = false;
    bool antialias = false;
    bool no_shadows = false;

    LightMapOptions light() const;
};

/// For help: the models and what they are, and the ambient light that suits each.
std::string names_of_models();
std::string usual_ambients();

/// `options` must outlive `app`'s parsing.
void add_light_map_options(CLI::App& app, LightMapCommandOptions& options);

/// Rows and columns of the map over a raster of `whole`. Throws UsageError when it would be coarser.
MapSize choose_map_size(const LightMapCommandOptions& options, const MapSize& whole);

} // namespace duskline::cli
