#pragma once

#include <duskline/products/sun_hours.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace duskline::cli {

/// What a job of many days keeps beside its output, `OUTPUT.checkpoint`, so that it can go on after it was stopped:
///
///     {"days_done":3,"hash":"...","job":{...}}     one line of JSON
///     rows x columns numbers of 32 bits            seconds of sun so far, row after row, the machine's byte order
///
/// `job` says all that the sums depend on; a checkpoint of any other job is refused, and so is one whose bytes do not
/// have their hash. Files appear whole (StagedOutput): a kill leaves the last one or none.
class HoursCheckpoint {
public:
    HoursCheckpoint(const std::string& output, nlohmann::ordered_json job);

    const std::string& path() const { return path_; }

    /// The days done and, in `seconds`, their sums; 0 when there is no checkpoint. Throws InputError for one that is
    /// damaged or of another job.
    std::size_t load(SunSeconds& seconds) const;

    /// Replaces the checkpoint. Throws OutputError.
    void save(std::size_t days_done, const SunSeconds& seconds) const;

    /// Removes it, where there is one.
    void remove() const;

private:
    std::string path_;
    nlohmann::ordered_json job_;
};

} // namespace duskline::cli
