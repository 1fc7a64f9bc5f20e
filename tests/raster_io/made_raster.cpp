#include "made_raster.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>

namespace duskline::raster_test {
namespace {

namespace fs = std::filesystem;

struct Closer {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Closer>;

GDALColorInterp meaning_of(const std::string& colour)
{
    static const std::map<std::string, GDALColorInterp> meanings = {
        {"red", GCI_RedBand},     {"green", GCI_GreenBand}, {"blue", GCI_BlueBand},
        {"alpha", GCI_AlphaBand}, {"grey", GCI_GrayIndex},  {"palette", GCI_PaletteIndex}};
    return meanings.at(colour);
}

void set_place(GDALDataset& dataset, const MadeRaster& raster)
{
    if (raster.geotransform) {
        auto gt = *raster.geotransform;
        dataset.SetGeoTransform(gt.data());
    }
    if (raster.crs.empty())
        return;
    OGRSpatialReference crs;
    if (crs.SetFromUserInput(raster.crs.c_str()) != OGRERR_NONE)
        throw std::runtime_error("no coordinate system is called " + raster.crs);
    dataset.SetSpatialRef(&crs);
}

void set_bands(GDALDataset& dataset, const MadeRaster& raster)
{
    for (std::size_t i = 0; i < raster.colours.size(); ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(i) + 1);
        if (raster.colours[i] == "palette") {
            GDALColorTable table;
            const GDALColorEntry grey = {9, 9, 9, 255};
            table.SetColorEntry(0, &grey);
            band.SetColorTable(&table);
        } else {
            band.SetColorInterpretation(meaning_of(raster.colours[i]));
        }
    }
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    if (raster.no_data)
        first.SetNoDataValue(*raster.no_data);
    if (raster.scale != 1.0 || raster.offset != 0.0) {
        first.SetScale(raster.scale);
        first.SetOffset(raster.offset);
    }
    if (!raster.unit.empty())
        first.SetUnitType(raster.unit.c_str());
}

void set_values(GDALDataset& dataset, const MadeRaster& raster)
{
    const auto columns = static_cast<int>(raster.columns);
    std::vector<double> row(raster.columns);
    for (int band = 1; band <= dataset.GetRasterCount(); ++band) {
        for (std::size_t y = 0; y < raster.rows; ++y) {
            for (std::size_t x = 0; x < raster.columns; ++x)
                row[x] = raster.value(static_cast<std::size_t>(band), y, x);
            if (dataset.GetRasterBand(band)->RasterIO(GF_Write, 0, static_cast<int>(y), columns, 1,
                                                      row.data(), columns, 1, GDT_Float64, 0, 0, nullptr)
                != CE_None)
                throw std::runtime_error(CPLGetLastErrorMsg());
        }
    }
}

} // namespace

void write(const MadeRaster& raster, const std::string& path)
{
    GDALAllRegister();
    const GDALDataType type = GDALGetDataTypeByName(raster.type.c_str());
    const int bands = std::max(1, static_cast<int>(raster.colours.size()));
    CPLStringList options;
    for (const std::string& option : raster.creation_options)
        options.AddString(option.c_str());
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(raster.format.c_str());
    const Dataset dataset(driver->Create(path.c_str(), static_cast<int>(raster.columns),
                                         static_cast<int>(raster.rows), bands, type, options.List()));
    if (!dataset)
        throw std::runtime_error(CPLGetLastErrorMsg());
    set_place(*dataset, raster);
    set_bands(*dataset, raster);
    set_values(*dataset, raster);
}

FolderTest::FolderTest()
{
    std::string name = (fs::temp_directory_path() / "duskline-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("cannot make a folder " + name);
    folder_ = name;
}

FolderTest::~FolderTest()
{
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::vector<std::string> FolderTest::files() const
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

std::string FolderTest::made(const MadeRaster& raster, const std::string& name) const
{
    write(raster, path(name));
    return path(name);
}

std::string shared_data(const std::string& name)
{
    const fs::path file = fs::path(DUSKLINE_SHARED_DATA) / name;
    return fs::exists(file) ? file.string() : "";
}

} // namespace duskline::raster_test
