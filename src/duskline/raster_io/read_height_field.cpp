// Heights out of any file that GDAL reads.
//
// GDAL delivers whole blocks of the file straight into the caller's floats, and one pass over them, while they
// are in the cache, makes heights of them. Decoded blocks are dropped as soon as they were used: a raster is
// read once, so nothing is gained by keeping it twice.

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/georeference.h>
#include <duskline/raster_io/height_unit.h>
#include <duskline/raster_io/memory_need.h>
#include <duskline/raster_io/open_height_file.h>
#include <duskline/raster_io/open_raster.h>
#include <duskline/raster_io/plain_number.h>
#include <duskline/raster_io/same_file.h>

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

namespace duskline {

namespace {

// Heights in one piece of reading: enough blocks for several threads to decode, few enough to stay in the
// cache.
constexpr std::size_t kPieceCells = std::size_t{1} << 20U;

// Floats keep millimetres up to here.
constexpr double kLargeHeight_m = 20000.0;

void require_valid(const ReadOptions& options)
{
    if (!(std::isfinite(options.z_factor) && options.z_factor != 0.0))
        throw InvalidInput("the z factor must be finite and not 0, got " + std::to_string(options.z_factor));
    const auto require_above_0 = [](const std::optional<double>& value, const char* name) {
        if (value && !(std::isfinite(*value) && *value > 0.0))
            throw InvalidInput(std::string(name) + " must be above 0, got " + std::to_string(*value));
    };
    require_above_0(options.metres_per_unit, "the unit of heights, in metres,");
    require_above_0(options.cell_size_m, "the cell size, in metres,");
}

std::string metadata(GDALMajorObject& object, const char* key, const char* domain)
{
    const char* value = object.GetMetadataItem(key, domain);
    return value != nullptr ? value : "";
}

std::string wkt_of(const OGRSpatialReference& crs)
{
    const GdalErrors errors;
    char* text = nullptr;
    const char* const format[] = {"FORMAT=WKT2_2019", nullptr};
    std::string wkt;
    if (crs.exportToWkt(&text, format) == OGRERR_NONE && text != nullptr)
        wkt = text;
    CPLFree(text);
    return wkt;
}

std::optional<double> declared_no_data(GDALRasterBand& band)
{
    int declared = FALSE;
    double value = 0.0;
    if (band.GetRasterDataType() == GDT_Int64)
        value = static_cast<double>(band.GetNoDataValueAsInt64(&declared));
    else if (band.GetRasterDataType() == GDT_UInt64)
        value = static_cast<double>(band.GetNoDataValueAsUInt64(&declared));
    else
        value = band.GetNoDataValue(&declared);
    return declared != FALSE ? std::optional(value) : std::nullopt;
}

// As a stored number arrives when GDAL turns it into a float.
float as_stored_float(double value)
{
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::isfinite(value) ? std::clamp(value, -most, most) : value);
}

bool says_where_data_is(GDALRasterBand& band)
{
    const int flags = band.GetMaskFlags();
    return (flags & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

// Types with more digits than a float.
bool has_fine_type(GDALRasterBand& band)
{
    const GDALDataType type = band.GetRasterDataType();
    return GDALGetDataTypeSizeBits(type) > 32 || type == GDT_Int32 || type == GDT_UInt32;
}

Georeference georeference_of(GDALDataset& dataset, const std::string& path)
{
    Georeference file;
    file.path = path;
    file.rows = static_cast<std::size_t>(dataset.GetRasterYSize());
    file.columns = static_cast<std::size_t>(dataset.GetRasterXSize());
    file.crs = dataset.GetSpatialRef();
    std::array<double, 6> gt{};
    if (dataset.GetGeoTransform(gt.data()) == CE_None)
        file.geotransform = gt;
    else if (dataset.GetGCPCount() > 0)
        throw InputError("'" + path + "': is placed by ground control points only; gdalwarp '" + path
                         + "' placed.tif makes a grid of it");
    return file;
}

void describe(GDALDataset& dataset, GDALRasterBand& band, HeightFileFacts& facts)
{
    facts.format = dataset.GetDriver() != nullptr ? dataset.GetDriver()->GetDescription() : "";
    facts.sample_type = GDALGetDataTypeName(band.GetRasterDataType());
    facts.compression = metadata(dataset, "COMPRESSION", "IMAGE_STRUCTURE");
    facts.band_count = static_cast<std::size_t>(dataset.GetRasterCount());
    int block_columns = 1;
    int block_rows = 1;
    band.GetBlockSize(&block_columns, &block_rows);
    facts.block_rows = static_cast<std::size_t>(std::max(block_rows, 1));
    facts.block_columns = static_cast<std::size_t>(std::max(block_columns, 1));
    const OGRSpatialReference* crs = dataset.GetSpatialRef();
    if (crs != nullptr && !crs->IsEmpty()) {
        facts.crs_name = crs->GetName() != nullptr ? on_one_line(crs->GetName()) : "unnamed";
        facts.crs_wkt = wkt_of(*crs);
    }
}

void settle_place(GDALDataset& dataset, const ReadOptions& options, HeightFileFacts& facts)
{
    const Georeference file = georeference_of(dataset, facts.path);
    facts.rows = file.rows;
    facts.columns = file.columns;
    facts.geotransform = file.geotransform;
    SettledGround settled = settle_ground(file, options.cell_size_m);
    facts.ground = settled.frame;
    std::ranges::move(settled.notes, std::back_inserter(facts.notes));
    std::ranges::move(settled.warnings, std::back_inserter(facts.warnings));
}

// The unit of the band, or of the vertical part of the coordinate system; empty when neither says.
std::optional<HeightUnit> unit_in_file(GDALDataset& dataset, GDALRasterBand& band, HeightFileFacts& facts)
{
    const std::string written = band.GetUnitType();
    if (auto unit = height_unit_written(written))
        return unit;
    if (!written.empty())
        facts.warnings.push_back("heights are in '" + on_one_line(written)
                                 + "', a unit that is not known: taken as metres (--z-unit says otherwise)");
    const OGRSpatialReference* crs = dataset.GetSpatialRef();
    if (crs == nullptr || !crs->IsCompound())
        return std::nullopt;
    return height_unit_of(crs->GetTargetLinearUnits("VERT_CS", nullptr));
}

HeightUnit settle_unit(GDALDataset& dataset, GDALRasterBand& band, const ReadOptions& options,
                       HeightFileFacts& facts)
{
    if (options.metres_per_unit) {
        HeightUnit unit = height_unit_of(*options.metres_per_unit);
        facts.notes.push_back("heights in " + unit.name + ", as asked");
        return unit;
    }
    if (const auto unit = unit_in_file(dataset, band, facts)) {
        if (unit->metres != 1.0)
            facts.notes.push_back("heights in " + unit->name + ", as the file says");
        return *unit;
    }
    const OGRSpatialReference* crs = dataset.GetSpatialRef();
    const double map_unit_m = crs != nullptr && crs->IsProjected() ? crs->GetLinearUnits() : 1.0;
    if (std::abs(map_unit_m - 1.0) > 1e-9)
        facts.warnings.push_back("the map is in " + height_unit_of(map_unit_m).name
                                 + " and the file does not say what its heights are in: taken as metres "
                                   "(--z-unit says otherwise)");
    else
        facts.notes.push_back("the file does not say the unit of its heights: taken as metres");
    return {"metres", 1.0};
}

void reverse_rows(GridView<float> grid)
{
    for (std::size_t top = 0, bottom = grid.rows() - 1; top < bottom; ++top, --bottom)
        std::ranges::swap_ranges(grid.row(top), grid.row(bottom));
}

void reverse_columns(GridView<float> grid)
{
    for (std::size_t y = 0; y < grid.rows(); ++y)
        std::ranges::reverse(grid.row(y));
}

} // namespace

HeightFile::Open::Open(const std::string& path, const ReadOptions& options) : threads(options.threads)
{
    require_valid(options);
    const GdalDefault decoders("GDAL_NUM_THREADS", gdal_threads(options.threads));
    dataset = open_raster(path, options.open_options);
    const GdalErrors errors;
    const ChosenBand chosen = choose_band(*dataset, path, options.band);
    band = dataset->GetRasterBand(static_cast<int>(chosen.number));
    facts.path = path;
    facts.band = chosen.number;
    if (!chosen.warning.empty())
        facts.warnings.push_back(chosen.warning);
    describe(*dataset, *band, facts);
    settle_place(*dataset, options, facts);
    settle_heights(options);
    settle_base();
}

void HeightFile::Open::settle_heights(const ReadOptions& options)
{
    const HeightUnit unit = settle_unit(*dataset, *band, options, facts);
    facts.height_unit = unit.name;
    facts.metres_per_unit = unit.metres;
    facts.scale = band->GetScale();
    facts.offset = band->GetOffset();
    facts.z_factor = options.z_factor;
    facts.no_data = declared_no_data(*band);
    facts.has_mask = says_where_data_is(*band);
    if (!(std::isfinite(facts.scale) && facts.scale != 0.0 && std::isfinite(facts.offset)))
        throw InputError("'" + facts.path + "': band " + std::to_string(facts.band) + " has scale "
                         + plain_number(facts.scale) + " and offset " + plain_number(facts.offset)
                         + ", which give no heights");
    if (facts.scale != 1.0 || facts.offset != 0.0)
        facts.notes.push_back("stored numbers are scaled by " + plain_number(facts.scale, 9)
                              + " and shifted by " + plain_number(facts.offset, 6) + ", as the file says");
    if (facts.z_factor != 1.0)
        facts.notes.push_back("heights are multiplied by " + plain_number(facts.z_factor, 6));

    factor = facts.scale * unit.metres * options.z_factor;
    shift = facts.offset * unit.metres * options.z_factor;
    cleaning.factor = static_cast<float>(factor);
    cleaning.shift = static_cast<float>(shift);
    if (facts.no_data)
        cleaning.declared_no_data = as_stored_float(*facts.no_data);
    if (options.no_data)
        cleaning.more_no_data = as_stored_float(*options.no_data);
}

// A look at the middle of the raster: are its heights too large for floats?
void HeightFile::Open::settle_base()
{
    if (!has_fine_type(*band))
        return;
    const std::size_t rows = std::min<std::size_t>(facts.rows, 16);
    const std::size_t columns = std::min<std::size_t>(facts.columns, 256);
    Grid<float> sample(rows, columns);
    read_stored((facts.rows - rows) / 2, (facts.columns - columns) / 2, sample.view());
    ReadTally not_counted;
    clean_heights(sample.values(), cleaning, not_counted);

    std::vector<float> heights_m;
    std::ranges::copy_if(sample.values(), std::back_inserter(heights_m),
                         [](float h) { return !std::isnan(h); });
    if (heights_m.empty())
        return;
    const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
    std::ranges::nth_element(heights_m, middle);
    if (std::abs(*middle) <= kLargeHeight_m)
        return;
    facts.base_m = std::round(static_cast<double>(*middle) / 1000.0) * 1000.0;
    facts.notes.push_back("heights are counted from " + plain_number(facts.base_m, 0)
                          + " m, so that no digits are lost");
}

void HeightFile::Open::read_file_rows(std::size_t first_row, std::size_t first_column, GridView<float> out)
{
    const std::size_t block = facts.block_rows;
    const std::size_t at_once = std::max<std::size_t>(kPieceCells / out.columns() / block, 1) * block;
    for (std::size_t row = 0; row < out.rows();) {
        const std::size_t to_block_border = at_once - (first_row + row) % block;
        const std::size_t rows = std::min(to_block_border, out.rows() - row);
        const GridView<float> piece = out.window(row, 0, rows, out.columns());
        if (facts.base_m != 0.0)
            read_less_base(first_row + row, first_column, piece);
        else
            read_stored(first_row + row, first_column, piece);
        for (std::size_t y = 0; facts.base_m == 0.0 && y < rows; ++y)
            clean_heights(piece.row(y), cleaning, tally);
        if (facts.has_mask)
            read_mask(first_row + row, first_column, piece);
        row += rows;
    }
}

void HeightFile::Open::read_stored(std::size_t first_row, std::size_t first_column, GridView<float> out)
{
    window(*band, first_row, first_column, out.rows(), out.columns(), out.data(), GDT_Float32,
           out.row_stride());
}

void HeightFile::Open::read_less_base(std::size_t first_row, std::size_t first_column, GridView<float> out)
{
    Grid<double> stored(out.rows(), out.columns());
    window(*band, first_row, first_column, out.rows(), out.columns(), stored.data(), GDT_Float64,
           out.columns());
    Cleaning only_voids = cleaning;
    only_voids.factor = 1.0F;
    only_voids.shift = 0.0F;
    for (std::size_t y = 0; y < out.rows(); ++y) {
        const auto heights = out.row(y);
        std::ranges::transform(stored.row(y), heights.begin(), as_stored_float);
        clean_heights(heights, only_voids, tally);
        for (std::size_t x = 0; x < heights.size(); ++x)
            if (!std::isnan(heights[x]))
                heights[x] = static_cast<float>(stored(y, x) * factor + shift - facts.base_m);
    }
}

void HeightFile::Open::read_mask(std::size_t first_row, std::size_t first_column, GridView<float> heights)
{
    Grid<std::uint8_t> mask(heights.rows(), heights.columns());
    window(*band->GetMaskBand(), first_row, first_column, mask.rows(), mask.columns(), mask.data(), GDT_Byte,
           mask.columns());
    for (std::size_t y = 0; y < mask.rows(); ++y)
        apply_mask(heights.row(y), mask.row(y), tally);
}

void HeightFile::Open::window(GDALRasterBand& from, std::size_t first_row, std::size_t first_column,
                              std::size_t rows, std::size_t columns, void* out, GDALDataType type,
                              std::size_t row_stride)
{
    const GdalErrors errors;
    const GdalDefault decoders("GDAL_NUM_THREADS", gdal_threads(threads));
    const auto width = static_cast<int>(columns);
    const auto height = static_cast<int>(rows);
    const auto sample_bytes = static_cast<GSpacing>(GDALGetDataTypeSizeBytes(type));
    const CPLErr result = from.RasterIO(GF_Read, static_cast<int>(first_column), static_cast<int>(first_row),
                                        width, height, out, width, height, type, sample_bytes,
                                        sample_bytes * static_cast<GSpacing>(row_stride), nullptr);
    if (result != CE_None)
        throw InputError("'" + facts.path + "': rows " + std::to_string(first_row) + " to "
                         + std::to_string(first_row + rows - 1)
                         + " cannot be read: " + errors.reason("GDAL does not say why"));
    from.FlushCache(false);
}

HeightFile::HeightFile(const std::string& path, const ReadOptions& options)
    : open_(std::make_unique<Open>(path, options))
{}

HeightFile::~HeightFile() = default;
HeightFile::HeightFile(HeightFile&&) noexcept = default;
HeightFile& HeightFile::operator=(HeightFile&&) noexcept = default;

const HeightFileFacts& HeightFile::facts() const
{
    return open_->facts;
}

const ReadTally& HeightFile::tally() const
{
    return open_->tally;
}

void HeightFile::read(std::size_t first_row, std::size_t first_column, GridView<float> out)
{
    assert(first_row + out.rows() <= rows() && first_column + out.columns() <= columns());
    if (out.empty())
        return;
    const bool flip_rows = ground().rows_flipped;
    const bool flip_columns = ground().columns_flipped;
    open_->read_file_rows(flip_rows ? rows() - first_row - out.rows() : first_row,
                          flip_columns ? columns() - first_column - out.columns() : first_column, out);
    if (flip_rows)
        reverse_rows(out);
    if (flip_columns)
        reverse_columns(out);
}

bool HeightFile::is_made_of(const std::string& path) const
{
    if (is_same_file(path, facts().path))
        return true;
    const GdalErrors errors;
    const CPLStringList files(open_->dataset->GetFileList(), TRUE);
    for (int i = 0; i < files.size(); ++i)
        if (is_same_file(path, files[i]))
            return true;
    return false;
}

Terrain read_terrain(HeightFile& file, const Execution& execution)
{
    require_memory(file.rows(), file.columns(), sizeof(float), "'" + file.facts().path + "'");
    Terrain terrain{Grid<float>(file.rows(), file.columns()), file.ground().cell_size_m};
    const std::size_t block = file.facts().block_rows;
    const std::size_t at_once =
        std::max<std::size_t>(4 * kPieceCells / std::max<std::size_t>(file.columns(), 1) / block, 1) * block;
    for (std::size_t row = 0; row < file.rows(); row += at_once) {
        const std::size_t rows = std::min(at_once, file.rows() - row);
        file.read(row, 0, terrain.heights_m.view().window(row, 0, rows, file.columns()));
        const double done = static_cast<double>(row + rows) / static_cast<double>(file.rows());
        if (execution.progress && !execution.progress(done))
            throw Cancelled();
    }
    return terrain;
}

} // namespace duskline
