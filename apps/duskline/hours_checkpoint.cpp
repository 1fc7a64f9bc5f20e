#include "hours_checkpoint.h"

#include "content_hash.h"

#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/staged_output.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace duskline::cli {
namespace {

std::span<const std::uint32_t> values_of(const SunSeconds& seconds)
{
    return seconds.values();
}

} // namespace

HoursCheckpoint::HoursCheckpoint(const std::string& output, nlohmann::ordered_json job)
    : path_(output + ".checkpoint"), job_(std::move(job))
{}

std::size_t HoursCheckpoint::load(SunSeconds& seconds) const
{
    std::ifstream file(path_, std::ios::binary);
    if (!file)
        return 0;
    std::string line;
    std::getline(file, line);
    const auto head = nlohmann::ordered_json::parse(line, nullptr, false);
    if (head.is_discarded() || !head.contains("job") || !head.contains("days_done") || !head.contains("hash"))
        throw InputError(fmt::format("'{}' is no checkpoint of sun hours; move it away", path_));
    if (head["job"] != job_)
        throw InputError(
            fmt::format("the checkpoint '{}' is of another job (other heights, place, dates, step or "
                        "limb); finish that one, or remove it",
                        path_));
    const std::span<std::uint32_t> values = seconds.values();
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
    const bool whole = static_cast<std::size_t>(file.gcount()) == values.size_bytes()
                       && file.peek() == std::ifstream::traits_type::eof();
    if (!whole || head["hash"] != content_hash(values_of(seconds)))
        throw InputError(fmt::format("the checkpoint '{}' is damaged; remove it to start anew", path_));
    return head["days_done"].get<std::size_t>();
}

void HoursCheckpoint::save(std::size_t days_done, const SunSeconds& seconds) const
{
    StagedOutput staged(path_, true);
    {
        const std::span<const std::uint32_t> values = seconds.values();
        const nlohmann::ordered_json head = {
            {"days_done", days_done}, {"hash", content_hash(values)}, {"job", job_}};
        std::ofstream file(staged.path(), std::ios::binary);
        file << head.dump() << '\n';
        file.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size_bytes()));
        if (!file.flush())
            throw OutputError(fmt::format("cannot write '{}': the disk may be full", path_));
    }
    staged.publish();
}

void HoursCheckpoint::remove() const
{
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

} // namespace duskline::cli
