#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/output_format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <string_view>

namespace duskline {

namespace {

struct Default {
    const char* key;
    std::string value;
};

bool has_capability(GDALDriver& driver, const char* capability)
{
    const char* value = driver.GetMetadataItem(capability);
    return value != nullptr && std::string_view(value) == "YES";
}

bool can_write(GDALDriver& driver)
{
    return has_capability(driver, GDAL_DCAP_RASTER)
           && (has_capability(driver, GDAL_DCAP_CREATE) || has_capability(driver, GDAL_DCAP_CREATECOPY));
}

bool has_word(GDALDriver& driver, const char* item, std::string_view wanted)
{
    const char* list = driver.GetMetadataItem(item);
    std::istringstream words(list != nullptr ? list : "");
    for (std::string word; words >> word;)
        if (EQUAL(word.c_str(), std::string(wanted).c_str()))
            return true;
    return false;
}

// GeoTIFF and COG share an extension; the plain one is what people mean by it.
std::string format_by_extension(const std::string& path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension.size() > 1) {
        const std::string wanted = extension.substr(1);
        if (EQUAL(wanted.c_str(), "tif") || EQUAL(wanted.c_str(), "tiff"))
            return "GTiff";
        GDALDriverManager& manager = *GetGDALDriverManager();
        for (int i = 0; i < manager.GetDriverCount(); ++i)
            if (can_write(*manager.GetDriver(i))
                && has_word(*manager.GetDriver(i), GDAL_DMD_EXTENSIONS, wanted))
                return manager.GetDriver(i)->GetDescription();
    }
    throw InvalidInput("no format that GDAL can write is known by the extension of '" + path
                       + "'; name one with --of, such as GTiff or PNG");
}

std::vector<Default> geotiff_defaults(const RasterContent& content, const CPLStringList& given,
                                      const std::string& threads)
{
    std::vector<Default> defaults;
    const bool shaped =
        given.FetchNameValue("BLOCKXSIZE") != nullptr || given.FetchNameValue("BLOCKYSIZE") != nullptr;
    if (!shaped)
        defaults.push_back({"TILED", "YES"});
    if (given.FetchNameValue("COMPRESS") == nullptr) {
        defaults.push_back({"COMPRESS", "DEFLATE"});
        if (content.samples != Samples::byte)
            defaults.push_back({"PREDICTOR", sample_type(content) == GDT_Float32 ? "3" : "2"});
    }
    const int bands = content.bands.empty() ? band_count(content) : 1; // of a colour
    if (bands >= 3)
        defaults.push_back({"PHOTOMETRIC", "RGB"});
    if (bands > 1 || !content.bands.empty())
        defaults.push_back({"INTERLEAVE", bands > 1 ? "PIXEL" : "BAND"});
    if (bands == 2 || bands == 4)
        defaults.push_back({"ALPHA", "YES"});
    defaults.push_back({"BIGTIFF", "IF_SAFER"});
    defaults.push_back({"NUM_THREADS", threads});
    return defaults;
}

std::vector<Default> cog_defaults(const RasterContent& content, const CPLStringList& given,
                                  const std::string& threads)
{
    std::vector<Default> defaults;
    if (given.FetchNameValue("COMPRESS") == nullptr) {
        defaults.push_back({"COMPRESS", "DEFLATE"});
        if (content.samples != Samples::byte)
            defaults.push_back({"PREDICTOR", "YES"});
    }
    if (given.FetchNameValue("RESAMPLING") == nullptr)
        defaults.push_back({"OVERVIEW_RESAMPLING", content.classes ? "MODE" : "AVERAGE"});
    defaults.push_back({"BIGTIFF", "IF_SAFER"});
    defaults.push_back({"NUM_THREADS", threads});
    return defaults;
}

CPLStringList given_options(const WriteOptions& options)
{
    for (const std::string& option : options.creation_options)
        if (option.find('=') == std::string::npos || option.front() == '=')
            throw InvalidInput("a creation option must be KEY=VALUE, got '" + option + "'");
    return as_gdal_list(options.creation_options);
}

} // namespace

std::string output_format(const std::string& path, const WriteOptions& options)
{
    register_gdal_drivers();
    if (options.format.empty())
        return format_by_extension(path);
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(options.format.c_str());
    if (driver == nullptr)
        throw InvalidInput("GDAL has no format called '" + options.format
                           + "'; gdalinfo --formats lists those it has");
    if (!can_write(*driver))
        throw InvalidInput("GDAL cannot write the format '" + options.format + "', only read it");
    return driver->GetDescription();
}

bool is_picture_format(const std::string& format)
{
    constexpr std::array<std::string_view, 7> pictures = {"PNG", "JPEG",   "WEBP", "BMP",
                                                          "GIF", "JPEGXL", "HEIF"};
    return std::ranges::find(pictures, format) != pictures.end();
}

int band_count(const RasterContent& content)
{
    switch (content.samples) {
    case Samples::byte_alpha:
    case Samples::word_alpha:
        return 2;
    case Samples::rgb:
    case Samples::rgb_words:
    case Samples::rgb_reals:
        return 3;
    case Samples::rgba:
    case Samples::rgba_words:
        return 4;
    case Samples::byte:
    case Samples::word:
    case Samples::real:
        break;
    }
    return std::max(1, static_cast<int>(content.bands.size()));
}

GDALDataType sample_type(const RasterContent& content)
{
    switch (content.samples) {
    case Samples::real:
    case Samples::rgb_reals:
        return GDT_Float32;
    case Samples::word:
    case Samples::word_alpha:
    case Samples::rgb_words:
    case Samples::rgba_words:
        return GDT_UInt16;
    case Samples::byte:
    case Samples::byte_alpha:
    case Samples::rgb:
    case Samples::rgba:
        break;
    }
    return GDT_Byte;
}

GDALDriver& output_driver(const std::string& format, const RasterContent& content)
{
    GDALDriver& driver = *GetGDALDriverManager()->GetDriverByName(format.c_str());
    const char* type = GDALGetDataTypeName(sample_type(content));
    const bool twelve_bits = format == "JPEG" && sample_type(content) == GDT_UInt16; // of the 16
    if (twelve_bits
        || (driver.GetMetadataItem(GDAL_DMD_CREATIONDATATYPES) != nullptr
            && !has_word(driver, GDAL_DMD_CREATIONDATATYPES, type)))
        throw InvalidInput("the format " + format + " cannot hold "
                           + (content.samples == Samples::real ? "heights or shares (Float32)"
                                                               : std::string("samples of type ") + type)
                           + "; GTiff can");
    return driver;
}

CPLStringList completed_options(GDALDriver& driver, const RasterContent& content, const WriteOptions& options)
{
    CPLStringList completed = given_options(options);
    const std::string format = driver.GetDescription();
    const GdalErrors errors;
    if (!GDALValidateCreationOptions(&driver, completed.List()))
        throw InvalidInput(errors.warnings().empty() ? "a creation option is wrong for " + format
                                                     : errors.warnings().front());
    std::vector<Default> defaults;
    if (format == "GTiff")
        defaults = geotiff_defaults(content, completed, gdal_threads(options.threads));
    else if (format == "COG")
        defaults = cog_defaults(content, completed, gdal_threads(options.threads));
    for (const Default& item : defaults)
        if (completed.FetchNameValue(item.key) == nullptr)
            completed.SetNameValue(item.key, item.value.c_str());
    return completed;
}

} // namespace duskline
