#include "day_folder.h"

#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/staged_output.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace duskline::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr auto kManifest = "manifest.json";
constexpr auto kJob = "job.json";

// Null when there is no such file or it holds no JSON.
ordered_json read_json(const fs::path& path)
{
    std::ifstream file(path);
    ordered_json json = file ? ordered_json::parse(file, nullptr, false) : ordered_json();
    return json.is_discarded() ? ordered_json() : json;
}

void write_json(const fs::path& path, const ordered_json& json, bool overwrite)
{
    StagedOutput staged(path.string(), overwrite);
    std::ofstream file(staged.path());
    file << json.dump(2, ' ', false, ordered_json::error_handler_t::replace) << '\n';
    if (!file.flush())
        throw OutputError(fmt::format("cannot write '{}': the disk may be full", path.string()));
    file.close();
    staged.publish();
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why)
{
    throw OutputError(fmt::format("cannot write '{}': {}", path.string(), why));
}

void make_folder(const fs::path& path)
{
    std::error_code error;
    fs::create_directory(path, error);
    if (error)
        refuse(path, error.message());
}

std::string without_slash(const std::string& name)
{
    const fs::path path = fs::path(name).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).string();
}

// Names of files that a manifest speaks of; only such as lie beside it.
std::vector<std::string> files_of(const ordered_json& manifest)
{
    std::vector<std::string> names;
    const ordered_json none = ordered_json::array();
    const ordered_json& files = manifest.is_object() && manifest.contains("files") ? manifest["files"] : none;
    for (const auto& name : files)
        if (name.is_string() && fs::path(name.get<std::string>()).filename() == name.get<std::string>())
            names.push_back(name);
    return names;
}

} // namespace

DayFolder::DayFolder(const std::string& path, const Options& options)
    : path_(without_slash(path)), staging_((fs::path(path_) / ".duskline-day").string()), options_(options)
{
    const fs::path folder(path_);
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        refuse(folder, "it is a file; give the name of a folder, or of a .tif for bands");
    const fs::path parent = fs::path(without_slash(fs::absolute(folder).string())).parent_path();
    if (!fs::is_directory(parent, ignored))
        refuse(folder, "there is no folder " + parent.string());
    if (fs::exists(folder / kManifest, ignored) && !options_.overwrite && !options_.resume)
        refuse(folder, "it holds the maps of a day already; --overwrite replaces them");
}

DayFolder::~DayFolder()
{
    if (!begun_ || (options_.resume && !published_))
        return;
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
    if (made_folder_ && !published_)
        fs::remove(path_, ignored); // only when it is empty
}

bool DayFolder::is_complete(const ordered_json& job) const
{
    const ordered_json manifest = read_json(fs::path(path_) / kManifest);
    if (!manifest.is_object() || !manifest.contains("job") || manifest["job"] != job)
        return false;
    const std::vector<std::string> names = files_of(manifest);
    return !names.empty() && std::ranges::all_of(names, [this](const auto& name) {
        return fs::exists(fs::path(path_) / name);
    });
}

void DayFolder::begin(const ordered_json& job, const std::vector<std::string>& names)
{
    const fs::path folder(path_);
    const bool goes_on = options_.resume && read_json(fs::path(staging_) / kJob) == job;
    if (!options_.overwrite && fs::exists(folder / kManifest))
        refuse(folder, "it holds the maps of another day; --overwrite replaces them");
    if (!options_.overwrite && !goes_on)
        for (const std::string& name : names)
            if (fs::exists(folder / name))
                refuse(folder / name, "it exists; --overwrite replaces it");
    made_folder_ = !fs::exists(folder);
    make_folder(folder);
    begun_ = true;
    std::error_code ignored;
    if (!goes_on)
        fs::remove_all(staging_, ignored);
    make_folder(staging_);
    std::vector<fs::path> unfinished;
    for (const auto& entry : fs::directory_iterator(staging_))
        if (entry.is_directory())
            unfinished.push_back(entry.path());
    for (const fs::path& path : unfinished)
        fs::remove_all(path, ignored);
    if (!goes_on)
        write_json(fs::path(staging_) / kJob, job, true);
}

std::string DayFolder::path_of(const std::string& name) const
{
    return (fs::path(staging_) / name).string();
}

bool DayFolder::has(const std::string& name) const
{
    return fs::exists(path_of(name));
}

// Maps of an older job that the new one has none to put in their place for.
void DayFolder::remove_outdated(const ordered_json& manifest) const
{
    const fs::path folder(path_);
    const std::vector<std::string> names = files_of(manifest);
    std::error_code ignored;
    for (const std::string& old : files_of(read_json(folder / kManifest)))
        if (std::ranges::find(names, old) == names.end())
            for (const char* companion : {"", ".aux.xml"})
                fs::remove(folder / (old + companion), ignored);
    fs::remove(folder / kManifest, ignored);
}

void DayFolder::publish(const ordered_json& manifest)
{
    const fs::path folder(path_);
    if (options_.overwrite)
        remove_outdated(manifest);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(staging_))
        if (entry.is_regular_file() && entry.path().filename() != kJob)
            files.push_back(entry.path());
    for (const fs::path& file : files) {
        std::error_code error;
        fs::rename(file, folder / file.filename(), error);
        if (error)
            refuse(folder / file.filename(), error.message());
    }
    write_json(folder / kManifest, manifest, options_.overwrite);
    published_ = true;
}

} // namespace duskline::cli
