#pragma once

#include <duskline/products/light_map.h>
#include <duskline/raster_io/raster_writer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace duskline::cli {

/// How many bits a sample of a light map has.
enum class SampleDepth { byte, word, real };

/// --ot: Byte, UInt16 or Float32, as GDAL calls them. Throws UsageError.
SampleDepth parse_depth(const std::string& text);

/// A light map on its way to a file.
struct LightPixels {
    const LightMap& map;
    GridView<const Rgba8> texture = {}; ///< says how opaque a cell is; empty: wholly
    SampleDepth depth = SampleDepth::byte;
    bool over_white = false; ///< the format has no opacity
};

/// Written for cells without data where samples are reals.
inline constexpr float kNoLight = -9999.0f;

/// Whether every cell has light, and a texture hides what lies under it.
bool is_opaque(const LightPixels& pixels);

/// What a raster of such pixels holds; `opacity` is left out where it says nothing.
Samples samples_of(const LightPixels& pixels, bool opacity);

/// Writes all of them. Throws as RasterWriter, Cancelled.
void write_pixels(RasterWriter& writer, const LightPixels& pixels, Samples samples,
                  const ProgressCallback& progress);

/// One row as colours of 8 bits.
void fill_colours(const LightPixels& pixels, std::size_t row, std::span<std::array<std::uint8_t, 3>> out);

} // namespace duskline::cli
