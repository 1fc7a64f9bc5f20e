// A picture of the ground, brought to the grid of its heights.
//
// First every raster becomes one of red, green, blue and perhaps alpha (a virtual one: nothing is copied).
// Then GDAL warps it into memory that lies as the heights do.

#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/open_raster.h>
#include <duskline/raster_io/read_colours.h>

#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace duskline {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw InputError("'" + path + "': " + why);
}

void require_bytes(GDALDataset& dataset, const std::string& path)
{
    for (int i = 1; i <= std::min(dataset.GetRasterCount(), 3); ++i) {
        const GDALDataType type = dataset.GetRasterBand(i)->GetRasterDataType();
        if (type != GDT_Byte)
            refuse(path, std::string("holds ") + GDALGetDataTypeName(type)
                             + ", not colours of 8 bits; gdal_translate -ot Byte -scale makes them");
    }
}

bool has_alpha(GDALDataset& dataset, int band)
{
    return dataset.GetRasterCount() >= band
           && dataset.GetRasterBand(band)->GetColorInterpretation() == GCI_AlphaBand;
}

// What gdal_translate is told, to make red, green, blue and perhaps alpha of these bands.
std::vector<std::string> translation(GDALDataset& dataset)
{
    std::vector<std::string> options = {"-of", "VRT"};
    const auto add_bands = [&](std::initializer_list<const char*> bands) {
        for (const char* band : bands) {
            options.emplace_back("-b");
            options.emplace_back(band);
        }
    };
    const int count = dataset.GetRasterCount();
    if (dataset.GetRasterBand(1)->GetColorTable() != nullptr) {
        options.emplace_back("-expand");
        options.emplace_back("rgba");
    } else if (count >= 4 && has_alpha(dataset, 4)) {
        add_bands({"1", "2", "3", "4"});
    } else if (count >= 3) {
        add_bands({"1", "2", "3"});
    } else if (has_alpha(dataset, 2)) {
        add_bands({"1", "1", "1", "2"});
    } else {
        add_bands({"1", "1", "1"});
    }
    return options;
}

// An option list in the form GDAL's utilities want.
struct TranslateOptions {
    explicit TranslateOptions(const std::vector<std::string>& items)
        : options(GDALTranslateOptionsNew(const_cast<char**>(as_gdal_list(items).List()), nullptr))
    {}
    ~TranslateOptions() { GDALTranslateOptionsFree(options); }
    TranslateOptions(const TranslateOptions&) = delete;
    TranslateOptions& operator=(const TranslateOptions&) = delete;

    GDALTranslateOptions* options;
};

struct WarpOptions {
    explicit WarpOptions(const std::vector<std::string>& items)
        : options(GDALWarpAppOptionsNew(const_cast<char**>(as_gdal_list(items).List()), nullptr))
    {}
    ~WarpOptions() { GDALWarpAppOptionsFree(options); }
    WarpOptions(const WarpOptions&) = delete;
    WarpOptions& operator=(const WarpOptions&) = delete;

    GDALWarpAppOptions* options;
};

Dataset as_colours(GDALDataset& dataset, const std::string& path)
{
    const GdalErrors errors;
    const TranslateOptions options(translation(dataset));
    Dataset colours(GDALDataset::FromHandle(GDALTranslate("", &dataset, options.options, nullptr)));
    if (!colours)
        refuse(path, "cannot be taken as colours: " + errors.reason("GDAL does not say why"));
    constexpr std::array meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    for (int i = 1; i <= colours->GetRasterCount(); ++i)
        colours->GetRasterBand(i)->SetColorInterpretation(meanings[static_cast<std::size_t>(i) - 1]);
    return colours;
}

bool has_size(GDALDataset& dataset, std::size_t rows, std::size_t columns)
{
    return static_cast<std::size_t>(dataset.GetRasterYSize()) == rows
           && static_cast<std::size_t>(dataset.GetRasterXSize()) == columns;
}

bool has_place(GDALDataset& dataset)
{
    std::array<double, 6> gt{};
    return dataset.GetGeoTransform(gt.data()) == CE_None || dataset.GetGCPCount() > 0;
}

using Geotransform = std::array<double, 6>;

// Of that many cells over the ground of the heights.
std::optional<Geotransform> geotransform_of(const HeightFileFacts& facts, const Grid<Rgba>& grid)
{
    if (!facts.geotransform)
        return std::nullopt;
    Geotransform gt = *facts.geotransform;
    const double wider = static_cast<double>(facts.columns) / static_cast<double>(grid.columns());
    const double higher = static_cast<double>(facts.rows) / static_cast<double>(grid.rows());
    return Geotransform{gt[0], gt[1] * wider, gt[2] * higher, gt[3], gt[4] * wider, gt[5] * higher};
}

