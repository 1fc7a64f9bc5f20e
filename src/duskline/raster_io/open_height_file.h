#pragma once

#include <duskline/raster_io/clean_heights.h>
#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/read_height_field.h>

#include <string>

namespace duskline {

/// An open file of heights: GDAL's side of a HeightFile.
struct HeightFile::Open {
    Open(const std::string& path, const ReadOptions& options);

    Dataset dataset;
    GDALRasterBand* band = nullptr;
    HeightFileFacts facts;
    ReadTally tally;
    Cleaning cleaning;
    double factor = 1.0; ///< of Cleaning, before rounding to float
    double shift = 0.0;  ///< of Cleaning, with the base still in
    std::size_t threads = 0;

    /// Reads rows of the file, in its own order, into `out`.
    void read_file_rows(std::size_t first_row, std::size_t first_column, GridView<float> out);

private:
    void settle_heights(const ReadOptions& options);
    void settle_base();
    void read_stored(std::size_t first_row, std::size_t first_column, GridView<float> out);
    void read_less_base(std::size_t first_row, std::size_t first_column, GridView<float> out);
    void read_mask(std::size_t first_row, std::size_t first_column, GridView<float> heights);
    void window(GDALRasterBand& from, std::size_t first_row, std::size_t first_column, std::size_t rows,
                std::size_t columns, void* out, GDALDataType type, std::size_t row_stride);
};

} // namespace duskline
