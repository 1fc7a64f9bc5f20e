#pragma once

#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/read_height_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace duskline {

/// Where and how a raster is written.
struct WriteOptions {
    std::string format = {};                        ///< GDAL's short name; empty: from the file's extension
    std::vector<std::string> creation_options = {}; ///< KEY=VALUE; they replace ours key by key
    bool overwrite = false;                         ///< replace a file that is there
    std::size_t threads = 0;                        ///< for compression; 0 means all
};

/// What the bands of a raster hold.
enum class Samples {
    byte,       ///< 8 bits, in one band or in those named
    real,       ///< 32-bit floats, likewise
    rgb,        ///< red, green, blue of 8 bits
    rgba,       ///< and opacity
    byte_alpha, ///< grey and opacity of 8 bits
    word,       ///< one band of 16 bits, without a sign
    word_alpha, ///< grey and opacity of 16 bits
    rgb_words,  ///< red, green, blue of 16 bits
    rgba_words, ///< and opacity
    rgb_reals,  ///< red, green, blue in 32-bit floats
};

/// One band of a raster of several that are no colours.
struct BandContent {
    std::string description = {};
    std::string unit = {};                                      ///< "m"
    std::vector<std::pair<std::string, std::string>> tags = {}; ///< metadata of the band
};

struct RasterContent {
    Samples samples = Samples::byte;
    std::size_t rows = 0;    ///< over the same ground as the file of heights; 0: as many as that has
    std::size_t columns = 0; ///< likewise
    std::optional<double> no_data = {}; ///< declared in the file, for all bands
    bool classes = false;               ///< values are codes: overviews take the most frequent, not the mean
    std::string description = {};       ///< of the band
    std::string unit = {};              ///< of the band: "m"
    std::vector<std::pair<std::string, std::string>> tags = {}; ///< metadata, in the file's default domain
    std::vector<BandContent> bands = {}; ///< of bytes or reals; empty: one, as described above
};

/// GDAL's short name of the format that `path` and `options` mean. Throws InvalidInput when no format that
/// GDAL can write has that name or extension.
std::string output_format(const std::string& path, const WriteOptions& options);

/// Whether that format is one of pictures (PNG, JPEG, ...), which people look at rather than compute with.
bool is_picture_format(const std::string& format);

/// A raster on the grid of a height file: the same rows and columns, coordinate system and geotransform; or
/// with rows and columns of its own over the same ground.
///
/// A raster whose file runs from south to north, or from east to west, gets its result in the same order; but
/// pictures (`is_picture_format`), which people look at, have north on top and east on the right, and a geotransform
/// that says so.
///
/// Everything goes to a temporary folder `.duskline-*` beside the target. `finish` moves it in place in one
/// step once it is whole and on disk. Without `finish` (an error, a stop) nothing is left, and a file that
/// was there before stays as it was.
///
/// GeoTIFF is tiled, DEFLATE, BIGTIFF=IF_SAFER unless the creation options say otherwise. Formats that
/// GDAL can only copy into (COG, PNG, ...) are made from a temporary GeoTIFF.
class RasterWriter {
public:
    /// Checks everything that can be checked before work starts. Throws InvalidInput for a format that is
    /// not there or cannot hold the samples; OutputError when the target is part of the input (under any
    /// name), exists and may not be overwritten, or its folder is missing or not writable.
    RasterWriter(const std::string& path, const HeightFile& like, const RasterContent& content,
                 const WriteOptions& options = {});
    ~RasterWriter();
    RasterWriter(RasterWriter&&) noexcept;
    RasterWriter& operator=(RasterWriter&&) noexcept;

    /// Writes a rectangle from (first_row, first_column) on, in the library's order of rows and columns.
    /// Rectangles may come in any order and must cover the grid. Whole blocks of `block_rows` x
    /// `block_columns`, from multiples of them, are compressed once and need no memory after.
    ///
    /// Throws OutputError with GDAL's reason (no space, file too large).
    void write(std::size_t first_row, std::size_t first_column, GridView<const std::uint8_t> values);
    void write(std::size_t first_row, std::size_t first_column, GridView<const Lit> values);
    void write(std::size_t first_row, std::size_t first_column, GridView<const float> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint8_t, 3>> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint8_t, 4>> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint8_t, 2>> values);
    void write(std::size_t first_row, std::size_t first_column, GridView<const std::uint16_t> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint16_t, 2>> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint16_t, 3>> values);
    void write(std::size_t first_row, std::size_t first_column,
               GridView<const std::array<std::uint16_t, 4>> values);
    void write(std::size_t first_row, std::size_t first_column, GridView<const std::array<float, 3>> values);

    /// The same into one band, counted from 0, of a raster of several bands of bytes or reals. Band after band is the
    /// order that GeoTIFF likes best: unless the creation options say otherwise, each lies in one piece.
    void write_band(std::size_t band, std::size_t first_row, std::size_t first_column,
                    GridView<const std::uint8_t> values);
    void write_band(std::size_t band, std::size_t first_row, std::size_t first_column,
                    GridView<const float> values);

    std::size_t block_rows() const;
    std::size_t block_columns() const;

    /// Completes the file, brings it to disk and moves it to its place. Throws OutputError, or Cancelled when
    /// `progress` asks to stop a copy; then nothing of it is left.
    void finish(const ProgressCallback& progress = {});

private:
    struct Open;
    std::unique_ptr<Open> open_;
};

} // namespace duskline
