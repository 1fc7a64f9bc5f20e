#include <duskline/execution/available_memory.h>

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace duskline {

namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// The number after `key` in a file of lines "key number ..."; with an empty key, the file's only number.
std::optional<std::size_t> number_in(const std::string& path, const std::string& key)
{
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        if (!key.empty() && !(words >> word && word == key))
            continue;
        std::size_t number = 0;
        if (words >> number)
            return number;
        return std::nullopt; // "max"
    }
    return std::nullopt;
}

std::size_t free_in_system()
{
    const auto kilobytes = number_in("/proc/meminfo", "MemAvailable:");
    return kilobytes ? *kilobytes * 1024 : kNoLimit;
}

std::size_t left(std::size_t limit, std::size_t used)
{
    return limit > used ? limit - used : 0;
}

// What one control group leaves. Cached files count as used, but give way.
std::size_t free_in_group(const std::string& folder, const char* limit_file, const char* usage_file,
                          const char* cache_key)
{
    const auto limit = number_in(folder + "/" + limit_file, "");
    const auto used = number_in(folder + "/" + usage_file, "");
    if (!limit || !used)
        return kNoLimit;
    const std::size_t cached = number_in(folder + "/memory.stat", cache_key).value_or(0);
    return left(*limit, left(*used, cached));
}

// The least that a group and those above it leave.
std::size_t free_in_groups(const std::string& root, std::string group, const char* limit_file,
                           const char* usage_file, const char* cache_key)
{
    std::size_t least = free_in_group(root, limit_file, usage_file, cache_key);
    while (group.size() > 1) {
        least = std::min(least, free_in_group(root + group, limit_file, usage_file, cache_key));
        group.erase(group.rfind('/'));
    }
    return least;
}

std::size_t free_in_containers()
{
    std::size_t least = kNoLimit;
    std::ifstream groups("/proc/self/cgroup"); // lines "number:controllers:/path"
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        if (controllers.empty())
            least = std::min(least, free_in_groups("/sys/fs/cgroup", group, "memory.max", "memory.current",
                                                   "inactive_file"));
        else if (controllers == "memory")
            least = std::min(least, free_in_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes",
                                                   "memory.usage_in_bytes", "total_inactive_file"));
    }
    return least;
}

std::size_t free_address_space()
{
    rlimit limit = {};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return kNoLimit;
    const auto kilobytes = number_in("/proc/self/status", "VmSize:");
    return left(static_cast<std::size_t>(limit.rlim_cur), kilobytes.value_or(0) * 1024);
}

} // namespace

std::size_t available_memory_bytes()
{
    return std::min({free_in_system(), free_in_containers(), free_address_space()});
}

} // namespace duskline
