#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/read_height_field.h>

#include <mutex>
#include <utility>

namespace duskline {

namespace {

// What GDAL's own threads, which no handler of ours reaches, complained of last. One per process, as is the
// handler that GDAL calls from them.
class ComplaintOfOtherThreads {
public:
    void set(const std::string& text)
    {
        const std::scoped_lock lock(mutex_);
        text_ = text;
    }
    std::string take()
    {
        const std::scoped_lock lock(mutex_);
        return std::exchange(text_, "");
    }

private:
    std::mutex mutex_;
    std::string text_;
};

ComplaintOfOtherThreads& complaint_of_other_threads()
{
    static ComplaintOfOtherThreads complaint;
    return complaint;
}

void CPL_STDCALL remember_complaint(CPLErr level, CPLErrorNum, const char* text)
{
    if (level >= CE_Failure)
        complaint_of_other_threads().set(on_one_line(text));
}

} // namespace

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
    const std::string elsewhere = complaint_of_other_threads().take();
    if (!failures_.empty())
        return failures_.front();
    return elsewhere.empty() ? otherwise : elsewhere;
}

void prepare_gdal_for_program(std::size_t cache_bytes)
{
    CPLSetErrorHandler(remember_complaint);
    GDALSetCacheMax64(static_cast<GIntBig>(cache_bytes));
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
