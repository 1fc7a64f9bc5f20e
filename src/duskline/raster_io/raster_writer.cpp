// Rasters out, in any format that GDAL writes.
//
// GeoTIFF is written directly, block by block in whatever order blocks come. All other formats are copied from
// a temporary GeoTIFF: their drivers want rows from top to bottom, or the whole raster, or keep it in memory.

#include <duskline/execution/progress.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/open_height_file.h>
#include <duskline/raster_io/output_format.h>
#include <duskline/raster_io/plain_number.h>
#include <duskline/raster_io/raster_writer.h>
#include <duskline/raster_io/staged_output.h>

#include <ogr_spatialref.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <numeric>

namespace duskline {

namespace {

// What the raster takes over from the file of heights.
struct Placement {
    std::size_t rows = 0;
    std::size_t columns = 0;
    GroundFrame ground;
    std::optional<std::array<double, 6>> geotransform;
    std::unique_ptr<OGRSpatialReference> crs;
    std::string area_or_point;
};

// Other rows and columns over the same ground.
void resample(Placement& placement, std::size_t rows, std::size_t columns)
{
    if (placement.geotransform) {
        auto& gt = *placement.geotransform;
        const double wider = static_cast<double>(placement.columns) / static_cast<double>(columns);
        const double higher = static_cast<double>(placement.rows) / static_cast<double>(rows);
        gt = {gt[0], gt[1] * wider, gt[2] * higher, gt[3], gt[4] * wider, gt[5] * higher};
    }
    placement.rows = rows;
    placement.columns = columns;
}

// North on top, east on the right.
void turn_to_viewer(Placement& placement)
{
    if (placement.geotransform) {
        auto& gt = *placement.geotransform;
        const auto turn = [&gt](std::size_t per_x, std::size_t per_y, std::size_t count) {
            gt[0] += gt[per_x] * static_cast<double>(count);
            gt[3] += gt[per_y] * static_cast<double>(count);
            gt[per_x] = -gt[per_x];
            gt[per_y] = -gt[per_y];
        };
        if (placement.ground.rows_flipped)
            turn(2, 5, placement.rows);
        if (placement.ground.columns_flipped)
            turn(1, 4, placement.columns);
    }
    placement.ground.rows_flipped = false;
    placement.ground.columns_flipped = false;
}

Placement placement_of(GDALDataset& dataset, const HeightFileFacts& facts, const RasterContent& content)
{
    Placement placement{facts.rows, facts.columns, facts.ground, facts.geotransform, nullptr, ""};
    resample(placement, content.rows == 0 ? facts.rows : content.rows,
             content.columns == 0 ? facts.columns : content.columns);
    if (const OGRSpatialReference* crs = dataset.GetSpatialRef())
        placement.crs.reset(crs->Clone());
    if (const char* convention = dataset.GetMetadataItem("AREA_OR_POINT"))
        placement.area_or_point = convention;
    return placement;
}

void set_placement(GDALDataset& dataset, const Placement& placement)
{
    if (placement.geotransform) {
        std::array<double, 6> gt = *placement.geotransform;
        dataset.SetGeoTransform(gt.data());
    }
    if (placement.crs)
        dataset.SetSpatialRef(placement.crs.get());
    if (!placement.area_or_point.empty())
        dataset.SetMetadataItem("AREA_OR_POINT", placement.area_or_point.c_str());
}

void set_colours(GDALDataset& dataset)
{
    constexpr std::array grey = {GCI_GrayIndex, GCI_AlphaBand};
    constexpr std::array colours = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    const int count = dataset.GetRasterCount();
    for (int i = 0; i < count; ++i) {
        const auto band = static_cast<std::size_t>(i);
        dataset.GetRasterBand(i + 1)->SetColorInterpretation(count == 2 ? grey.at(band) : colours.at(band));
    }
}

void set_band(GDALRasterBand& band, const BandContent& content, std::optional<double> no_data)
{
    if (no_data)
        band.SetNoDataValue(*no_data);
    if (!content.description.empty())
        band.SetDescription(content.description.c_str());
    if (!content.unit.empty())
        band.SetUnitType(content.unit.c_str());
    for (const auto& [key, value] : content.tags)
        band.SetMetadataItem(key.c_str(), value.c_str());
}

void set_content(GDALDataset& dataset, const RasterContent& content)
{
    for (const auto& [key, value] : content.tags)
        dataset.SetMetadataItem(key.c_str(), value.c_str());
    const int count = dataset.GetRasterCount();
    for (int i = 0; i < count && !content.bands.empty(); ++i)
        set_band(*dataset.GetRasterBand(i + 1), content.bands[static_cast<std::size_t>(i)], content.no_data);
    if (!content.bands.empty())
        return;
    for (int i = 1; i <= count; ++i)
        set_band(*dataset.GetRasterBand(i), {}, content.no_data);
    if (count > 1)
        return set_colours(dataset);
    set_band(*dataset.GetRasterBand(1), {content.description, content.unit, {}}, {});
}

Dataset created(GDALDriver& driver, const std::string& path, const Placement& placement,
                const RasterContent& content, const CPLStringList& options)
{
    Dataset dataset(driver.Create(path.c_str(), static_cast<int>(placement.columns),
                                  static_cast<int>(placement.rows), band_count(content), sample_type(content),
                                  const_cast<char**>(options.List())));
    if (dataset) {
        set_placement(*dataset, placement);
        set_content(*dataset, content);
    }
    return dataset;
}

// GDAL's view of a callback, and whether it asked to stop.
struct CopyProgress {
    const ProgressCallback& callback;
    bool stopped = false;

