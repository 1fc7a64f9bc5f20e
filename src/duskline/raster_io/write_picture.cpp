#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/output_format.h>
#include <duskline/raster_io/staged_output.h>
#include <duskline/raster_io/write_picture.h>

#include <algorithm>

namespace duskline {

namespace {

using Pixel = std::array<std::uint8_t, 4>;

bool is_opaque(GridView<const Pixel> picture)
{
    for (std::size_t row = 0; row < picture.rows(); ++row)
        if (!std::ranges::all_of(picture.row(row), [](const Pixel& pixel) { return pixel[3] == 255; }))
            return false;
    return true;
}

template <typename T>
Dataset in_memory(GridView<const T> picture, int bands)
{
    const auto columns = static_cast<int>(picture.columns());
    const auto rows = static_cast<int>(picture.rows());
    GDALDriver& memory = *GetGDALDriverManager()->GetDriverByName("MEM");
    Dataset dataset(memory.Create("", columns, rows, bands, GDT_Byte, nullptr));
    if (!dataset)
        return dataset;
    constexpr GSpacing pixel_bytes = sizeof(T);
    auto* pixels = const_cast<T*>(picture.data());
    const CPLErr result =
        dataset->RasterIO(GF_Write, 0, 0, columns, rows, pixels, columns, rows, GDT_Byte, bands, nullptr,
                          pixel_bytes, pixel_bytes * static_cast<GSpacing>(picture.row_stride()), 1, nullptr);
    return result == CE_None ? std::move(dataset) : Dataset();
}

void say_colours(GDALDataset& dataset)
{
    constexpr std::array meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    for (int band = 1; band <= dataset.GetRasterCount(); ++band)
        dataset.GetRasterBand(band)->SetColorInterpretation(meanings[static_cast<std::size_t>(band) - 1]);
}

// Writes what `make` puts into memory in the format of the extension, which has to hold such samples.
template <typename Make>
void write_dataset(const std::string& path, Samples samples, bool overwrite, const Make& make)
{
    register_gdal_drivers();
    RasterContent content;
    content.samples = samples;
    GDALDriver& driver = output_driver(output_format(path, {}), content);
    StagedOutput staged(path, overwrite);
    const GdalErrors errors;
    const Dataset pixels = make();
    Dataset written(
        pixels ? driver.CreateCopy(staged.path().c_str(), pixels.get(), FALSE, nullptr, nullptr, nullptr)
               : nullptr);
    const bool complete = written != nullptr;
    written.reset();
    if (!complete || errors.any())
        throw OutputError("cannot write '" + path + "': " + errors.reason("GDAL does not say why"));
    staged.publish();
}

} // namespace

void write_picture(const std::string& path, GridView<const Pixel> picture, bool overwrite)
{
    const bool opaque = is_opaque(picture);
    write_dataset(path, opaque ? Samples::rgb : Samples::rgba, overwrite, [&] {
        Dataset dataset = in_memory(picture, opaque ? 3 : 4);
        if (dataset)
            say_colours(*dataset);
        return dataset;
    });
}

void write_picture(const std::string& path, GridView<const std::uint8_t> picture, bool overwrite)
{
    write_dataset(path, Samples::byte, overwrite, [&] { return in_memory(picture, 1); });
}

} // namespace duskline
