#pragma once

#include <duskline/execution/progress.h>
#include <duskline/geometry/grid.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/ground_frame.h>
#include <duskline/terrain/height_field.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace duskline {

/// How to read heights out of a file. A default one believes the file.
struct ReadOptions {
    std::size_t band = 0;                       ///< counted from 1; 0 takes the first, unless it is a colour
    std::vector<std::string> open_options = {}; ///< KEY=VALUE, for GDAL's driver
    double z_factor = 1.0;                      ///< heights are multiplied by it; finite and not 0
    std::optional<double> metres_per_unit = {}; ///< of the heights; empty: as the file says, else 1
    std::optional<double> cell_size_m = {}; ///< square cells of this size, whatever the file says; above 0
    std::optional<double> no_data = {};     ///< one more value, as stored, that means no data
    std::size_t threads = 0;                ///< for decompression; 0 means all
};

/// What a file says about itself and what was made of it.
struct HeightFileFacts {
    std::string path;   ///< as given
    std::string format; ///< GDAL's short name of the driver
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::size_t band = 1;       ///< the one that is read, from 1
    std::size_t band_count = 1; ///< bands in the file
    std::string sample_type;    ///< GDAL's name: Int16, Float32, ...
    std::string compression;    ///< empty when there is none
    std::size_t block_rows = 1; ///< of the file's blocks; reading whole ones is fastest
    std::size_t block_columns = 1;

    std::string height_unit;      ///< in words: "metres", "US survey feet"
    double metres_per_unit = 1.0; ///< of stored heights, after scale and offset, without the z factor
    double scale = 1.0;           ///< stored * scale + offset is a height in height_unit
    double offset = 0.0;
    double z_factor = 1.0;
    double base_m = 0.0;                ///< taken off all heights that are read; see `read`
    std::optional<double> no_data = {}; ///< declared by the file, as stored
    bool has_mask = false;              ///< a mask or alpha band says where there is data

    std::string crs_name;                              ///< empty when the file has none
    std::string crs_wkt;                               ///< WKT 2, empty when the file has none
    std::optional<std::array<double, 6>> geotransform; ///< of the file, in GDAL's order; empty: none
    GroundFrame ground;

    std::vector<std::string> notes;    ///< what was assumed, one sentence each
    std::vector<std::string> warnings; ///< assumptions that may well be wrong, or that cost accuracy
};

/// What turned up while heights were read.
struct ReadTally {
    std::size_t cells = 0;   ///< read so far
    std::size_t no_data = 0; ///< of them without data, for whatever reason
    std::size_t undeclared_voids =
        0;                      ///< of those, for a value the file does not declare: -32768, -9999, 1e30...
    std::size_t infinities = 0; ///< of those, infinite
};

/// A raster of heights, open for reading: anything GDAL reads, /vsi names too. Rows and columns are counted
/// in the library's order (row 0 north, column 0 west), whatever the file's.
///
/// One thread at a time may use it; different files may be read at once.
class HeightFile {
public:
    /// Opens the file, settles its units and place, and reads no heights yet.
    ///
    /// Throws InputError when the file cannot be read, holds no heights (a colour picture, complex numbers),
    /// or its cells have no honest size in metres (sheared, over a pole, ground control points only);
    /// InvalidInput when an option is out of range.
    explicit HeightFile(const std::string& path, const ReadOptions& options = {});
    ~HeightFile();
    HeightFile(HeightFile&&) noexcept;
    HeightFile& operator=(HeightFile&&) noexcept;

    const HeightFileFacts& facts() const;
    std::size_t rows() const { return facts().rows; }
    std::size_t columns() const { return facts().columns; }
    const GroundFrame& ground() const { return facts().ground; }

    /// Fills `out` with the heights from (first_row, first_column) on: metres (times the z factor), less
    /// `base_m` of the facts, NaN where there are no data. The base is 0 but for files whose heights are too
    /// large for a float to keep centimetres (distances from a planet's centre).
    ///
    /// No data is what the file declares, what its mask or alpha band leaves out, NaN, infinities, anything
    /// beyond 1e30, -32768, and -9999 where the file declares nothing else.
    ///
    /// Fastest in whole blocks. Throws InputError, with GDAL's reason, when the file breaks off.
    void read(std::size_t first_row, std::size_t first_column, GridView<float> out);

    /// Counts over all calls of `read` so far.
    const ReadTally& tally() const;

    /// Whether `path`, under any name (link, other spelling), is a file this raster is made of. A result must
    /// not go there.
    bool is_made_of(const std::string& path) const;

private:
    friend class RasterWriter;
    struct Open;
    std::unique_ptr<Open> open_;
};

/// All heights of a file. Throws as HeightFile::read; UnsupportedOnThisMachine, before it allocates anything,
/// when they do not fit in memory; Cancelled.
Terrain read_terrain(HeightFile& file, const Execution& execution = {});

/// For programs, once, before they read: keeps GDAL's cache of decoded blocks under `cache_bytes` (Duskline
/// needs little of it) and what GDAL's own threads complain of from stderr; it goes into our errors instead.
/// Both are settings of the whole process, which a library must not touch unasked.
void prepare_gdal_for_program(std::size_t cache_bytes = std::size_t{64} << 20U);

} // namespace duskline
