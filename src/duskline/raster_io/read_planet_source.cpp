// Heights of a map put on a grid of longitude and latitude.
//
// HeightFile makes heights of what is stored: units, scales and no data are its business. They go back to GDAL as a raster
// in memory, which its warper puts on the geographic coordinates of the same datum; a shift to another datum would move
// ground that all maps of a planet agree on by less than their cells.

#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/read_height_field.h>
#include <duskline/raster_io/read_planet_source.h>

#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace duskline {

namespace {

struct SpatialReferenceReleaser {
    void operator()(OGRSpatialReference* crs) const { crs->Release(); }
};
using SpatialReference = std::unique_ptr<OGRSpatialReference, SpatialReferenceReleaser>;

struct WarpOptionsReleaser {
    void operator()(GDALWarpAppOptions* options) const { GDALWarpAppOptionsFree(options); }
};

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw InputError("'" + path + "': " + why);
}

// In the order of the library: a step of `down` and `across` for what was turned round.
std::array<double, 6> geotransform_in_order(const HeightFileFacts& facts)
{
    std::array<double, 6> gt = *facts.geotransform;
    const auto turn_round = [&](std::size_t cells, std::size_t x_step, std::size_t y_step) {
        gt[0] += static_cast<double>(cells) * gt.at(x_step);
        gt[3] += static_cast<double>(cells) * gt.at(y_step);
        gt.at(x_step) = -gt.at(x_step);
        gt.at(y_step) = -gt.at(y_step);
    };
    if (facts.ground.columns_flipped)
        turn_round(facts.columns, 1, 4);
    if (facts.ground.rows_flipped)
        turn_round(facts.rows, 2, 5);
    return gt;
}

SpatialReference crs_of(const HeightFileFacts& facts)
{
    SpatialReference crs(new OGRSpatialReference());
    if (facts.crs_wkt.empty() || !facts.geotransform
        || crs->importFromWkt(facts.crs_wkt.c_str()) != OGRERR_NONE)
        refuse(facts.path, "does not say where on a planet it lies; gdal_edit.py -a_srs and -a_ullr say so");
    crs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return crs;
}

// Of the same ellipsoid, in degrees from Greenwich, or the prime meridian of another body.
SpatialReference degrees_on_the_ellipsoid(const OGRSpatialReference& crs)
{
    SpatialReference degrees(new OGRSpatialReference());
    degrees->SetGeogCS("degrees", "its own", "its own", crs.GetSemiMajor(), crs.GetInvFlattening());
    degrees->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return degrees;
}

Dataset raster_in_memory(Grid<float>& heights_m, const std::array<double, 6>& geotransform,
                         const OGRSpatialReference& crs, const std::string& path)
{
    GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
    Dataset raster(memory->Create("", static_cast<int>(heights_m.columns()),
                                  static_cast<int>(heights_m.rows()), 1, GDT_Float32, nullptr));
    std::array<double, 6> place = geotransform;
    GDALRasterBand& band = *raster->GetRasterBand(1);
    raster->SetSpatialRef(&crs);
    raster->SetGeoTransform(place.data());
    band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
    const GdalErrors errors;
    const auto columns = static_cast<int>(heights_m.columns());
    const auto rows = static_cast<int>(heights_m.rows());
    if (band.RasterIO(GF_Write, 0, 0, columns, rows, heights_m.data(), columns, rows, GDT_Float32, 0, 0,
                      nullptr)
        != CE_None)
        refuse(path, "cannot be warped: " + errors.reason("GDAL does not say why"));
    return raster;
}

Dataset warped(GDALDataset& raster, const OGRSpatialReference& to, const std::string& path)
{
    const GdalErrors errors;
    char* wkt = nullptr;
    to.exportToWkt(&wkt);
    CPLStringList arguments;
    for (const char* argument :
         {"-of", "MEM", "-r", "cubic", "-dstnodata", "nan", "-t_srs", static_cast<const char*>(wkt)})
        arguments.AddString(argument);
    CPLFree(wkt);
    const std::unique_ptr<GDALWarpAppOptions, WarpOptionsReleaser> options(
        GDALWarpAppOptionsNew(arguments.List(), nullptr));
    GDALDatasetH from = GDALDataset::ToHandle(&raster);
    Dataset result(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &from, options.get(), nullptr)));
    if (!result)
        refuse(path, "its map cannot be turned into longitudes and latitudes: "
                         + errors.reason("GDAL does not say why"));
    return result;
}

PlanetSource placed(Grid<float> heights_m, const std::array<double, 6>& gt, double degrees_per_unit)
{
    return {std::move(heights_m), Angle::from_degrees(gt[0] * degrees_per_unit),
            Angle::from_degrees(gt[3] * degrees_per_unit), Angle::from_degrees(gt[1] * degrees_per_unit),
            Angle::from_degrees(-gt[5] * degrees_per_unit)};
}

PlanetSource source_of(GDALDataset& raster, const std::string& path)
{
    std::array<double, 6> gt = {};
    raster.GetGeoTransform(gt.data());
    Grid<float> heights_m(static_cast<std::size_t>(raster.GetRasterYSize()),
                          static_cast<std::size_t>(raster.GetRasterXSize()));
    const GdalErrors errors;
    if (raster.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, raster.GetRasterXSize(), raster.GetRasterYSize(),
                                          heights_m.data(), raster.GetRasterXSize(), raster.GetRasterYSize(),
                                          GDT_Float32, 0, 0, nullptr)
        != CE_None)
        refuse(path, "cannot be warped: " + errors.reason("GDAL does not say why"));
    return placed(std::move(heights_m), gt, 1.0);
}

bool is_plain_grid_of_degrees(const OGRSpatialReference& crs, const std::array<double, 6>& gt)
{
    return crs.IsGeographic() && gt[2] == 0.0 && gt[4] == 0.0 && gt[1] > 0.0 && gt[5] < 0.0
           && crs.GetPrimeMeridian() == 0.0;
}

} // namespace

PlanetSourceFile read_planet_source(const std::string& path, const Execution& execution)
{
    // Cells of a whole planet have no one size on the ground, and need none here.
    ReadOptions options;
    options.cell_size_m = 1.0;
    HeightFile file(path, options);
    const HeightFileFacts& facts = file.facts();
    const SpatialReference crs = crs_of(facts);
    const std::array<double, 6> gt = geotransform_in_order(facts);
    PlanetSourceFile result;
    result.globe = {crs->GetSemiMajor(), crs->GetSemiMinor()};
    result.is_earth = facts.ground.body && facts.ground.body->is_earth;
    Grid<float> heights_m = std::move(read_terrain(file, execution).heights_m);
    if (facts.base_m != 0.0)
        for (float& height_m : heights_m.values())
            height_m = static_cast<float>(static_cast<double>(height_m) + facts.base_m);
    if (is_plain_grid_of_degrees(*crs, gt)) {
        result.source = placed(std::move(heights_m), gt, crs->GetAngularUnits() * 180.0 / M_PI);
    } else {
        const Dataset raster = raster_in_memory(heights_m, gt, *crs, path);
        const Dataset in_degrees = warped(*raster, *degrees_on_the_ellipsoid(*crs), path);
        result.source = source_of(*in_degrees, path);
    }
    require_valid(result.source);
    return result;
}

} // namespace duskline
