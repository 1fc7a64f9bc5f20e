#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/open_raster.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace duskline {

namespace {

// What is wrong with a plain file, in fewer words than GDAL has; empty when that is not it.
std::string plain_reason(const std::string& path)
{
    if (path.starts_with("/vsi"))
        return "";
    struct stat status = {};
    if (stat(path.c_str(), &status) != 0) {
        // Other names may be connection strings: GDAL knows what is wrong with them.
        const bool is_plain = path.find(':') == std::string::npos && path.find('<') == std::string::npos;
        return errno == EACCES ? "permission denied" : is_plain ? "no such file" : "";
    }
    if (access(path.c_str(), R_OK) != 0)
        return "permission denied";
    if (S_ISDIR(status.st_mode))
        return "is a folder, not a raster";
    if (S_ISREG(status.st_mode) && status.st_size == 0)
        return "is empty (0 bytes)";
    return "";
}

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw InputError("'" + path + "': " + why);
}

void require_bands(GDALDataset& dataset, const std::string& path)
{
    if (dataset.GetRasterCount() > 0)
        return;
    char** parts = dataset.GetMetadata("SUBDATASETS");
    if (const char* first = CSLFetchNameValue(parts, "SUBDATASET_1_NAME"))
        refuse(path, "holds " + std::to_string(CSLCount(parts) / 2) + " rasters; name one of them, such as "
                         + first);
    refuse(path, "holds no raster");
}

bool is_colour(GDALColorInterp meaning)
{
    return meaning == GCI_RedBand || meaning == GCI_GreenBand || meaning == GCI_BlueBand;
}

bool is_alpha(GDALRasterBand& band)
{
    return band.GetColorInterpretation() == GCI_AlphaBand;
}

// Red, green and blue, or what looks so: three bands or more of 8 bits.
bool is_colour_picture(GDALDataset& dataset)
{
    if (dataset.GetRasterCount() < 3)
        return false;
    int colours = 0;
    int bytes = 0;
    for (int i = 1; i <= 3; ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(i);
        colours += is_colour(band.GetColorInterpretation()) ? 1 : 0;
        bytes += band.GetRasterDataType() == GDT_Byte ? 1 : 0;
    }
    return colours == 3 || bytes == 3;
}

std::string other_bands_warning(GDALDataset& dataset, const std::string& path)
{
    int others = 0;
    for (int i = 2; i <= dataset.GetRasterCount(); ++i)
        others += is_alpha(*dataset.GetRasterBand(i)) ? 0 : 1;
    if (others == 0)
        return "";
    return "'" + path + "' has " + std::to_string(dataset.GetRasterCount())
           + " bands; heights are taken from the first (--band chooses another)";
}

void require_numbers(GDALRasterBand& band, const std::string& path, std::size_t number)
{
    const GDALDataType type = band.GetRasterDataType();
    if (GDALDataTypeIsComplex(type))
        refuse(path, "band " + std::to_string(number) + " holds complex numbers (" + GDALGetDataTypeName(type)
                         + "), not heights");
    if (type == GDT_Unknown)
        refuse(path, "band " + std::to_string(number) + " is of a type that GDAL does not know");
}

} // namespace

Dataset open_raster(const std::string& path, const std::vector<std::string>& open_options)
{
    register_gdal_drivers();
    const GdalErrors errors;
    const CPLStringList options = as_gdal_list(open_options);
    Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, nullptr,
                                      options.List(), nullptr));
    if (dataset) {
        require_bands(*dataset, path);
        return dataset;
    }
    const std::string plain = plain_reason(path);
    refuse(path,
           plain.empty() ? "cannot be read as a raster: " + errors.reason("GDAL does not say why") : plain);
}

ChosenBand choose_band(GDALDataset& dataset, const std::string& path, std::size_t wanted)
{
    const auto count = static_cast<std::size_t>(dataset.GetRasterCount());
    if (wanted > count)
        throw InvalidInput("'" + path + "' has no band " + std::to_string(wanted) + ", only "
                           + (count == 1 ? "band 1" : "1 to " + std::to_string(count)));
    const std::size_t number = wanted == 0 ? 1 : wanted;
    GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(number));
    require_numbers(band, path, number);
    if (wanted != 0)
        return {number, ""};
    if (is_colour_picture(dataset))
        refuse(path, "is a colour picture (" + std::to_string(count)
                         + " bands), not heights; if one band does hold heights, --band names it");
    if (band.GetColorInterpretation() == GCI_PaletteIndex || band.GetColorTable() != nullptr)
        refuse(path,
               "is a picture whose numbers stand for colours of a palette, not for heights; if they are "
               "heights all the same, say --band 1");
    return {number, other_bands_warning(dataset, path)};
}

} // namespace duskline
