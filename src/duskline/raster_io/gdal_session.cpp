#include <duskline/raster_io/gdal_session.h>

#include <mutex>

namespace duskline {

void register_gdal_drivers()
{
    static std::once_flag once;
    std::call_once(once, [] { GDALAllRegister(); });
}

GdalErrors::GdalErrors()
{
    CPLPushErrorHandlerEx(collect, this);
    CPLSetCurrentErrorHandlerCatchDebug(FALSE);
}

GdalErrors::~GdalErrors()
{
    CPLPopErrorHandler();
    CPLErrorReset();
}

void CPL_STDCALL GdalErrors::collect(CPLErr level, CPLErrorNum, const char* text)
{
    auto& self = *static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    auto& list = level >= CE_Failure ? self.failures_ : self.warnings_;
    if (level >= CE_Warning && list.size() < 100)
        list.push_back(on_one_line(text));
}

std::string GdalErrors::reason(const std::string& otherwise) const
{
    return failures_.empty() ? otherwise : failures_.front();
}

GdalDefault::GdalDefault(const char* key, const std::string& value) : key_(key)
{
    if (CPLGetConfigOption(key, nullptr) != nullptr)
        return;
    CPLSetThreadLocalConfigOption(key, value.c_str());
    set_ = true;
}

GdalDefault::~GdalDefault()
{
    if (set_)
        CPLSetThreadLocalConfigOption(key_, nullptr);
}

std::string gdal_threads(std::size_t threads)
{
    return threads == 0 ? "ALL_CPUS" : std::to_string(threads);
}

CPLStringList as_gdal_list(const std::vector<std::string>& items)
{
    CPLStringList list;
    for (const std::string& item : items)
        list.AddString(item.c_str());
    return list;
}

std::string on_one_line(const std::string& text)
{
    std::string line;
    for (const char c : text) {
        const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && (line.back() == ' ' || line.back() == '.'))
        line.pop_back();
    return line;
}

} // namespace duskline
