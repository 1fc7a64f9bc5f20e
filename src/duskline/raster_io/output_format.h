#pragma once

#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/raster_writer.h>

#include <string>

namespace duskline {

/// The driver that writes `format`, checked to hold such samples. Throws InvalidInput.
GDALDriver& output_driver(const std::string& format, const RasterContent& content);

/// The creation options the user gave, completed by ours. Throws InvalidInput for options that the driver
/// does not have or that are not KEY=VALUE.
CPLStringList completed_options(GDALDriver& driver, const RasterContent& content,
                                const WriteOptions& options);

int band_count(const RasterContent& content);
GDALDataType sample_type(const RasterContent& content);

} // namespace duskline
