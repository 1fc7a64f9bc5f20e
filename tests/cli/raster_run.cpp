#include "raster_run.h"

#include <gdal_priv.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace duskline::cli_test {

ReadRaster read_raster(const std::string& path)
{
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    if (!dataset)
        throw std::runtime_error("cannot read " + path);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    ReadRaster raster;
    raster.rows = static_cast<std::size_t>(dataset->GetRasterYSize());
    raster.columns = static_cast<std::size_t>(dataset->GetRasterXSize());
    raster.values.resize(raster.rows * raster.columns);
    if (band.RasterIO(GF_Read, 0, 0, dataset->GetRasterXSize(), dataset->GetRasterYSize(),
                      raster.values.data(), dataset->GetRasterXSize(), dataset->GetRasterYSize(), GDT_Float32,
                      0, 0, nullptr)
        != CE_None)
        throw std::runtime_error("cannot read the values of " + path);
    raster.no_data = band.GetNoDataValue();
    raster.description = band.GetDescription();
    char** tags = dataset->GetMetadata();
    for (int i = 0; i < CSLCount(tags); ++i) {
        const std::string tag = tags[i];
        raster.tags[tag.substr(0, tag.find('='))] = tag.substr(tag.find('=') + 1);
    }
    dataset->GetGeoTransform(raster.geotransform.data());
    if (const OGRSpatialReference* crs = dataset->GetSpatialRef())
        raster.crs_name = crs->GetName();
    return raster;
}

raster_test::MadeRaster RasterRun::hills(std::size_t rows, std::size_t columns)
{
    raster_test::MadeRaster raster{.rows = rows, .columns = columns, .no_data = -1.0};
    raster.value = [](std::size_t, std::size_t row, std::size_t column) {
        const auto y = static_cast<double>(row);
        const auto x = static_cast<double>(column);
        if (std::hypot(y - 40.0, x - 30.0) < 6.0)
            return -1.0;
        return 150.0 + 80.0 * std::sin(x / 17.0) * std::cos(y / 23.0) + 30.0 * std::sin(x / 3.1 + y / 4.7)
               + 40.0 * std::cos(y / 7.3);
    };
    return raster;
}

} // namespace duskline::cli_test