// Bands of `grid`'s own memory that lie on the ground as the heights' file does.
Dataset memory_dataset(Grid<Rgba>& grid, const HeightFileFacts& facts)
{
    GDALDriver& memory = *GetGDALDriverManager()->GetDriverByName("MEM");
    Dataset dataset(memory.Create("", static_cast<int>(grid.columns()), static_cast<int>(grid.rows()), 0,
                                  GDT_Byte, nullptr));
    for (std::size_t band = 0; band < 4; ++band) {
        char address[64] = {};
        const int length = CPLPrintPointer(address, &grid.data()->at(band), sizeof(address) - 1);
        CPLStringList options;
        options.SetNameValue("DATAPOINTER", std::string(address, static_cast<std::size_t>(length)).c_str());
        options.SetNameValue("PIXELOFFSET", "4");
        options.SetNameValue("LINEOFFSET", std::to_string(4 * grid.columns()).c_str());
        dataset->AddBand(GDT_Byte, options.List());
    }
    constexpr std::array meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    for (int i = 1; i <= 4; ++i)
        dataset->GetRasterBand(i)->SetColorInterpretation(meanings[static_cast<std::size_t>(i) - 1]);
    if (auto gt = geotransform_of(facts, grid))
        dataset->SetGeoTransform(gt->data());
    OGRSpatialReference crs;
    if (!facts.crs_wkt.empty() && crs.importFromWkt(facts.crs_wkt.c_str()) == OGRERR_NONE) {
        crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        dataset->SetSpatialRef(&crs);
    }
    return dataset;
}

// The raster lies on the very same cells, or says nothing about its place; then it may be coarser.
void copy_cells(GDALDataset& colours, Grid<Rgba>& grid, const std::string& path)
{
    const GdalErrors errors;
    const auto columns = static_cast<int>(grid.columns());
    const auto rows = static_cast<int>(grid.rows());
    const int bands = colours.GetRasterCount();
    if (bands == 3)
        for (Rgba& pixel : grid.values())
            pixel[3] = 255;
    GDALRasterIOExtraArg resampling;
    INIT_RASTERIO_EXTRA_ARG(resampling);
    resampling.eResampleAlg = GRIORA_Bilinear;
    if (colours.RasterIO(GF_Read, 0, 0, colours.GetRasterXSize(), colours.GetRasterYSize(), grid.data(),
                         columns, rows, GDT_Byte, bands, nullptr, 4, 4 * static_cast<GSpacing>(columns), 1,
                         &resampling)
        != CE_None)
        refuse(path, "cannot be read: " + errors.reason("GDAL does not say why"));
}

void warp(GDALDataset& colours, Grid<Rgba>& grid, const HeightFile& like, const std::string& path,
          const Execution& execution)
{
    const GdalErrors errors;
    const Dataset target = memory_dataset(grid, like.facts());
    const WarpOptions options({"-r", "bilinear", "-wo", "NUM_THREADS=" + gdal_threads(execution.threads)});
    GDALDatasetH source = &colours;
    int wrong = FALSE;
    const GDALDatasetH warped = GDALWarp(nullptr, target.get(), 1, &source, options.options, &wrong);
    if (warped == nullptr || wrong != FALSE || errors.any())
        refuse(path, "cannot be warped to the grid of '" + like.facts().path
                         + "': " + errors.reason("GDAL does not say why"));
    target->FlushCache(false);
}

bool lies_on_same_cells(GDALDataset& colours, const HeightFileFacts& facts, const Grid<Rgba>& grid)
{
    Geotransform gt{};
    if (!has_size(colours, grid.rows(), grid.columns()) || colours.GetGeoTransform(gt.data()) != CE_None
        || gt != geotransform_of(facts, grid))
        return false;
    OGRSpatialReference crs;
    const OGRSpatialReference* own = colours.GetSpatialRef();
    if (own == nullptr || facts.crs_wkt.empty())
        return own == nullptr && facts.crs_wkt.empty();
    return crs.importFromWkt(facts.crs_wkt.c_str()) == OGRERR_NONE && own->IsSame(&crs) != FALSE;
}

void put_in_order(Grid<Rgba>& grid, const GroundFrame& ground)
{
    if (ground.rows_flipped)
        for (std::size_t top = 0, bottom = grid.rows() - 1; top < bottom; ++top, --bottom)
            std::ranges::swap_ranges(grid.row(top), grid.row(bottom));
    if (ground.columns_flipped)
        for (std::size_t y = 0; y < grid.rows(); ++y)
            std::ranges::reverse(grid.row(y));
}

} // namespace

Grid<Rgba> read_colours(const std::string& path, const HeightFile& like, const Execution& execution)
{
    return read_colours(path, like, like.rows(), like.columns(), execution);
}

Grid<Rgba> read_colours(const std::string& path, const HeightFile& like, std::size_t rows,
                        std::size_t columns, const Execution& execution)
{
    const Dataset dataset = open_raster(path, {});
    require_bytes(*dataset, path);
    const Dataset colours = as_colours(*dataset, path);
    const bool same_size =
        has_size(*colours, like.rows(), like.columns()) || has_size(*colours, rows, columns);
    const bool placed = has_place(*dataset) && like.facts().geotransform;
    if (!placed && !same_size)
        refuse(path, "has no georeference, and " + std::to_string(colours->GetRasterYSize()) + " rows x "
                         + std::to_string(colours->GetRasterXSize())
                         + " columns; without one it must have the " + std::to_string(like.rows()) + " x "
                         + std::to_string(like.columns()) + " of '" + like.facts().path + "'");

    require_memory(rows, columns, sizeof(Rgba), "the colours of '" + path + "'");
    Grid<Rgba> grid(rows, columns, Rgba{0, 0, 0, 0});
    if (!placed || lies_on_same_cells(*colours, like.facts(), grid))
        copy_cells(*colours, grid, path);
    else
        warp(*colours, grid, like, path, execution);
    put_in_order(grid, like.ground());
    if (execution.progress && !execution.progress(1.0))
        throw Cancelled();
    return grid;
}

} // namespace duskline
