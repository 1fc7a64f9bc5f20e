#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_priv.h>

#include <memory>
#include <string>
#include <vector>

namespace duskline {

/// Registers GDAL's drivers, once per process.
void register_gdal_drivers();

/// Collects what GDAL complains about on this thread while it lives, and keeps it from stderr.
class GdalErrors {
public:
    GdalErrors();
    ~GdalErrors();
    GdalErrors(const GdalErrors&) = delete;
    GdalErrors& operator=(const GdalErrors&) = delete;

    bool any() const { return !failures_.empty(); }

    /// The first failure, which is nearest to the cause, on one line; `otherwise` when there was none.
    std::string reason(const std::string& otherwise) const;
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    static void CPL_STDCALL collect(CPLErr level, CPLErrorNum number, const char* text);

    std::vector<std::string> failures_;
    std::vector<std::string> warnings_;
};

/// Sets a GDAL option for this thread while it lives, unless the user has set it.
class GdalDefault {
public:
    GdalDefault(const char* key, const std::string& value);
    ~GdalDefault();
    GdalDefault(const GdalDefault&) = delete;
    GdalDefault& operator=(const GdalDefault&) = delete;

private:
    const char* key_;
    bool set_ = false;
};

/// What GDAL_NUM_THREADS and NUM_THREADS understand; 0 means all.
std::string gdal_threads(std::size_t threads);

struct DatasetCloser {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

/// KEY=VALUE strings as GDAL takes them.
CPLStringList as_gdal_list(const std::vector<std::string>& items);

/// The same text without line breaks and doubled blanks: errors are one line.
std::string on_one_line(const std::string& text);

} // namespace duskline
