#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace duskline::cli {

/// A folder of maps in the making. Files go to the hidden folder `.duskline-day` in it, next to `job.json`, which says
/// what job they belong to, and are moved in place when all are there, `manifest.json` last. So a folder holds the maps
/// its manifest speaks of, or those of before, or none; and what a stopped job has done stays for the next.
class DayFolder {
public:
    /// How to treat what is there.
    struct Options {
        bool overwrite = false; ///< replace maps that are there, once the new ones are complete
        bool resume = false;    ///< keep what a stopped job has done, and go on from it
    };

    /// Throws OutputError when `path` can be no such folder, or holds maps that may not be replaced. Makes nothing yet.
    DayFolder(const std::string& path, const Options& options);

    /// Removes what it has made, but for the maps of a job that may be resumed.
    ~DayFolder();
    DayFolder(const DayFolder&) = delete;
    DayFolder& operator=(const DayFolder&) = delete;

    /// Whether the manifest that is there is of that very job and all its files are there.
    bool is_complete(const nlohmann::ordered_json& job) const;

    /// Makes the folders. With `resume` the maps of a stopped job stay if that is the same; else they go. Throws
    /// OutputError, also for a file among `names` that is there and may not be replaced.
    void begin(const nlohmann::ordered_json& job, const std::vector<std::string>& names);

    /// Where to write a file, and whether it has been, whole.
    std::string path_of(const std::string& name) const;
    bool has(const std::string& name) const;

    /// Moves all files in place and writes the manifest. Throws OutputError.
    void publish(const nlohmann::ordered_json& manifest);

    /// Where the maps of a stopped job are.
    const std::string& staging() const { return staging_; }

private:
    void remove_outdated(const nlohmann::ordered_json& manifest) const;

    std::string path_;
    std::string staging_;
    Options options_;
    bool made_folder_ = false;
    bool begun_ = false;
    bool published_ = false;
};

} // namespace duskline::cli
