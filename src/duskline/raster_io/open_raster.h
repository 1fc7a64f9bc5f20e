#pragma once

#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/read_height_field.h>

#include <string>

namespace duskline {

/// Opens a raster for reading. Throws InputError saying why it cannot be: missing, a folder, empty, without
/// permission, no raster, GDAL's own reason.
Dataset open_raster(const std::string& path, const std::vector<std::string>& open_options);

/// The band with the heights, counted from 1: `wanted`, or with 0 the first. Throws InputError when the bands
/// are colours or complex numbers, InvalidInput when there is no such band.
struct ChosenBand {
    std::size_t number;
    std::string warning; ///< empty when there was no choice
};
ChosenBand choose_band(GDALDataset& dataset, const std::string& path, std::size_t wanted);

} // namespace duskline