    static int CPL_STDCALL call(double done, const char*, void* self)
    {
        auto& progress = *static_cast<CopyProgress*>(self);
        progress.stopped = progress.callback && !progress.callback(done);
        return progress.stopped ? FALSE : TRUE;
    }
};

template <typename T>
Grid<T> turned_round(GridView<const T> values, bool rows, bool columns)
{
    Grid<T> turned(values.rows(), values.columns());
    for (std::size_t y = 0; y < values.rows(); ++y) {
        const auto from = values.row(y);
        const auto to = turned.row(rows ? values.rows() - 1 - y : y);
        if (columns)
            std::ranges::reverse_copy(from, to.begin());
        else
            std::ranges::copy(from, to.begin());
    }
    return turned;
}

// Bands that are written together, value beside value; counted from 1.
struct Bands {
    int first;
    int count;
};

} // namespace

struct RasterWriter::Open {
    Open(const std::string& path, const HeightFile& like, const RasterContent& what,
         const WriteOptions& options);
    ~Open();
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

    void write_in_file_order(Bands bands, std::size_t first_row, std::size_t first_column, std::size_t rows,
                             std::size_t columns, const void* values, std::size_t row_stride);
    void close();
    void copy(const ProgressCallback& progress);
    [[noreturn]] void fail(const GdalErrors& errors) const;

    Bands all_bands() const { return {1, dataset->GetRasterCount()}; }
    Bands one_band(std::size_t band) const;

    template <typename T>
    void write(Bands bands, std::size_t first_row, std::size_t first_column, GridView<const T> values);

