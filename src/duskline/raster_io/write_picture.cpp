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

// The picture as a dataset of GDAL's.
Dataset in_memory(GridView<const Pixel> picture, int bands)
{
    constexpr std::array meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    const auto columns = static_cast<int>(picture.columns());
    const auto rows = static_cast<int>(picture.rows());
    GDALDriver& memory = *GetGDALDriverManager()->GetDriverByName("MEM");
    Dataset dataset(memory.Create("", columns, rows, bands, GDT_Byte, nullptr));
    if (!dataset)
        return dataset;
    for (int band = 1; band <= bands; ++band)
        dataset->GetRasterBand(band)->SetColorInterpretation(meanings[static_cast<std::size_t>(band) - 1]);
    constexpr GSpacing pixel_bytes = sizeof(Pixel);
    auto* pixels = const_cast<Pixel*>(picture.data());
    const CPLErr result =
        dataset->RasterIO(GF_Write, 0, 0, columns, rows, pixels, columns, rows, GDT_Byte, bands, nullptr,
                          pixel_bytes, pixel_bytes * static_cast<GSpacing>(picture.row_stride()), 1, nullptr);
    return result == CE_None ? std::move(dataset) : Dataset();
}

} // namespace

void write_picture(const std::string& path, GridView<const Pixel> picture, bool overwrite)
{
    register_gdal_drivers();
    const bool opaque = is_opaque(picture);
    RasterContent content;
    content.samples = opaque ? Samples::rgb : Samples::rgba;
    GDALDriver& driver = output_driver(output_format(path, {}), content);
    StagedOutput staged(path, overwrite);
    const GdalErrors errors;
    const Dataset pixels = in_memory(picture, opaque ? 3 : 4);
    Dataset written(
        pixels ? driver.CreateCopy(staged.path().c_str(), pixels.get(), FALSE, nullptr, nullptr, nullptr)
               : nullptr);
    const bool complete = written != nullptr;
    written.reset();
    if (!complete || errors.any())
        throw OutputError("cannot write '" + path + "': " + errors.reason("GDAL does not say why"));
    staged.publish();
}

} // namespace duskline
