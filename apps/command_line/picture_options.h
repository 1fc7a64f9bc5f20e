#pragma once

#include "cli11_names.h"
#include "report.h"

#include <duskline/products/tint.h>
#include <duskline/raster_io/read_height_field.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace duskline::cli {

/// What a relief is to look like: --palette, --texture, --sea, --exaggeration, --ambient, --size.
struct PictureOptions {
    std::string palette;                ///< a name or a file; empty: by the body the terrain lies on
    std::string texture;                ///< a raster of colours; empty: none
    bool no_sea = false;                ///< --sea none
    std::optional<double> sea_level_m;  ///< --sea METRES; neither: found from the heights
    std::optional<double> exaggeration; ///< else by the terrain and the light
    std::optional<double> ambient;      ///< else by the body
    std::optional<std::size_t> size;    ///< pixels of the longer side; else those of the raster
};

/// `options` must outlive `app`'s parsing.
void add_picture_options(CLI::App& app, PictureOptions& options);
/// The same without --exaggeration and --size.
void add_look_options(CLI::App& app, PictureOptions& options);

/// Throws UsageError, before any work, for a palette that is neither a name nor a file that can be read as one.
void require_palette(const PictureOptions& options);

/// The tint for a terrain that was read from `file`. Says in the report what was chosen. Throws as
/// `require_palette`.
Tint choose_tint(const PictureOptions& options, const HeightField& field, const HeightFile& file,
                 Report& report);

/// Whether there is air over the body the file lies on; bodies it does not name are taken to be the Earth.
bool has_air(const HeightFile& file);

/// The share of light in shadow: as asked, else much under a sky and little without air.
double choose_ambient(const PictureOptions& options, const HeightFile& file);

struct PictureSize {
    std::size_t rows = 0;
    std::size_t columns = 0;
};

/// Rows and columns of a picture of the raster whose longer side has so many pixels. Throws UsageError when an option
/// asks for more than the raster has.
PictureSize size_with_longer_side(std::string_view option, std::size_t pixels, const HeightFile& file);

/// The same for --size.
PictureSize choose_size(const PictureOptions& options, const HeightFile& file);

} // namespace duskline::cli