    Placement placement;
    RasterContent content;
    StagedOutput staged;
    GDALDriver* driver = nullptr;
    CPLStringList creation_options;
    bool copies = false; ///< `dataset` is a temporary one, to be copied into `driver`'s format
    Dataset dataset;
    std::size_t block_rows = 1;
    std::size_t block_columns = 1;

private:
    void try_out(const HeightFile& like) const;
    bool is_whole_blocks(std::size_t first_row, std::size_t first_column, std::size_t rows,
                         std::size_t columns) const;
};

namespace {

const std::string& checked_target(const std::string& path, const HeightFile& like)
{
    if (like.is_made_of(path))
        throw OutputError("cannot write '" + path + "': it is the input '" + like.facts().path + "'");
    return path;
}

} // namespace

RasterWriter::Open::Open(const std::string& path, const HeightFile& like, const RasterContent& what,
                         const WriteOptions& options)
    : placement(placement_of(*like.open_->dataset, like.facts(), what)), content(what),
      staged(checked_target(path, like), options.overwrite)
{
    const std::string format = output_format(path, options);
    if (is_picture_format(format))
        turn_to_viewer(placement);
    driver = &output_driver(format, content);
    creation_options = completed_options(*driver, content, options);
    copies = format != "GTiff";
    try_out(like);
    const GdalErrors errors;
    if (copies) {
        WriteOptions plain;
        plain.creation_options = {"ZLEVEL=1"};
        plain.threads = options.threads;
        GDALDriver& geotiff = output_driver("GTiff", content);
        dataset = created(geotiff, staged.scratch_path("whole.tif"), placement, content,
                          completed_options(geotiff, content, plain));
    } else {
        dataset = created(*driver, staged.path(), placement, content, creation_options);
    }
    if (!dataset)
        fail(errors);
    int columns = 1;
    int rows = 1;
    dataset->GetRasterBand(1)->GetBlockSize(&columns, &rows);
    block_rows = static_cast<std::size_t>(rows);
    block_columns = static_cast<std::size_t>(columns);
}

// An unfinished raster goes without a word about what it could not write.
RasterWriter::Open::~Open()
{
    const GdalErrors quiet;
    if (dataset)
        dataset->MarkSuppressOnClose();
    dataset.reset();
}

// A few cells through the real driver: what it cannot hold shows now, not after the work.
void RasterWriter::Open::try_out(const HeightFile& like) const
{
    const GdalErrors errors;
    Placement small{std::min<std::size_t>(placement.rows, 8),
                    std::min<std::size_t>(placement.columns, 8),
                    placement.ground,
                    placement.geotransform,
                    nullptr,
                    placement.area_or_point};
    if (placement.crs)
        small.crs.reset(placement.crs->Clone());
    GDALDriver& memory = *GetGDALDriverManager()->GetDriverByName("MEM");
    const Dataset cells = created(memory, "", small, content, CPLStringList());
    const std::string folder = staged.make_scratch_folder("trial");
    const std::string name = std::filesystem::path(staged.path()).filename().string();
    Dataset trial(driver->CreateCopy((folder + "/" + name).c_str(), cells.get(), FALSE,
                                     const_cast<char**>(creation_options.List()), nullptr, nullptr));
    if (!trial && !staged.takes_bytes())
        fail(errors);
    if (!trial)
        throw InvalidInput("the format " + std::string(driver->GetDescription())
                           + " cannot hold this result: " + errors.reason("GDAL does not say why"));
    trial.reset();
    for (const auto& file : std::filesystem::directory_iterator(folder))
        if (file.path().filename() != name)
            staged.require_replaceable_companion(
                file.path().filename().string(),
                [&like](const std::string& path) { return like.is_made_of(path); });
}

void RasterWriter::Open::fail(const GdalErrors& errors) const
{
    std::string why = errors.reason("GDAL does not say why");
    const double free_mib = staged.free_mebibytes();
    if (free_mib < 16.0)
        why += " (the disk has " + plain_number(free_mib, 1) + " MiB left)";
    throw OutputError("cannot write '" + staged.target() + "': " + why);
}

bool RasterWriter::Open::is_whole_blocks(std::size_t first_row, std::size_t first_column, std::size_t rows,
                                         std::size_t columns) const
{
    const auto whole = [](std::size_t first, std::size_t count, std::size_t block, std::size_t all) {
        return first % block == 0 && ((first + count) % block == 0 || first + count == all);
    };
    return whole(first_row, rows, block_rows, placement.rows)
           && whole(first_column, columns, block_columns, placement.columns);
}

void RasterWriter::Open::write_in_file_order(Bands bands, std::size_t first_row, std::size_t first_column,
                                             std::size_t rows, std::size_t columns, const void* values,
                                             std::size_t row_stride)
{
    const GdalErrors errors;
    std::vector<int> numbers(static_cast<std::size_t>(bands.count));
    std::iota(numbers.begin(), numbers.end(), bands.first);
    const GDALDataType type = sample_type(content);
    const auto sample_bytes = static_cast<GSpacing>(GDALGetDataTypeSizeBytes(type));
    const GSpacing pixel_bytes = sample_bytes * bands.count;
    const auto width = static_cast<int>(columns);
    const auto height = static_cast<int>(rows);
    const CPLErr result = dataset->RasterIO(
        GF_Write, static_cast<int>(first_column), static_cast<int>(first_row), width, height,
        const_cast<void*>(values), width, height, type, bands.count, numbers.data(), pixel_bytes,
        pixel_bytes * static_cast<GSpacing>(row_stride), sample_bytes, nullptr);
    if (result == CE_None && is_whole_blocks(first_row, first_column, rows, columns))
        for (const int band : numbers)
            dataset->GetRasterBand(band)->FlushCache(false);
    if (result != CE_None || errors.any())
        fail(errors);
}

Bands RasterWriter::Open::one_band(std::size_t band) const
{
    assert(band < content.bands.size());
    return {static_cast<int>(band) + 1, 1};
}

template <typename T>
void RasterWriter::Open::write(Bands bands, std::size_t first_row, std::size_t first_column,
                               GridView<const T> values)
{
    assert(dataset && first_row + values.rows() <= placement.rows
           && first_column + values.columns() <= placement.columns);
    assert(sizeof(T)
           == static_cast<std::size_t>(GDALGetDataTypeSizeBytes(sample_type(content)))
                  * static_cast<std::size_t>(bands.count));
    if (values.empty())
        return;
    const bool flip_rows = placement.ground.rows_flipped;
    const bool flip_columns = placement.ground.columns_flipped;
    if (flip_rows)
        first_row = placement.rows - first_row - values.rows();
    if (flip_columns)
        first_column = placement.columns - first_column - values.columns();
    if (!flip_rows && !flip_columns)
        return write_in_file_order(bands, first_row, first_column, values.rows(), values.columns(),
                                   values.data(), values.row_stride());
    const Grid<T> turned = turned_round(values, flip_rows, flip_columns);
    write_in_file_order(bands, first_row, first_column, turned.rows(), turned.columns(), turned.data(),
                        turned.columns());
}

void RasterWriter::Open::close()
{
    const GdalErrors errors;
    dataset->FlushCache(false);
    dataset.reset();
    if (errors.any())
        fail(errors);
}

void RasterWriter::Open::copy(const ProgressCallback& progress)
{
    const GdalErrors errors;
    CopyProgress copy_progress{progress};
    {
        const Dataset whole(GDALDataset::Open(staged.scratch_path("whole.tif").c_str(), GDAL_OF_RASTER));
        if (!whole)
            fail(errors);
        const Dataset copied(driver->CreateCopy(staged.path().c_str(), whole.get(), FALSE,
                                                const_cast<char**>(creation_options.List()),
                                                CopyProgress::call, &copy_progress));
        if (copied)
            copied->FlushCache(false);
        else if (!copy_progress.stopped)
            fail(errors);
    }
    if (copy_progress.stopped)
        throw Cancelled();
    if (errors.any())
        fail(errors);
}

RasterWriter::RasterWriter(const std::string& path, const HeightFile& like, const RasterContent& content,
                           const WriteOptions& options)
    : open_(std::make_unique<Open>(path, like, content, options))
{}

RasterWriter::~RasterWriter() = default;
RasterWriter::RasterWriter(RasterWriter&&) noexcept = default;
RasterWriter& RasterWriter::operator=(RasterWriter&&) noexcept = default;

void RasterWriter::write(std::size_t first_row, std::size_t first_column, GridView<const std::uint8_t> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column, GridView<const Lit> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column, GridView<const float> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint8_t, 3>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint8_t, 4>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write_band(std::size_t band, std::size_t first_row, std::size_t first_column,
                              GridView<const std::uint8_t> values)
{
    open_->write(open_->one_band(band), first_row, first_column, values);
}

void RasterWriter::write_band(std::size_t band, std::size_t first_row, std::size_t first_column,
                              GridView<const float> values)
{
    open_->write(open_->one_band(band), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint8_t, 2>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::uint16_t> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint16_t, 2>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint16_t, 3>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<std::uint16_t, 4>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

void RasterWriter::write(std::size_t first_row, std::size_t first_column,
                         GridView<const std::array<float, 3>> values)
{
    open_->write(open_->all_bands(), first_row, first_column, values);
}

std::size_t RasterWriter::block_rows() const
{
    return open_->block_rows;
}

std::size_t RasterWriter::block_columns() const
{
    return open_->block_columns;
}

void RasterWriter::finish(const ProgressCallback& progress)
{
    open_->close();
    if (open_->copies)
        open_->copy(progress);
    open_->staged.publish();
}

} // namespace duskline
